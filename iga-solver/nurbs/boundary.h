// SPDX-License-Identifier: GPL-2.0-or-later
// Boundary surfaces of a volume patch (Gao & Feng 2019, eqs. 11-12).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// Faces of a volume by parameter direction and side.
enum class Face { xi_minus, xi_plus, eta_minus, eta_plus, zeta_minus, zeta_plus };

/// "xi-", "xi+", ... "zeta+" as in model files.
const char* face_name(Face face);
/// Throws std::invalid_argument that lists the six names.
Face face_from_name(const std::string& name);

/// A face as a surface of its own.  Its parameters are the volume's two others in rising order.
struct BoundarySurface {
  Space<2> space;
  std::vector<int> volume_control_point;  ///< per surface control point
  /// +1 where dS/du x dS/dv points out of a right-handed volume, else -1.
  int outward_sign;
};

BoundarySurface boundary_surface(const Space<3>& volume, Face face);

}  // namespace nurbs
