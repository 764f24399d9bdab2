// SPDX-License-Identifier: GPL-2.0-or-later
// Homogeneous Dirichlet conditions: degrees of freedom that stay where they are.
#pragma once

#include <array>
#include <vector>

#include "nurbs/types.h"
#include "structure/conditions/node_set.h"
#include "structure/id.h"

namespace structure {

using nurbs::NodalVectors;

/// Fixed directions x, y, z.
using Directions = std::array<bool, 3>;

class Supports {
 public:
  /// Fixes nodes in the given directions.
  void fix(const NodeSet& nodes, const Directions& directions);
  /// The same of arrays whose columns belong to these nodes (-1: to none).
  Supports on(const std::vector<Id>& nodes) const;
  /// Sets the fixed entries of nodal values (3 x n) to zero: velocities, accelerations, trial vectors.
  void apply(NodalVectors& values) const;
  /// Fixed degrees of freedom 3 A + direction, rising, each once.
  const std::vector<Eigen::Index>& fixed_dofs() const { return dofs_; }

 private:
  std::vector<Eigen::Index> dofs_;
};

}  // namespace structure
