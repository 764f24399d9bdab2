// SPDX-License-Identifier: GPL-2.0-or-later
// Whole files into memory, and nothing that is no file: a pipe or a device may never answer, or never end.
// Files that are written are whole or not there, whenever a run is killed.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace geometry_io {

/// The content of a file, or why there is none.
struct FileContent {
  std::string bytes;
  std::string problem;  ///< empty, or "No such file or directory"
};
/// Regular files only, links followed, of less than 2 GiB (MPI counts in int).
FileContent read_regular_file(const std::string& path);

/// Why `path` cannot become a file that is written ("Is a named pipe"), or empty: it is one already, or
/// nothing yet, and so is its unfinished_name.
std::string problem_as_output(const std::string& path);
/// The same where it is not written yet, also for want of a folder or of a permission: by trying.
std::string problem_as_later_output(const std::string& path);
/// Where a file is written until it is complete: path.part, beside the file that a link names.
std::string unfinished_name(const std::string& path);
/// Gives what was written there its name, in place of an older file; why that failed, or empty.
std::string finish_file(const std::string& path);
/// Removes what was written there and will not be complete.
void discard_file(const std::string& path);
/// All of this for a file that `write` writes in one go; why that failed, or empty.
std::string write_file(const std::string& path, const std::function<void(std::ostream&)>& write);
/// Whether both names are of one file that exists.
bool same_file(const std::string& a, const std::string& b);

}  // namespace geometry_io
