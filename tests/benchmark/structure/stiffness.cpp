// SPDX-License-Identifier: GPL-2.0-or-later
#include "stiffness.h"

#include <algorithm>

#include "gauss_loop.h"

namespace benchmarks {

using Eigen::MatrixXd;
using nurbs::KnotVector;

namespace {

/// Functions that share an element with each function of one direction: the first, and one beyond the last.
struct Neighbours {
  explicit Neighbours(const KnotVector& knots)
      : first(knots.control_point_count(), knots.control_point_count()), end(first.size(), 0) {
    for (int e = 0; e < knots.element_count(); ++e) {
      const int last = knots.span_of_element(e), low = last - knots.degree();
      for (int i = low; i <= last; ++i) {
        first[i] = std::min(first[i], low);
        end[i] = last + 1;
      }
    }
  }
  std::vector<int> first, end;
};

/// All blocks, 0.
BlockMatrix pattern(const nurbs::Space<3>& space) {
  const Neighbours x(space.knots(0)), y(space.knots(1)), z(space.knots(2));
  const int nx = space.control_point_count(0), ny = space.control_point_count(1);
  BlockMatrix K;
  for (int A = 0; A < space.control_point_count(); ++A) {
    const int i = A % nx, j = A / nx % ny, k = A / nx / ny;
    K.begin.push_back(static_cast<int>(K.column.size()));
    for (int c = z.first[k]; c < z.end[k]; ++c)
      for (int b = y.first[j]; b < y.end[j]; ++b)
        for (int a = x.first[i]; a < x.end[i]; ++a) K.column.push_back(a + nx * (b + ny * c));
  }
  K.begin.push_back(static_cast<int>(K.column.size()));
  K.values.assign(9 * K.column.size() + 1, 0.0);
  return K;
}

void add_element(const Gradients& G, double lambda, double mu, BlockMatrix& K) {
  MatrixXd M[3][3];  // M[i][j](A, B) = integral of dR_A/dX_i dR_B/dX_j
  for (int i = 0; i < 3; ++i) {
    const MatrixXd weighted = G.along[i] * G.wJ.asDiagonal();
    for (int j = 0; j < 3; ++j) M[i][j].noalias() = weighted * G.along[j].transpose();
  }
  const auto count = static_cast<int>(G.nodes.size());
  for (int a = 0; a < count; ++a) {
    const auto first = K.column.begin() + K.begin[G.nodes[a]],
               end = K.column.begin() + K.begin[G.nodes[a] + 1];
    for (int b = 0; b < count; ++b) {
      const auto place = std::lower_bound(first, end, G.nodes[b]) - K.column.begin();
      double* block = &K.values[9 * place];
      const double laplace = mu * (M[0][0](a, b) + M[1][1](a, b) + M[2][2](a, b));
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          block[3 * j + i] += lambda * M[i][j](a, b) + mu * M[j][i](a, b) + (i == j ? laplace : 0.0);
    }
  }
}

}  // namespace

BlockMatrix assemble_stiffness(const nurbs::Volume& volume, double lambda, double mu) {
  BlockMatrix K = pattern(volume.space);
  for (int e = 0; e < volume.space.element_count(); ++e)
    add_element(gradients(volume, e, Rule::full), lambda, mu, K);
  return K;
}

CsrMatrix to_csr(const BlockMatrix& K) {
  const BlockRows rows = K.view();
  CsrMatrix result(3 * rows.rows, 3 * rows.rows);
  result.reserve(static_cast<Eigen::Index>(9 * K.blocks()));
  for (int row = 0; row < 3 * rows.rows; ++row) {
    result.startVec(row);
    for (int block = rows.begin[row / 3]; block < rows.begin[row / 3 + 1]; ++block)
      for (int j = 0; j < 3; ++j)
        result.insertBack(row, 3 * rows.column[block] + j) =
            rows.values[9 * std::size_t(block) + 3 * j + row % 3];
  }
  result.finalize();
  return result;
}

}  // namespace benchmarks
