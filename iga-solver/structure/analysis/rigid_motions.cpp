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

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Motions = std::array<NodalVectors, 6>;

/// Motions' products at the degrees of freedom that the supports hold.
Matrix6 held_by(const Supports& supports, const Motions& motions) {
  Matrix6 held = Matrix6::Zero();
  for (const Eigen::Index dof : supports.fixed_dofs()) {
    Eigen::Matrix<double, 6, 1> at_dof;
    for (int k = 0; k < 6; ++k) at_dof[k] = motions[k].data()[dof];
    held += at_dof * at_dof.transpose();
  }
  return held;
}

/// The springs' stiffness for the motions, where the supports leave the body free.
Matrix6 held_by(const Springs& springs, const Supports& supports, Motions motions) {
  for (NodalVectors& motion : motions) supports.apply(motion);
  Matrix6 stiffness;
  for (int k = 0; k < 6; ++k) {
    NodalVectors force = NodalVectors::Zero(3, motions[k].cols());
    springs.add_forces(motions[k], force);
    for (int j = 0; j < 6; ++j) stiffness(j, k) = motions[j].cwiseProduct(force).sum();
  }
  return stiffness;
}

Matrix6 relative(const Matrix6& held) {
  const double size = held.trace();
  return size > 0.0 ? Matrix6(held / size) : held;
}

}  // namespace

std::vector<NodalVectors> free_rigid_motions(const NodalVectors& positions, const Supports& supports,
                                             const Springs& springs) {
  const Motions motions = rigid_motions(positions);
  Matrix6 held = held_by(supports, motions);
  if (!springs.empty()) held = relative(held) + relative(held_by(springs, supports, motions));
  constexpr double kNone = 1e-10;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(held);
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
