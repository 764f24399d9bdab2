// SPDX-License-Identifier: GPL-2.0-or-later
// STEP (AP203, AP214, AP242) and IGES, by OpenCASCADE.  These files (step_*) alone know it, and they are in a
// program of their own (read_step_main.cpp): it may crash, or come to no end, on a damaged file.
#pragma once

#include <string>

#include "brep/cad_model.h"

namespace geometry_io {

struct StepOptions {
  double offset_tolerance = 0.0;  ///< within which surfaces of offset are fitted [mm]; 0: they are refused
};

/// Lengths in mm.  Throws std::runtime_error: one line with the face's number and its entity, what it is and
/// what was expected.
brep::CadModel read_step(const std::string& bytes, const StepOptions& options = {});

}  // namespace geometry_io
