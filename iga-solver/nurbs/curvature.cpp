// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs {

SurfaceShape shape_at(const MultiPatch& surface, const NodalVectors& control_points, const SurfacePoint& at) {
  const Space<2>& patch = surface.patch(at.patch);
  return shape_on_element(patch, surface.control_points_of(at.patch, control_points), patch.element_at(at.xi),
                          at.xi);
}

SurfaceShape shape_near(const Space<2>& patch, const Eigen::Ref<const NodalVectors>& control_points,
                        Parameter<2> xi) {
  constexpr double kBeside = 1e-3;  // of the way to the patch's middle
  const SurfaceShape shape = shape_on_element(patch, control_points, patch.element_at(xi), xi);
  if (std::isfinite(shape.curvature[1])) return shape;
  for (int d = 0; d < 2; ++d) {
    const KnotVector& knots = patch.knots(d);
    xi[d] += kBeside * (0.5 * (knots.front() + knots.back()) - xi[d]);
  }
  return shape_on_element(patch, control_points, patch.element_at(xi), xi);
}

SurfaceShape shape_on_element(const Space<2>& patch, const Eigen::Ref<const NodalVectors>& control_points,
                              int element, const Parameter<2>& xi) {
  constexpr double kNoArea = 1e-16, kNoLength = 1e-12;
  RationalBasis<2> basis;
  evaluate_on_element(patch, element, xi, 2, basis);
  const Vector3 zero = Vector3::Zero();
  Vector3 S = zero, S_i[2] = {zero, zero}, S_ij[3] = {zero, zero, zero};
  double round_off[2] = {0.0, 0.0};  // of S_i, over the machine's
  for (int a = 0; a < basis.count; ++a) {
    const Vector3 P = control_points.col(basis.control_point[a]);
    S += basis.R[a] * P;
    for (int i = 0; i < 2; ++i) S_i[i] += basis.dR[i][a] * P;
    for (int i = 0; i < 2; ++i) round_off[i] += std::abs(basis.dR[i][a]) * P.norm();
    for (int k = 0; k < 3; ++k) S_ij[k] += basis.d2R[k][a] * P;
  }

  const double E = S_i[0].squaredNorm(), F = S_i[0].dot(S_i[1]), G = S_i[1].squaredNorm();
  const double det = E * G - F * F;
  const Vector3 n = S_i[0].cross(S_i[1]) / std::sqrt(std::max(det, 0.0));
  const bool is_pole = std::sqrt(E) <= kNoLength * round_off[0] || std::sqrt(G) <= kNoLength * round_off[1];
  if (is_pole || !(det > kNoArea * E * G)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {S, n, {-kInfinity, kInfinity}};
  }
  const double L = n.dot(S_ij[0]), M = n.dot(S_ij[1]), N = n.dot(S_ij[2]);
  const double mean = 0.5 * (E * N - 2.0 * F * M + G * L) / det, gauss = (L * N - M * M) / det;
  const double root = std::sqrt(std::max(mean * mean - gauss, 0.0));
  return {S, n, {mean - root, mean + root}};
}

}  // namespace nurbs
