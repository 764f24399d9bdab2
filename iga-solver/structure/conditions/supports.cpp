// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/supports.h"

#include <algorithm>

#include "nurbs/assert.h"

namespace structure {

void Supports::fix(const NodeSet& nodes, const Directions& directions) {
  for (const Eigen::Index A : nodes)
    for (int i = 0; i < 3; ++i)
      if (directions[i]) dofs_.push_back(3 * A + i);
  std::sort(dofs_.begin(), dofs_.end());
  dofs_.erase(std::unique(dofs_.begin(), dofs_.end()), dofs_.end());
}

Supports Supports::on(const std::vector<Id>& nodes) const {
  Supports held;
  for (std::size_t column = 0; column < nodes.size(); ++column)
    for (Id i = 0; i < 3; ++i)
      if (nodes[column] >= 0 && std::binary_search(dofs_.begin(), dofs_.end(), 3 * nodes[column] + i))
        held.dofs_.push_back(3 * static_cast<Id>(column) + i);
  return held;
}

void Supports::apply(NodalVectors& values) const {
  NURBS_ASSERT(dofs_.empty() || dofs_.back() < values.size(), values.size());
  for (const Eigen::Index dof : dofs_) values.data()[dof] = 0.0;
}

}  // namespace structure
