// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/spin.h"

#include <Eigen/Dense>
#include <array>

namespace structure {

using nurbs::Vector3;

nurbs::Vector3 spin(const nurbs::NodalVectors& x, const nurbs::NodalVectors& v, const Eigen::VectorXd& masses,
                    const Halo& halo) {
  using Moments =
      Eigen::Matrix<double, 3, 7>;  // sums of m x, m v, m, m x x^T, and m x v^T less its transpose
  std::array<ExactSum, Moments::SizeAtCompileTime> sums;
  halo.for_each_run(x.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto m = masses.segment(first, count);
    const auto place = x.middleCols(first, count), velocity = v.middleCols(first, count);
    const nurbs::NodalVectors weighted = place * m.asDiagonal();
    const Eigen::Matrix3d of_momenta = weighted * velocity.transpose();
    Moments run;
    run << weighted.rowwise().sum(), velocity * m, Vector3(m.sum(), 0.0, 0.0), weighted * place.transpose(),
        Vector3(of_momenta(1, 2) - of_momenta(2, 1), of_momenta(2, 0) - of_momenta(0, 2),
                of_momenta(0, 1) - of_momenta(1, 0));
    for (int i = 0; i < Moments::SizeAtCompileTime; ++i) sums[i].add(run.data()[i]);
  });
  halo.sum(sums.data(), sums.size());
  Moments all;
  for (int i = 0; i < Moments::SizeAtCompileTime; ++i) all.data()[i] = sums[i].value();
  const double mass = all(0, 2);
  const Vector3 centre = all.col(0) / mass, momentum = all.col(1);
  const Eigen::Matrix3d second = all.middleCols<3>(3) - mass * centre * centre.transpose();
  const Eigen::Matrix3d inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return inertia.ldlt().solve(Vector3(all.col(6)) - centre.cross(momentum));
}

}  // namespace structure
