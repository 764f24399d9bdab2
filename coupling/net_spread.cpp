// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/net_spread.h"

#include <map>

namespace coupling {

// A node of several patches is any of its control points: they are in one place.
NetSpread::NetSpread(const SurfaceMap& map, const std::vector<LocalCompliance::Share>& shares) {
  const std::vector<NodeId> nodes = map.selected_nodes();
  std::map<NodeId, int> point_of;
  for (std::size_t c = 0; c < nodes.size(); ++c) point_of.emplace(nodes[c], static_cast<int>(c));
  std::map<NodeId, std::vector<Share>> of_node;
  for (const auto& [from, to, share] : shares) of_node[from].push_back({point_of.at(to), share});
  for (const NodeId node : nodes) {
    first_.push_back(static_cast<int>(shares_.size()));
    const std::vector<Share>& own = of_node[node];
    shares_.insert(shares_.end(), own.begin(), own.end());
  }
  first_.push_back(static_cast<int>(shares_.size()));
}

Vector3 NetSpread::of_control_point(int c, const NodalVectors& q) const {
  Vector3 sum = Vector3::Zero();
  for_each_share(c, [&](int to, double share) { sum += share * q.col(to); });
  return sum;
}

NetSpread::Sums NetSpread::sums(const nurbs::SurfaceSlopes& foot, const NodalVectors& q) const {
  Sums sums = {Vector3::Zero(), nurbs::Tangents::Zero()};
  int a = 0;
  for_each(foot.values, [&](int c) {
    const Vector3 of_node = of_control_point(c, q);
    sums.value += foot.values.R[a] * of_node;
    for (int j = 0; j < 2; ++j) sums.slopes.col(j) += foot.dR[j][a] * of_node;
    ++a;
  });
  return sums;
}

Vector3 NetSpread::sum(const nurbs::SurfaceValues& foot, const NodalVectors& q) const {
  Vector3 sum = Vector3::Zero();
  const double* R = foot.R;
  for_each(foot, [&](int c) { sum += *R++ * of_control_point(c, q); });
  return sum;
}

}  // namespace coupling
