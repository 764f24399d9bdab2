// SPDX-License-Identifier: GPL-2.0-or-later
// Whole files into memory, and nothing that is no file: a pipe or a device may never answer, or never end.
#pragma once

#include <string>

namespace nurbs {

/// The content of a file, or why there is none.
struct FileContent {
  std::string bytes;
  std::string problem;  ///< empty, or "No such file or directory"
};
/// Regular files only, links followed, of less than 2 GiB (MPI counts in int).
FileContent read_regular_file(const std::string& path);

/// Why `path` cannot become a file that is written ("is a named pipe"), or empty: it is one already, or
/// nothing yet.
std::string problem_as_output(const std::string& path);

}  // namespace nurbs
