// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/affine_map.h"

namespace structure {

std::optional<Matrix3> affine_jacobian(const nurbs::Volume& patch) {
  constexpr double kRoundOff = 1e-15;  // of the coordinates
  const nurbs::Space<3>& space = patch.space;
  if (space.rational()) return std::nullopt;
  std::vector<double> greville[3];
  for (int d = 0; d < 3; ++d) greville[d] = space.knots(d).greville();
  const nurbs::NodalVectors& X = patch.control_points;
  const int n[3] = {space.control_point_count(0), space.control_point_count(1), space.control_point_count(2)};
  const int stride[3] = {1, n[0], n[0] * n[1]};
  Matrix3 J;
  for (int d = 0; d < 3; ++d)
    J.col(d) = (X.col((n[d] - 1) * stride[d]) - X.col(0)) / (greville[d].back() - greville[d].front());
  const double tolerance = kRoundOff * X.cwiseAbs().maxCoeff();
  for (int k = 0, A = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i, ++A) {
        const nurbs::Vector3 along(greville[0][i] - greville[0][0], greville[1][j] - greville[1][0],
                                   greville[2][k] - greville[2][0]);
        if (!((X.col(A) - X.col(0) - J * along).cwiseAbs().maxCoeff() <= tolerance)) return std::nullopt;
      }
  return J;
}

}  // namespace structure
