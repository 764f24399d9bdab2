// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/rigid_motions.h"

#include <Eigen/Dense>

namespace structure {

std::array<NodalVectors, 6> rigid_motions(const NodalVectors& reference) {
  const Vector3 middle = reference.rowwise().mean();
  const NodalVectors arms = reference.colwise() - middle;
  const double size = arms.colwise().norm().maxCoeff();
  std::array<NodalVectors, 6> motions;
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = Vector3::Unit(i);
    motions[i] = axis.replicate(1, reference.cols());
    motions[3 + i].resize(3, reference.cols());
    for (Eigen::Index A = 0; A < arms.cols(); ++A)
      motions[3 + i].col(A) = axis.cross(Vector3(arms.col(A))) / size;
  }
  return motions;
}

std::vector<NodalVectors> free_rigid_motions(const NodalVectors& positions, const Supports& supports) {
  const std::array<NodalVectors, 6> motions = rigid_motions(positions);
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Eigen::Index dof : supports.fixed_dofs()) {
    Eigen::Matrix<double, 6, 1> at_dof;
    for (int k = 0; k < 6; ++k) at_dof[k] = motions[k].data()[dof];
    held += at_dof * at_dof.transpose();
  }
  constexpr double kNone = 1e-10;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(held);
  std::vector<NodalVectors> free;
  for (int m = 0; m < 6; ++m) {
    if (solver.eigenvalues()[m] > kNone * solver.eigenvalues()[5]) break;
    NodalVectors& motion = free.emplace_back(NodalVectors::Zero(3, positions.cols()));
    for (int k = 0; k < 6; ++k) motion += solver.eigenvectors()(k, m) * motions[k];
    supports.apply(motion);  // rounding
  }
  return free;
}

}  // namespace structure
