// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/net_shares.h"

#include <map>

namespace coupling {

// A node of several patches is any of its control points: they are in one place.
NetShares::NetShares(const SurfaceMap& map, const std::vector<LocalCompliance::Share>& shares) {
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

}  // namespace coupling
