// SPDX-License-Identifier: GPL-2.0-or-later
// Springs between nodes and the ground: an elastic foundation, lumped as the mass is.
#pragma once

#include <vector>

#include "nurbs/types.h"
#include "structure/exact_sum.h"

namespace structure {

using nurbs::NodalVectors;
using nurbs::Vector3;
using Stiffness3 = Eigen::Matrix3d;  ///< force per displacement [force/length], symmetric, >= 0

class Springs {
 public:
  struct Spring {
    Eigen::Index column;  ///< of nodal arrays
    Stiffness3 k;
  };
  /// Springs of one support.
  void add(std::vector<Spring> group) { groups_.push_back(std::move(group)); }
  bool empty() const { return groups_.empty(); }
  const std::vector<std::vector<Spring>>& groups() const { return groups_; }

  /// f += K u, both 3 x n: they count as internal forces.
  void add_forces(const NodalVectors& u, NodalVectors& f) const;
  /// Adds u . K u / 2 [energy] of the first `owned` columns.
  void add_energy(const NodalVectors& u, Eigen::Index owned, ExactSum& sum) const;
  /// Adds what a group does to the body, - K u [force], of the first `owned` columns.
  void add_reaction(std::size_t group, const NodalVectors& u, Eigen::Index owned, ExactSum* xyz) const;

 private:
  std::vector<std::vector<Spring>> groups_;
};

}  // namespace structure
