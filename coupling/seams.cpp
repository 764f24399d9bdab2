// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/seams.h"

#include <map>

namespace coupling {

double Seams::sum_of_squares(const FootBasis& foot, const Vector3& n, const NodalVectors& q) const {
  std::map<int, double> shares;
  const double* R = foot.values().R;
  foot.for_each_control_point([&](int c) {
    if (shares_.has(c))
      shares_.for_each(c, [&](int to, double share) { shares[to] += share * *R; });
    else
      shares[c] += *R;
    ++R;
  });
  double sum = 0.0;
  for (const auto& [c, share] : shares) sum += share * share * n.cwiseAbs2().dot(q.col(c));
  return sum;
}

}  // namespace coupling
