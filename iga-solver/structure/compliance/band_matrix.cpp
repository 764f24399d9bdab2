// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/band_matrix.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace structure {

namespace {

constexpr int kBlock = 48;

}  // namespace

// A block below the diagonal one is stored as a whole: up to half_width + kBlock entries below the diagonal.
void BandMatrix::reset(int rows, int half_width) {
  rows_ = rows;
  half_width_ = half_width;
  stored_ = half_width + kBlock + 1;
  entries_.assign(static_cast<std::size_t>(rows) * stored_, 0.0);
}

int BandMatrix::width_of_block(int first) const { return std::min(kBlock, rows_ - first); }

int BandMatrix::rows_below(int end) const { return std::min(half_width_, rows_ - end); }

bool BandMatrix::factorise() {
  for (int k = 0; k < rows_; k += kBlock) {
    const int width = width_of_block(k), end = k + width, below = rows_below(end);
    Block diagonal = block(k, k, width, width);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>> factor(diagonal);
    if (factor.info() != Eigen::Success) return false;
    if (below == 0) continue;
    Block next = block(end, k, below, width);
    diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(next);
    block(end, end, below, below).selfadjointView<Eigen::Lower>().rankUpdate(next, -1.0);
  }
  return true;
}

void BandMatrix::solve(Eigen::MatrixXd& b) const {
  for (int k = 0; k < rows_; k += kBlock) {
    const int width = width_of_block(k), end = k + width, below = rows_below(end);
    auto x = b.middleRows(k, width);
    const ConstBlock diagonal = block(k, k, width, width);
    diagonal.triangularView<Eigen::Lower>().solveInPlace(x);
    if (below > 0) b.middleRows(end, below).noalias() -= block(end, k, below, width) * x;
  }
  for (int k = (rows_ - 1) / kBlock * kBlock; k >= 0; k -= kBlock) {
    const int width = width_of_block(k), end = k + width, below = rows_below(end);
    auto x = b.middleRows(k, width);
    if (below > 0) x.noalias() -= block(end, k, below, width).transpose() * b.middleRows(end, below);
    const ConstBlock diagonal = block(k, k, width, width);
    diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  }
}

}  // namespace structure
