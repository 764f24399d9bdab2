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

void Supports::apply(NodalVectors& values) const {
  NURBS_ASSERT(dofs_.empty() || dofs_.back() < values.size(), values.size());
  for (const Eigen::Index dof : dofs_) values.data()[dof] = 0.0;
}

}  // namespace structure
