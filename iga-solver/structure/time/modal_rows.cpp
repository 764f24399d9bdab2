// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/modal_rows.h"

#include <numeric>

namespace structure {

ModalRows::ModalRows(const std::vector<NodalVectors>& shapes)
    : count_(static_cast<Eigen::Index>(shapes.size())),
      rows_(Eigen::MatrixXd::Zero((count_ + kLanes - 1) / kLanes * kLanes,
                                  shapes.empty() ? 0 : shapes.front().size())) {
  for (Eigen::Index k = 0; k < count_; ++k) rows_.row(k) = shapes[k].reshaped().transpose();
}

Eigen::VectorXd ModalRows::padded(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(rows_.rows());
  all.head(count_) = coordinates;
  return all;
}

// Lane by lane: the same order of sums wherever a row stands.
void ModalRows::at(Eigen::Index node, const Eigen::VectorXd& a, const Eigen::VectorXd& b, Vector3& of_a,
                   Vector3& of_b) const {
  using Lanes = Eigen::Array<double, kLanes, 1>;
  const auto lanes = [](const double* values) { return Eigen::Map<const Lanes>(values); };
  for (int i = 0; i < 3; ++i) {
    const double* const row = rows_.data() + (3 * node + i) * rows_.rows();
    Lanes sum_a = Lanes::Zero(), sum_b = Lanes::Zero();
    for (Eigen::Index k = 0; k < rows_.rows(); k += kLanes) {
      const Lanes here = lanes(row + k);
      sum_a += here * lanes(a.data() + k);
      sum_b += here * lanes(b.data() + k);
    }
    of_a[i] = sum_a.sum();
    of_b[i] = sum_b.sum();
  }
}

// Plain sums within a run of nodes, exact ones of the runs.
Eigen::VectorXd ModalRows::project(const NodalVectors& f, const std::vector<Eigen::Index>& touched,
                                   const Halo& halo) const {
  std::vector<ExactSum> sums(count_);
  auto next = touched.begin();
  halo.for_each_run(f.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto begin = std::lower_bound(next, touched.end(), first);
    Eigen::VectorXd of_run = Eigen::VectorXd::Zero(rows_.rows());
    for (next = begin; next != touched.end() && *next < first + count; ++next)
      for (int i = 0; i < 3; ++i) of_run += f(i, *next) * rows_.col(3 * *next + i);
    if (next == begin) return;
    for (Eigen::Index k = 0; k < count_; ++k) sums[k].add(of_run[k]);
  });
  halo.sum(sums.data(), sums.size());
  Eigen::VectorXd forces(count_);
  for (Eigen::Index k = 0; k < count_; ++k) forces[k] = sums[k].value();
  return forces;
}

Eigen::VectorXd ModalRows::project(const NodalVectors& f, const Halo& halo) const {
  std::vector<Eigen::Index> all(halo.owned(f.cols()));
  std::iota(all.begin(), all.end(), Eigen::Index(0));
  return project(f, all, halo);
}

NodalVectors ModalRows::squares(Eigen::Index shapes) const {
  NodalVectors sums(3, rows_.cols() / 3);
  for (Eigen::Index dof = 0; dof < rows_.cols(); ++dof)
    sums.data()[dof] = rows_.col(dof).head(shapes).squaredNorm();
  return sums;
}

}  // namespace structure
