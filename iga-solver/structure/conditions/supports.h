// SPDX-License-Identifier: GPL-2.0-or-later
// Dirichlet conditions: degrees of freedom that stay where they are, or move as they are told.
#pragma once

#include <array>
#include <vector>

#include "nurbs/types.h"
#include "structure/conditions/node_set.h"
#include "structure/conditions/time_function.h"
#include "structure/id.h"

namespace structure {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// Fixed directions x, y, z.
using Directions = std::array<bool, 3>;

/// Degrees of freedom that are displaced by size times time(t) [length].
struct Motion {
  TimeFunction time;
  std::vector<Eigen::Index> dofs;  ///< 3 A + direction, rising
  std::vector<double> size;        ///< of each
};

class Supports {
 public:
  /// Fixes nodes in the given directions.
  void fix(const NodeSet& nodes, const Directions& directions);
  /// Moves them there by displacement times time(t) [length]; but what was fixed or moved before goes on as
  /// it did.
  void move(const NodeSet& nodes, const Directions& directions, const Vector3& displacement,
            TimeFunction time);
  /// The same of arrays whose columns belong to these nodes (-1: to none).
  Supports on(const std::vector<Id>& nodes) const;
  /// Sets the fixed entries of nodal values (3 x n), and those that are moved, to zero: accelerations, trial
  /// vectors.
  void apply(NodalVectors& values) const;
  /// Fixed and moved degrees of freedom 3 A + direction, rising, each once.
  const std::vector<Eigen::Index>& fixed_dofs() const { return dofs_; }
  const std::vector<Motion>& motions() const { return motions_; }

 private:
  std::vector<Eigen::Index> dofs_;
  std::vector<Motion> motions_;
};

}  // namespace structure
