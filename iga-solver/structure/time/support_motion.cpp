// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/support_motion.h"

#include <algorithm>

namespace structure {

SupportMotion::SupportMotion(const Supports& supports) {
  for (const Motion& motion : supports.motions()) {
    for (std::size_t i = 0; i < motion.dofs.size(); ++i)
      moved_.push_back({motion.dofs[i], times_.size(), motion.size[i]});
    times_.push_back(motion.time);
  }
  std::sort(moved_.begin(), moved_.end(), [](const Dof& a, const Dof& b) { return a.dof < b.dof; });
  factors_.resize(times_.size());
}

void SupportMotion::find_factors(double t) {
  for (std::size_t k = 0; k < times_.size(); ++k) factors_[k] = value_at(times_[k], t);
}

void SupportMotion::place(double t, const NodalVectors& reference, NodalVectors& u, NodalVectors& x) {
  find_factors(t);
  for (const Dof& d : moved_) {
    u.data()[d.dof] = d.size * factors_[d.motion];
    x.data()[d.dof] = reference.data()[d.dof] + u.data()[d.dof];
  }
}

// From v(n) alone, so that a run that begins here goes on with the same accelerations.
void SupportMotion::find_velocities(double t_next, double dt, bool holds_half, const NodalVectors& u,
                                    NodalVectors& v) {
  find_factors(t_next);
  for (Dof& d : moved_) {
    const double next = (d.size * factors_[d.motion] - u.data()[d.dof]) / dt, now = v.data()[d.dof];
    d.velocity = holds_half ? 0.5 * (now + next) : now;
    d.acceleration = 2.0 * (next - d.velocity) / dt;
  }
  set_velocities(v);
}

void SupportMotion::set_accelerations(NodalVectors& a) const {
  for (const Dof& d : moved_) a.data()[d.dof] = d.acceleration;
}

void SupportMotion::add_accelerations(Eigen::Index first, Eigen::Index count, const NodalForces& f,
                                      const MassOperator& mass, NodalVectors& a, ForceSums& sums) const {
  const auto begin = std::lower_bound(moved_.begin(), moved_.end(), 3 * first,
                                      [](const Dof& d, Eigen::Index dof) { return d.dof < dof; });
  for (auto d = begin; d != moved_.end() && d->dof < 3 * (first + count); ++d) {
    const double internal = f.internal.data()[d->dof], loads = f.loads.data()[d->dof],
                 forces = f.forces.data()[d->dof], inertia = mass.inertia_of_support(d->dof, d->acceleration);
    a.data()[d->dof] = d->acceleration;
    sums.f_a[kInternal] += internal * d->acceleration;
    sums.f_a[kLoads] += loads * d->acceleration;
    sums.f_a[kForces] += forces * d->acceleration;
    const double support = inertia + internal - loads - forces;
    sums.f_v[kSupports] += support * d->velocity;
    sums.f_a[kSupports] += support * d->acceleration;
  }
}

void SupportMotion::set_velocities(NodalVectors& v) const {
  for (const Dof& d : moved_) v.data()[d.dof] = d.velocity;
}

}  // namespace structure
