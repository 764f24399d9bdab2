// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/springs.h"

namespace structure {

void Springs::add_forces(const NodalVectors& u, NodalVectors& f) const {
  for (const std::vector<Spring>& group : groups_)
    for (const Spring& spring : group) f.col(spring.column) += spring.k * u.col(spring.column);
}

void Springs::add_energy(const NodalVectors& u, Eigen::Index owned, ExactSum& sum) const {
  for (const std::vector<Spring>& group : groups_)
    for (const Spring& spring : group) {
      const Vector3 here = u.col(spring.column);
      if (spring.column < owned) sum.add(0.5 * here.dot(spring.k * here));
    }
}

void Springs::add_reaction(std::size_t group, const NodalVectors& u, Eigen::Index owned,
                           ExactSum* xyz) const {
  for (const Spring& spring : groups_[group]) {
    if (spring.column >= owned) continue;
    const Vector3 force = spring.k * u.col(spring.column);
    for (int i = 0; i < 3; ++i) xyz[i].add(-force[i]);
  }
}

}  // namespace structure
