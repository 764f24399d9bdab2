// SPDX-License-Identifier: GPL-2.0-or-later
// The words `output FILE every N [fields ...] [average yes|no]` and `stl FILE every N [chord D]` of
// fix wall/nurbs.
#pragma once

#include <optional>
#include <string>

#include "coupling/contact_fields.h"
#include "word_reader.h"

namespace liggghts_pkg {

struct OutputOptions {
  std::string file;  ///< without .pvd; empty: no output
  int every = 0;     ///< steps
  coupling::ContactFields::Selection fields;
  bool average = true;  ///< over all steps since the last output, else the one step
};

/// Reads what stands after `output`.  Throws std::invalid_argument: what was given, what was expected.
OutputOptions read_output(WordReader& words);

struct StlOptions {
  std::string file;             ///< without _<step>.stl; empty: none
  int every = 0;                ///< steps
  std::optional<double> chord;  ///< how far the triangles may be from the surface [length]
};

/// Reads what stands after `stl`.  Throws as above.
StlOptions read_stl(WordReader& words);

/// Files are named by their steps: where a run begins before the last one that `keyword` has `written` to
/// `file`, it would write over some.  Throws std::runtime_error.
void expect_no_way_back(const std::string& keyword, const std::string& file, std::optional<long> written,
                        long step);

/// The words after `fields`.
std::vector<std::string> output_fields();

}  // namespace liggghts_pkg
