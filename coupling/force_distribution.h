// SPDX-License-Identifier: GPL-2.0-or-later
// Point force to control points and control-point velocities to the point: one transposed pair,
//   f_A = R_A(xi) F   and   v(xi) = sum_A R_A(xi) v_A,   so   F . v(xi) = sum_A f_A . v_A.
// Source: Gao & Feng (2019), eqs. 29 and 34 (F here is the force on the surface, so eq. 34's minus sign is in
// F).
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "coupling/contact_surface.h"
#include "nurbs/surface_slopes.h"

namespace coupling {

template <class Function>
void for_each(const nurbs::SurfaceValues& values, Function f) {
  for (int j = 0; j <= values.q; ++j)
    for (int i = 0; i <= values.p; ++i) f(values.first + i + values.stride * j);
}

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
    for_each(values_, f);
  }
  /// The first of them, by which elements differ.
  int first_control_point() const { return values_.first; }
  const nurbs::SurfaceValues& values() const { return values_; }

 private:
  nurbs::SurfaceValues values_;
};

/// Values and derivatives there: a force and a couple, which is forces that sum to zero,
///   f_A = R_A(xi) F + sum_j dR_A/dxi_j G_j,   whose moment about the foot is   sum_j S_j x G_j.
class FootSlopes {
 public:
  FootSlopes(const nurbs::MultiPatch& surface, const nurbs::SurfacePoint& foot) {
    nurbs::evaluate_slopes(surface.patch(foot.patch), foot.xi, slopes_);
    slopes_.values.first += surface.first_control_point(foot.patch);
  }

  /// S_j, from the control points X (3 x n).
  nurbs::Tangents tangents(const NodalVectors& X) const { return nurbs::interpolate_slopes(slopes_, X); }
  void distribute(const Vector3& F, const nurbs::Tangents& G, NodalVectors& f) const {
    nurbs::distribute(slopes_, F, G, f);
  }
  template <class Function>
  void for_each_control_point(Function f) const {
    for_each(slopes_.values, f);
  }
  int first_control_point() const { return slopes_.values.first; }
  const nurbs::SurfaceSlopes& slopes() const { return slopes_; }

 private:
  nurbs::SurfaceSlopes slopes_;
};

/// G of a couple C where the tangents are S: along the normal what tilts the surface, along it what turns it
/// about the normal.
inline std::array<Vector3, 2> couple_forces(const Vector3& first, const Vector3& second, const Vector3& C) {
  const Vector3 normal = first.cross(second);
  const double share = 1.0 / normal.squaredNorm(), turn = 0.5 * share * C.dot(normal);
  return {turn * second - share * C.dot(second) * normal, share * C.dot(first) * normal - turn * first};
}

/// The same for a rigid wall of faces, whose nodes are four corners of the box around it: barycentric
/// coordinates, so force and torque of all nodes together are those at the foot.
class BoxBasis {
 public:
  BoxBasis(const brep::Surface& wall, const Vector3& foot) {
    const Vector3 b = (foot - wall.low).cwiseQuotient(extent(wall));
    R_[0] = 1.0 - b.sum();
    for (int d = 0; d < 3; ++d) R_[1 + d] = b[d];
  }
  /// The low corner, and those along each axis from there, 3 x 4 [length].
  static NodalVectors nodes(const brep::Surface& wall) {
    NodalVectors nodes = wall.low.replicate(1, 4);
    nodes.rightCols<3>() += Eigen::Matrix3d(extent(wall).asDiagonal());
    return nodes;
  }
  void distribute(const Vector3& F, NodalVectors& f) const {
    for (int c = 0; c < 4; ++c) f.col(c) += R_[c] * F;
  }
  template <class Function>
  void for_each_control_point(Function f) const {
    for (int c = 0; c < 4; ++c) f(c);
  }

 private:
  /// Of a wall that is flat along an axis, its size there.
  static Vector3 extent(const brep::Surface& wall) {
    const Vector3 sides = wall.high - wall.low;
    return (sides.array() > 0.0).select(sides, wall.size);
  }

  double R_[4];
};

}  // namespace coupling
