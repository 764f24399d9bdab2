// SPDX-License-Identifier: GPL-2.0-or-later
// What the parts of a cut body tell each other.  A part holds the nodes of its own elements.  Nodes at a cut
// are held by several parts and owned by one; a part's own nodes come first in its arrays, the others'
// (ghosts) after them.  All calls are collective: every part makes the same, in the same order.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nurbs/types.h"

namespace structure {

/// A node or an element of the whole body, counted from 0: the same however it is cut.
using Id = std::int64_t;

/// This one is of a body in one piece: nothing to tell.
class Halo {
 public:
  virtual ~Halo() = default;

  /// How many of the `held` nodes the part owns.
  virtual Eigen::Index owned(Eigen::Index held) const { return held; }
  virtual Id node_id(Eigen::Index held) const { return held; }
  virtual Id element_id(Eigen::Index held) const { return held; }
  /// Adds to each owner's column of a nodal array (3 x held) what other parts have at their ghosts of it.
  virtual void sum_to_owners(nurbs::NodalVectors& /*values*/) const {}
  /// Copies the owners' columns to all ghosts.
  virtual void owners_to_ghosts(nurbs::NodalVectors& /*values*/) const {}
  /// Each of `count` numbers summed over the parts; the same to the last bit on all of them.
  virtual void sum(double* /*values*/, std::size_t /*count*/) const {}
  /// The largest number of all parts; not a number if one is none.
  virtual double largest(double value) const { return value; }
  /// Rows of equally many numbers, one per id, from all parts in the order of the ids; complete on all parts.
  virtual std::vector<double> in_order(const std::vector<Id>& /*ids*/, std::vector<double> rows) const {
    return rows;
  }

  double sum(double value) const {
    sum(&value, 1);
    return value;
  }
  nurbs::Vector3 sum(nurbs::Vector3 value) const {
    sum(value.data(), 3);
    return value;
  }
  /// Whether it is so on any part.
  bool any(bool here) const { return largest(here ? 1.0 : 0.0) > 0.0; }
  /// Columns of the nodes that the part owns: what sums over nodes go over.
  auto own(const nurbs::NodalVectors& values) const { return values.leftCols(owned(values.cols())); }
  /// Sum over the nodes of all parts of a . b.
  double dot(const nurbs::NodalVectors& a, const nurbs::NodalVectors& b) const {
    return sum(own(a).cwiseProduct(own(b)).sum());
  }
};

/// Per held node the sum of what all parts give for it (masses).
inline Eigen::VectorXd whole(const Halo& halo, const Eigen::VectorXd& share) {
  nurbs::NodalVectors values = nurbs::Vector3::Ones() * share.transpose();
  halo.sum_to_owners(values);
  halo.owners_to_ghosts(values);
  return values.row(0);
}

}  // namespace structure
