// SPDX-License-Identifier: GPL-2.0-or-later
// The words `output FILE every N [fields ...] [average yes|no]` of fix wall/nurbs.
#pragma once

#include <string>

#include "coupling/surface_fields.h"
#include "word_reader.h"

namespace liggghts_pkg {

struct OutputOptions {
  std::string file;  ///< without .pvd; empty: no output
  int every = 0;     ///< steps
  coupling::SurfaceFields::Selection fields;
  bool average = true;  ///< over all steps since the last output, else the one step
};

/// Reads what stands after `output`.  Throws std::invalid_argument: what was given, what was expected.
OutputOptions read_output(WordReader& words);

/// The words after `fields`.
std::vector<std::string> output_fields();

}  // namespace liggghts_pkg
