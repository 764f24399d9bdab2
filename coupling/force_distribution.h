// SPDX-License-Identifier: GPL-2.0-or-later
// Point force to control points and control-point velocities to the point: one transposed pair,
//   f_A = R_A(xi) F   and   v(xi) = sum_A R_A(xi) v_A,   so   F . v(xi) = sum_A f_A . v_A.
// Source: Gao & Feng (2019), eqs. 29 and 34 (F here is the force on the surface, so eq. 34's minus sign is in
// F).
#pragma once

#include "coupling/contact_surface.h"
#include "nurbs/surface_values.h"

namespace coupling {

/// Values R_A at one foot; the same object serves both directions of the transfer.
class FootBasis {
 public:
  FootBasis(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi) {
    nurbs::evaluate_values(space, xi, values_);
  }
  FootBasis(const nurbs::MultiPatch& surface, const nurbs::SurfacePoint& foot)
      : FootBasis(surface.patch(foot.patch), foot.xi) {
    values_.first += surface.first_control_point(foot.patch);
  }

  /// Value at the foot of a control-point field q (3 x n).
  Vector3 interpolate(const NodalVectors& q) const { return nurbs::interpolate(values_, q); }

  /// Adds R_A F to the control-point forces f (3 x n) [force].
  void distribute(const Vector3& F, NodalVectors& f) const { nurbs::distribute(values_, F, f); }
  /// Sum of R_A^2 n . diag(q_A) n: what moves the foot along n under a force along n if q are inverse masses.
  double sum_of_squares(const Vector3& n, const NodalVectors& q) const {
    double sum = 0.0;
    const double* R = values_.R;
    for_each_control_point([&](int c) {
      sum += *R * *R * n.cwiseAbs2().dot(q.col(c));
      ++R;
    });
    return sum;
  }
  /// f(index) for those that it spreads to.
  template <class Function>
  void for_each_control_point(Function f) const {
    for (int j = 0; j <= values_.q; ++j)
      for (int i = 0; i <= values_.p; ++i) f(values_.first + i + values_.stride * j);
  }

 private:
  nurbs::SurfaceValues values_;
};

}  // namespace coupling
