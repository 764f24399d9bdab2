// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact_surface.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "nurbs/assert.h"

namespace coupling {

SurfaceMap SurfaceMap::selection(const std::vector<NodeId>& node, NodeId nodes) {
  Matrix S(static_cast<NodeId>(node.size()), nodes);
  S.reserve(Eigen::Matrix<NodeId, Eigen::Dynamic, 1>::Constant(S.rows(), 1));
  for (NodeId i = 0; i < S.rows(); ++i) {
    NURBS_ASSERT(0 <= node[i] && node[i] < nodes, i, node[i], nodes);
    S.insert(i, node[i]) = 1.0;
  }
  if (S.rows() > 0) S.makeCompressed();  // Eigen reads beyond the rows of a matrix without
  return SurfaceMap(S);
}

SurfaceMap SurfaceMap::identity(NodeId nodes) {
  std::vector<NodeId> node(nodes);
  std::iota(node.begin(), node.end(), NodeId(0));
  return selection(node, nodes);
}

bool SurfaceMap::is_selection() const {
  for (NodeId row = 0; row < S_.rows(); ++row) {
    int entries = 0;
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry)
      if (++entries > 1 || entry.value() != 1.0) return false;
  }
  return true;
}

std::vector<NodeId> SurfaceMap::selected_nodes() const {
  if (!is_selection()) throw std::logic_error("expected a surface whose control points are nodes");
  std::vector<NodeId> nodes;
  for (NodeId row = 0; row < S_.rows(); ++row)
    for_each_share(static_cast<int>(row), [&](NodeId node, double) { nodes.push_back(node); });
  if (static_cast<NodeId>(nodes.size()) != S_.rows())
    throw std::logic_error("expected a surface all of whose control points are nodes");
  return nodes;
}

SurfaceMap SurfaceMap::on(const std::vector<NodeId>& nodes, Eigen::Index owned) const {
  std::vector<Eigen::Triplet<double, NodeId>> entries;
  entries.reserve(S_.nonZeros());
  const auto end = nodes.begin() + owned;
  const auto column = [&](NodeId node) {
    const auto held = std::lower_bound(nodes.begin(), end, node);
    return held == end || *held != node ? NodeId(-1) : held - nodes.begin();
  };
  for (NodeId row = 0; row < S_.rows(); ++row) {
    const std::size_t before = entries.size();
    NodeId other = -1;
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry)
      if (const NodeId held = column(entry.col()); held >= 0)
        entries.emplace_back(row, held, entry.value());
      else
        other = entry.col();
    if (other >= 0 && entries.size() > before)
      throw std::invalid_argument("SurfaceMap: a control point of the surface hangs on node " +
                                  std::to_string(other) +
                                  ", which this rank does not own, and on others that it owns");
  }
  Matrix S(S_.rows(), static_cast<NodeId>(nodes.size()));
  if (!entries.empty()) S.setFromTriplets(entries.begin(), entries.end());
  if (S.rows() > 0) S.makeCompressed();
  return SurfaceMap(S);
}

SurfaceMap SurfaceMap::on(const std::vector<NodeId>& nodes) const {
  SurfaceMap held = on(nodes, static_cast<Eigen::Index>(nodes.size()));
  for (int row = 0; row < S_.rows(); ++row)
    if (hangs(row) && !held.hangs(row))
      throw std::invalid_argument("SurfaceMap: the surface hangs on node " +
                                  std::to_string(Matrix::InnerIterator(S_, row).col()) +
                                  ", which this rank does not hold");
  return held;
}

void SurfaceMap::to_surface(const std::vector<int>& control_points, const NodalVectors& nodal,
                            NodalVectors& surface) const {
  NURBS_ASSERT(nodal.cols() == S_.cols() && surface.cols() == S_.rows(), nodal.cols(), S_.cols());
  for (const int row : control_points) surface.col(row) = at(row, nodal);
}

void SurfaceMap::to_surface(const NodalVectors& nodal, NodalVectors& surface) const {
  surface.resize(3, S_.rows());
  to_surface(all(), nodal, surface);
}

void SurfaceMap::add_to_nodes(const std::vector<int>& control_points, const NodalVectors& surface,
                              NodalVectors& nodal) const {
  NURBS_ASSERT(surface.cols() == S_.rows() && nodal.cols() == S_.cols(), surface.cols(), nodal.cols());
  for (const int row : control_points)
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry)
      nodal.col(entry.col()) += entry.value() * surface.col(row);
}

void SurfaceMap::add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const {
  add_to_nodes(all(), surface, nodal);
}

std::vector<Eigen::Index> SurfaceMap::columns_of(const std::vector<NodeId>& nodes) const {
  NodalVectors marks = NodalVectors::Zero(3, node_count());
  add_to_nodes(NodalVectors::Ones(3, control_point_count()), marks);
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] >= 0 && marks(0, nodes[i]) != 0.0) columns.push_back(static_cast<Eigen::Index>(i));
  return columns;
}

void SurfaceMap::nodes_of(const std::vector<int>& control_points, std::vector<Eigen::Index>& nodes) const {
  nodes.clear();
  for (const int row : control_points)
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry) nodes.push_back(entry.col());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

std::vector<int> SurfaceMap::all() const {
  std::vector<int> all(S_.rows());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace coupling
