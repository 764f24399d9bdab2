// SPDX-License-Identifier: GPL-2.0-or-later
// What a solid's motion adds up to: energies, momenta, displacements of points.
#include <Eigen/Geometry>

#include <algorithm>
#include <array>

#include "structure/time/explicit_solver.h"

namespace structure {

double ExplicitSolver::nodal_sum(const NodalVectors& q) const {
  return halo_->sum_over_nodes(q.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto squares = q.middleCols(first, count).colwise().squaredNorm().transpose();
    return squares.cwiseProduct(mass_->nodal_mass().segment(first, count)).sum();
  });
}

double ExplicitSolver::largest_displacement() const {
  const Eigen::VectorXd lengths = halo_->own(u_).colwise().norm();
  return halo_->largest(lengths.size() > 0 ? lengths.maxCoeff() : 0.0);
}

double ExplicitSolver::kinetic_energy() const {
  if (mass_->is_diagonal()) return 0.5 * nodal_sum(v_);
  NodalVectors p(3, v_.cols());
  mass_->apply_mass(v_, p);
  return 0.5 * halo_->dot(p, v_);
}

double ExplicitSolver::strain_energy() const {
  ExactSum sum = body_->strain_energy_sum(u_);
  springs_.add_energy(u_, halo_->owned(u_.cols()), sum);
  return halo_->total(sum);
}

Vector3 ExplicitSolver::sum_of_own(const std::function<Vector3(Eigen::Index node)>& value) const {
  std::array<ExactSum, 3> sums;
  for (Eigen::Index A = 0; A < halo_->owned(v_.cols()); ++A) {
    const Vector3 term = value(A);
    for (int i = 0; i < 3; ++i) sums[i].add(term[i]);
  }
  halo_->sum(sums.data(), sums.size());
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

Vector3 ExplicitSolver::linear_momentum() const {
  return sum_of_own([&](Eigen::Index A) { return Vector3(mass_->nodal_mass()[A] * v_.col(A)); });
}

Vector3 ExplicitSolver::angular_momentum(const Vector3& about) const {
  NodalVectors p(3, v_.cols());
  mass_->apply_mass(v_, p);
  return sum_of_own([&](Eigen::Index A) { return Vector3((x_.col(A) - about).cross(Vector3(p.col(A)))); });
}

Vector3 ExplicitSolver::displacement(const Probe& probe) const {
  std::array<ExactSum, 3> sums;
  const auto begin = node_ids_.begin(), end = begin + halo_->owned(u_.cols());
  for (std::size_t a = 0; a < probe.nodes.size(); ++a) {
    const auto own = std::lower_bound(begin, end, Id(probe.nodes[a]));
    if (own == end || *own != probe.nodes[a]) continue;
    for (int i = 0; i < 3; ++i) sums[i].add(probe.weights[a] * u_(i, own - begin));
  }
  halo_->sum(sums.data(), sums.size());
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

}  // namespace structure
