// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal shapes, stored node by node: values at a node, and forces on nodes as forces on shapes.  Both are the
// same to the last bit however the body is cut.
#pragma once

#include <vector>

#include "structure/halo.h"

namespace structure {

using nurbs::NodalVectors;
using nurbs::Vector3;

class ModalRows {
 public:
  /// Each 3 x n of a part.
  explicit ModalRows(const std::vector<NodalVectors>& shapes);

  Eigen::Index shape_count() const { return count_; }
  /// Of coordinates, one per shape, as at() takes them.
  Eigen::VectorXd padded(const Eigen::VectorXd& coordinates) const;
  /// Sum of padded coordinates times shapes at a node, of two sets of them: half the memory's work of two
  /// calls.
  void at(Eigen::Index node, const Eigen::VectorXd& a, const Eigen::VectorXd& b, Vector3& of_a,
          Vector3& of_b) const;
  /// Sum over the nodes of all parts of shape . f, for each shape; f (3 x n) is zero but at `touched`
  /// (columns, rising).  Collective.
  Eigen::VectorXd project(const NodalVectors& f, const std::vector<Eigen::Index>& touched,
                          const Halo& halo) const;
  Eigen::VectorXd project(const NodalVectors& f, const Halo& halo) const;  ///< of all nodes
  /// Of each degree of freedom the sum of squares of the first `shapes`, 3 x n.
  NodalVectors squares(Eigen::Index shapes) const;

 private:
  static constexpr int kLanes = 4;  // numbers at a time
  Eigen::Index count_;
  Eigen::MatrixXd rows_;  // [shape, 0 beyond][3 node + direction]
};

}  // namespace structure
