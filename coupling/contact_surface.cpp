// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact_surface.h"

#include <numeric>

#include "nurbs/assert.h"

namespace coupling {

SurfaceMap SurfaceMap::selection(const std::vector<int>& node, int nodes) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> S(static_cast<int>(node.size()), nodes);
  S.reserve(Eigen::VectorXi::Constant(S.rows(), 1));
  for (int i = 0; i < S.rows(); ++i) {
    NURBS_ASSERT(0 <= node[i] && node[i] < nodes, i, node[i], nodes);
    S.insert(i, node[i]) = 1.0;
  }
  S.makeCompressed();
  return SurfaceMap(S);
}

SurfaceMap SurfaceMap::identity(int nodes) {
  std::vector<int> node(nodes);
  std::iota(node.begin(), node.end(), 0);
  return selection(node, nodes);
}

void SurfaceMap::to_surface(const NodalVectors& nodal, NodalVectors& surface) const {
  NURBS_ASSERT(nodal.cols() == S_.cols(), nodal.cols(), S_.cols());
  surface.setZero(3, S_.rows());
  for (int row = 0; row < S_.rows(); ++row)
    for (decltype(S_)::InnerIterator entry(S_, row); entry; ++entry)
      surface.col(row) += entry.value() * nodal.col(entry.col());
}

void SurfaceMap::add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const {
  NURBS_ASSERT(surface.cols() == S_.rows() && nodal.cols() == S_.cols(), surface.cols(), nodal.cols());
  for (int row = 0; row < S_.rows(); ++row)
    for (decltype(S_)::InnerIterator entry(S_, row); entry; ++entry)
      nodal.col(entry.col()) += entry.value() * surface.col(row);
}

}  // namespace coupling
