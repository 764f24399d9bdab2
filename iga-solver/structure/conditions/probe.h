// SPDX-License-Identifier: GPL-2.0-or-later
// A named material point whose displacement is recorded.
#pragma once

#include <array>
#include <string>

#include "nurbs/boundary.h"
#include "nurbs/patch.h"

namespace structure {

struct Probe {
  std::string name;
  nurbs::Parameter<3> xi;  ///< parameters in the volume
};

/// The point of a face at relative parameters `at`, each 0 to 1, of the volume's two other directions in
/// rising order. Throws std::invalid_argument if they lie outside.
nurbs::Parameter<3> face_point(const nurbs::Space<3>& volume, nurbs::Face face,
                               const std::array<double, 2>& at);

}  // namespace structure
