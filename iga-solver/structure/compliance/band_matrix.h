// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric positive definite matrix whose entries are 0 far from its diagonal, and its Cholesky factor.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace structure {

class BandMatrix {
 public:
  /// All entries 0; `half_width`: the largest i - j of entries that may differ from it.
  void reset(int rows, int half_width);
  /// An entry, j <= i <= j + half_width.
  double& at(int i, int j) { return entries_[place(i, j)]; }

  /// Puts L of A = L L^T in the place of A, block by block (Golub & Van Loan 2013, sec. 4.3.5); false if A is
  /// not positive definite.
  bool factorise();
  /// x of A x = b in the place of b, any number of columns, once it is factorised.
  void solve(Eigen::MatrixXd& b) const;

 private:
  using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  using ConstBlock = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  // Columns stand below one another from their diagonals on, so a block's next column is one entry nearer.
  std::size_t place(int i, int j) const { return static_cast<std::size_t>(j) * (stored_ - 1) + i; }
  Block block(int i, int j, int rows, int columns) {
    return {&entries_[place(i, j)], rows, columns, Eigen::OuterStride<>(stored_ - 1)};
  }
  ConstBlock block(int i, int j, int rows, int columns) const {
    return {&entries_[place(i, j)], rows, columns, Eigen::OuterStride<>(stored_ - 1)};
  }
  int width_of_block(int first) const;
  int rows_below(int end) const;

  int rows_ = 0, half_width_ = 0;
  int stored_ = 0;  // entries of a column
  std::vector<double> entries_;
};

}  // namespace structure
