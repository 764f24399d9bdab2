// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/supports.h"

#include <algorithm>
#include <utility>

#include "nurbs/assert.h"

namespace structure {

void Supports::fix(const NodeSet& nodes, const Directions& directions) {
  for (const Eigen::Index A : nodes)
    for (int i = 0; i < 3; ++i)
      if (directions[i]) dofs_.push_back(3 * A + i);
  std::sort(dofs_.begin(), dofs_.end());
  dofs_.erase(std::unique(dofs_.begin(), dofs_.end()), dofs_.end());
}

void Supports::move(const NodeSet& nodes, const Directions& directions, const Vector3& displacement,
                    TimeFunction time) {
  Motion motion{std::move(time), {}, {}};
  for (const Eigen::Index A : nodes)
    for (int i = 0; i < 3; ++i)
      if (directions[i] && !std::binary_search(dofs_.begin(), dofs_.end(), 3 * A + i)) {
        motion.dofs.push_back(3 * A + i);
        motion.size.push_back(displacement[i]);
      }
  motions_.push_back(std::move(motion));
  fix(nodes, directions);
}

namespace {

/// visit(dof, place in `dofs`) for those degrees of freedom of the columns that `dofs` has.
template <class Visit>
void for_each_held(const std::vector<Id>& nodes, const std::vector<Eigen::Index>& dofs, Visit visit) {
  for (std::size_t column = 0; column < nodes.size(); ++column)
    for (Id i = 0; i < 3 && nodes[column] >= 0; ++i) {
      const auto found = std::lower_bound(dofs.begin(), dofs.end(), 3 * nodes[column] + i);
      if (found != dofs.end() && *found == 3 * nodes[column] + i)
        visit(3 * static_cast<Id>(column) + i, found - dofs.begin());
    }
}

}  // namespace

Supports Supports::on(const std::vector<Id>& nodes) const {
  Supports held;
  for_each_held(nodes, dofs_, [&](Eigen::Index dof, std::size_t) { held.dofs_.push_back(dof); });
  for (const Motion& motion : motions_) {
    held.motions_.push_back({motion.time, {}, {}});
    for_each_held(nodes, motion.dofs, [&](Eigen::Index dof, std::size_t place) {
      held.motions_.back().dofs.push_back(dof);
      held.motions_.back().size.push_back(motion.size[place]);
    });
  }
  return held;
}

void Supports::apply(NodalVectors& values) const {
  NURBS_ASSERT(dofs_.empty() || dofs_.back() < values.size(), values.size());
  for (const Eigen::Index dof : dofs_) values.data()[dof] = 0.0;
}

}  // namespace structure
