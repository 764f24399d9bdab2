// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact_surface.h"

#include <numeric>

namespace coupling {

SurfaceMap SurfaceMap::selection(const std::vector<int>& node, int nodes) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> S(static_cast<int>(node.size()), nodes);
  S.reserve(Eigen::VectorXi::Constant(S.rows(), 1));
  for (int i = 0; i < S.rows(); ++i) S.insert(i, node[i]) = 1.0;
  S.makeCompressed();
  return SurfaceMap(std::move(S));
}

SurfaceMap SurfaceMap::identity(int nodes) {
  std::vector<int> node(nodes);
  std::iota(node.begin(), node.end(), 0);
  return selection(node, nodes);
}

void SurfaceMap::to_surface(const NodalVectors& nodal, NodalVectors& surface) const {
  surface.setZero(3, S_.rows());
  for (int row = 0; row < S_.rows(); ++row)
    for (decltype(S_)::InnerIterator entry(S_, row); entry; ++entry)
      surface.col(row) += entry.value() * nodal.col(entry.col());
}

void SurfaceMap::add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const {
  for (int row = 0; row < S_.rows(); ++row)
    for (decltype(S_)::InnerIterator entry(S_, row); entry; ++entry)
      nodal.col(entry.col()) += entry.value() * surface.col(row);
}

}  // namespace coupling
