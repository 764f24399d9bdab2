// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/nodal_jacobi.h"

#include <Eigen/LU>

#include "structure/analysis/coloured_products.h"

namespace structure {

NodalJacobi::NodalJacobi(const Tangent& tangent)
    : supports_(tangent.supports()), inverse_(nodal_blocks(NodeGraph(tangent.body()), tangent.product())) {
  for (const Eigen::Index dof : supports_.fixed_dofs()) {
    Matrix3& block = inverse_[dof / 3];
    block.row(dof % 3).setZero();
    block.col(dof % 3).setZero();
    block(dof % 3, dof % 3) = 1.0;
  }
  for (Matrix3& block : inverse_) block = block.inverse().eval();
}

void NodalJacobi::apply(const NodalVectors& r, NodalVectors& z) const {
  for (Eigen::Index A = 0; A < r.cols(); ++A) z.col(A).noalias() = inverse_[A] * r.col(A);
  supports_.apply(z);
}

}  // namespace structure
