// SPDX-License-Identifier: GPL-2.0-or-later
// An elastic half-space under a unit point force on its surface: displacement and stress in closed form.
// Source: Johnson (1985), Contact Mechanics, section 3.2 (Boussinesq; force along the normal) and section 3.6
// (Cerruti; force along the surface).
#pragma once

#include "nurbs/types.h"
#include "structure/material/material.h"

namespace structure {

using nurbs::Vector3;

class HalfSpace {
 public:
  /// Young's modulus [pressure], Poisson's ratio, outward unit normal of the surface.
  HalfSpace(double youngs_modulus, double poissons_ratio, const Vector3& outward_normal);

  /// Column j: displacement at x [length], which is counted from the point of the force, by a unit force
  /// along e_j [length/force].  0 at infinity, not finite at x = 0.  In a cone of 26 degrees half angle above
  /// the force, where the solution goes to infinity, it is cut off: the far side of a bore may be there.
  Matrix3 displacement(const Vector3& x) const;
  /// Column j: traction [pressure/force] on a plane through x with the unit normal m by the same force: that
  /// of what m points into on what it points out of.
  Matrix3 traction(const Vector3& x, const Vector3& m) const;

 private:
  double mu_, mirror_;  // shear modulus; 1 - 2 nu
  Vector3 n_;           // into the body
  Matrix3 nn_, P_;      // n n^T, I - n n^T
};

}  // namespace structure
