// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/coloured_products.h"

#include <algorithm>

namespace structure {

namespace {

/// Numbers from 0 that are taken for the present owner alone.
class Marks {
 public:
  bool take(int number, int owner) {
    if (number >= static_cast<int>(owner_.size())) owner_.resize(number + 1, -1);
    const bool is_new = owner_[number] != owner;
    owner_[number] = owner;
    return is_new;
  }
  bool has(int number, int owner) const {
    return number < static_cast<int>(owner_.size()) && owner_[number] == owner;
  }

 private:
  std::vector<int> owner_;
};

std::vector<std::vector<int>> elements_of_nodes(const std::vector<std::vector<int>>& elements, int nodes) {
  std::vector<std::vector<int>> of_node(nodes);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int node : elements[e]) of_node[node].push_back(static_cast<int>(e));
  return of_node;
}

/// found(A, j, y): y is column j of node A's three, right at the nodes that `groups` keep apart.
template <class Found>
void for_each_column(const std::vector<std::vector<int>>& groups, int nodes, const Product& product,
                     Found found) {
  NodalVectors x = NodalVectors::Zero(3, nodes), y(3, nodes);
  for (const std::vector<int>& group : groups)
    for (int j = 0; j < 3; ++j) {
      for (const int A : group) x(j, A) = 1.0;
      product(x, y);
      for (const int A : group) {
        found(A, j, y);
        x(j, A) = 0.0;
      }
    }
}

}  // namespace

NodeGraph::NodeGraph(const Body& body) : begin_{0} {
  std::vector<std::vector<int>> elements(body.element_count());
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = body.element_nodes(static_cast<int>(e));
  const std::vector<std::vector<int>> of_node = elements_of_nodes(elements, body.node_count());
  Marks seen;
  for (int A = 0; A < body.node_count(); ++A) {
    for (const int e : of_node[A])
      for (const int B : elements[e])
        if (seen.take(B, A)) neighbours_.push_back(B);
    std::sort(neighbours_.begin() + static_cast<long>(begin_.back()), neighbours_.end());
    begin_.push_back(neighbours_.size());
  }
}

// Greedy: each node takes the first group in which nobody is near.  On a grid, in its order, that is as few
// as can be.
std::vector<std::vector<int>> NodeGraph::groups(bool without_common_neighbour) const {
  std::vector<std::vector<int>> groups;
  std::vector<int> group_of(nodes(), -1);
  Marks taken, seen;
  for (int A = 0; A < nodes(); ++A) {
    const auto note = [&](int B) {
      if (group_of[B] >= 0) taken.take(group_of[B], A);
    };
    for (const int* B = begin(A); B < end(A); ++B) {
      note(*B);
      if (!without_common_neighbour) continue;
      for (const int* C = begin(*B); C < end(*B); ++C)
        if (seen.take(*C, A)) note(*C);
    }
    int group = 0;
    while (taken.has(group, A)) ++group;
    if (group == static_cast<int>(groups.size())) groups.emplace_back();
    groups[group].push_back(A);
    group_of[A] = group;
  }
  return groups;
}

std::vector<Matrix3> nodal_blocks(const NodeGraph& graph, const Product& product) {
  std::vector<Matrix3> blocks(graph.nodes());
  for_each_column(graph.groups(false), graph.nodes(), product,
                  [&](int A, int j, const NodalVectors& y) { blocks[A].col(j) = y.col(A); });
  return blocks;
}

Eigen::SparseMatrix<double> lower_triangle(const NodeGraph& graph, const Product& product,
                                           const std::vector<int>& number) {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_column(graph.groups(true), graph.nodes(), product, [&](int A, int j, const NodalVectors& y) {
    const int column = number[3 * A + j];
    if (column < 0) return;
    for (const int* B = graph.begin(A); B < graph.end(A); ++B)
      for (int i = 0; i < 3; ++i)
        if (number[3 * *B + i] >= column) entries.emplace_back(number[3 * *B + i], column, y(i, *B));
  });
  const int size = 1 + *std::max_element(number.begin(), number.end());
  Eigen::SparseMatrix<double> lower(size, size);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

std::vector<int> numbers_of_free(const Supports& supports, int node_count) {
  std::vector<int> number(3 * static_cast<std::size_t>(node_count), 0);
  for (const Eigen::Index dof : supports.fixed_dofs()) number[dof] = -1;
  int next = 0;
  for (int& n : number)
    if (n == 0) n = next++;
  return number;
}

}  // namespace structure
