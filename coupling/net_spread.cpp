// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/net_spread.h"

namespace coupling {

NetSpread::Sums NetSpread::sums(const nurbs::SurfaceSlopes& foot, const NodalVectors& q) const {
  Sums sums = {Vector3::Zero(), nurbs::Tangents::Zero()};
  int a = 0;
  for_each(foot.values, [&](int c) {
    const Vector3 of_node = shares_.sum(c, q);
    sums.value += foot.values.R[a] * of_node;
    for (int j = 0; j < 2; ++j) sums.slopes.col(j) += foot.dR[j][a] * of_node;
    ++a;
  });
  return sums;
}

Vector3 NetSpread::sum(const nurbs::SurfaceValues& foot, const NodalVectors& q) const {
  Vector3 sum = Vector3::Zero();
  const double* R = foot.R;
  for_each(foot, [&](int c) { sum += *R++ * shares_.sum(c, q); });
  return sum;
}

}  // namespace coupling
