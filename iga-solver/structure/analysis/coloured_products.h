// SPDX-License-Identifier: GPL-2.0-or-later
// Entries of a matrix that is known by its products: columns that have no row in common are found by one
// product.  No element matrices, whatever the body and its law.
// Source: Curtis, Powell & Reid (1974), "On the estimation of sparse Jacobian matrices", J. Inst. Math. Appl.
// 13, 117-119.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "structure/analysis/tangent.h"

namespace structure {

/// Nodes that share an element with a node, rising, itself among them.
class NodeGraph {
 public:
  explicit NodeGraph(const Body& body);

  int nodes() const { return static_cast<int>(begin_.size()) - 1; }
  const int* begin(int node) const { return neighbours_.data() + begin_[node]; }
  const int* end(int node) const { return neighbours_.data() + begin_[node + 1]; }

  /// Groups of nodes of which none are neighbours; `without_common_neighbour`: nor have one in common.
  std::vector<std::vector<int>> groups(bool without_common_neighbour) const;

 private:
  std::vector<std::size_t> begin_;
  std::vector<int> neighbours_;
};

/// The 3 x 3 blocks of the diagonal, one per node.
std::vector<Matrix3> nodal_blocks(const NodeGraph& graph, const Product& product);

/// The lower triangle, of the rows and columns that have a number: `number` [3 node_count], -1 of others.
Eigen::SparseMatrix<double> lower_triangle(const NodeGraph& graph, const Product& product,
                                           const std::vector<int>& number);

/// Numbers of the degrees of freedom that are not fixed, for lower_triangle.
std::vector<int> numbers_of_free(const Supports& supports, int node_count);

}  // namespace structure
