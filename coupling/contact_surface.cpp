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

SurfaceMap SurfaceMap::on(const std::vector<NodeId>& nodes) const {
  std::vector<Eigen::Triplet<double, NodeId>> entries;
  entries.reserve(S_.nonZeros());
  for (NodeId row = 0; row < S_.rows(); ++row)
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry) {
      const auto held = std::lower_bound(nodes.begin(), nodes.end(), entry.col());
      if (held == nodes.end() || *held != entry.col())
        throw std::invalid_argument("SurfaceMap: the surface hangs on node " + std::to_string(entry.col()) +
                                    ", which this rank does not hold");
      entries.emplace_back(row, held - nodes.begin(), entry.value());
    }
  Matrix S(S_.rows(), static_cast<NodeId>(nodes.size()));
  if (!entries.empty()) S.setFromTriplets(entries.begin(), entries.end());
  return SurfaceMap(S);
}

void SurfaceMap::to_surface(const NodalVectors& nodal, NodalVectors& surface) const {
  NURBS_ASSERT(nodal.cols() == S_.cols(), nodal.cols(), S_.cols());
  surface.setZero(3, S_.rows());
  for (NodeId row = 0; row < S_.rows(); ++row)
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry)
      surface.col(row) += entry.value() * nodal.col(entry.col());
}

void SurfaceMap::add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const {
  NURBS_ASSERT(surface.cols() == S_.rows() && nodal.cols() == S_.cols(), surface.cols(), nodal.cols());
  for (NodeId row = 0; row < S_.rows(); ++row)
    for (Matrix::InnerIterator entry(S_, row); entry; ++entry)
      nodal.col(entry.col()) += entry.value() * surface.col(row);
}

}  // namespace coupling
