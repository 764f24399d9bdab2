// SPDX-License-Identifier: GPL-2.0-or-later
// The stiffness matrix of a linear elastic body, assembled: the peers multiply by it.
//   K_AB = integral of lambda dR_A (x) dR_B + mu (dR_B (x) dR_A + (dR_A . dR_B) I),  dR = dR/dX
// Source: Hughes, The Finite Element Method (2000), eq. 2.8.5, in index form instead of B^T D B.
#pragma once

#include <Eigen/SparseCore>

#include <vector>

#include "machine_kernels.h"
#include "nurbs/patch.h"

namespace benchmarks {

/// Compressed rows of 3 x 3 blocks; columns rise within a row.
struct BlockMatrix {
  std::vector<int> begin;      ///< [node row + 1] into `column`
  std::vector<int> column;     ///< [block] node
  std::vector<double> values;  ///< [block][column of it][row of it], and one number to load beyond the last

  BlockRows view() const {
    return {static_cast<int>(begin.size()) - 1, begin.data(), column.data(), values.data()};
  }
  std::size_t blocks() const { return column.size(); }
};

/// By gauss_loop.h, p + 1 points per direction and element; Lame constants [stress].
BlockMatrix assemble_stiffness(const nurbs::Volume& volume, double lambda, double mu);

using CsrMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
/// The same numbers in Eigen's format.
CsrMatrix to_csr(const BlockMatrix& K);

}  // namespace benchmarks
