// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/modal_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace structure {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

VectorXd both(const VectorXd& a, const VectorXd& b) {
  VectorXd all(a.size() + b.size());
  all << a, b;
  return all;
}

double quadratic(const Eigen::MatrixXd& A, const VectorXd& x) { return x.dot(A * x); }

}  // namespace

ModalMotion::ModalMotion(ModalSystem system)
    : system_(std::move(system)),
      q_(VectorXd::Zero(system_.eigenvalues.size())),
      v_(q_),
      s_(motions_at(0.0)),
      support_rates_(VectorXd::Zero(s_.size())),
      slopes_(support_rates_),
      half_rates_(both(q_, slopes_)),
      contacts_(half_rates_),
      loads_(half_rates_) {}

void ModalMotion::set_time_step(double dt) {
  if (!(dt > 0.0 && std::isfinite(dt)))
    throw std::invalid_argument(fmt::format("ModalMotion: time step is {}, expected a number > 0", dt));
  dt_ = dt;
  slowed_ = 0;
  steps_.clear();
  inertia_damping_.resize(mode_count());
  for (Index k = 0; k < mode_count(); ++k) {
    const double stiffness = system_.eigenvalues[k], omega = std::sqrt(stiffness);
    const double slow = std::max(1.0, omega * dt / kMostTurn);  // the same share of critical damping
    const double relative = 2.0 * system_.damping_ratio[k] * omega + system_.viscosity[k];
    inertia_damping_[k] = system_.mass_damping * slow;
    steps_.emplace_back(Oscillator{slow * slow, inertia_damping_[k] + relative * slow, stiffness}, dt);
    slowed_ += slow > 1.0;
  }
}

void ModalMotion::set_state(double time, const VectorXd& q, const VectorXd& v) {
  time_ = time;
  q_ = q;
  v_ = v;
  s_ = motions_at(time);
}

VectorXd ModalMotion::motions_at(double t) const {
  VectorXd s(static_cast<Index>(system_.times.size()));
  for (Index j = 0; j < s.size(); ++j) s[j] = value_at(system_.times[j], t);
  return s;
}

VectorXd ModalMotion::slopes_ahead() const { return (motions_at(time_ + dt_) - s_) / dt_; }

void ModalMotion::initialise_forces(const ModalForces& contacts, const ModalForces& loads) {
  contacts_ = contacts;
  loads_ = loads;
  works_ = {};
  strain_start_ = strain_energy();
}

// What psi have of a force at nodes beyond what the modes have of it works with the supports, which hold
// against it.
void ModalMotion::kick(const ModalForces& contacts, double h) {
  const auto on_modes = contacts.head(mode_count());
  VectorXd gain(mode_count());
  for (Index k = 0; k < mode_count(); ++k) gain[k] = h * on_modes[k] / steps_[k].oscillator().mass;
  const VectorXd on_rest = contacts.tail(motion_count()) - system_.share.transpose() * on_modes;
  const double with_supports = h * on_rest.dot(slopes_);
  book(kContactWork, h * on_modes.dot(v_ + 0.5 * gain) + with_supports);
  book(kSupportWork, -with_supports);
  v_ += gain;
}

void ModalMotion::begin_step(const ModalForces& loads) {
  if (steps_.empty() && mode_count() > 0)
    throw std::logic_error("ModalMotion: begin_step before set_time_step");
  slopes_ = slopes_ahead();
  kick(contacts_, 0.5 * dt_);
  const VectorXd before = q_;
  move_modes(loads, slopes_);
  move_supports(loads, slopes_);
  time_ += dt_;
  half_rates_ = both((q_ - before) / dt_, slopes_);
  loads_ = loads;
}

// Relative to psi, whose velocity is constant over the step.
void ModalMotion::move_modes(const ModalForces& loads, const VectorXd& slopes) {
  double by_loads = 0.0, by_supports = 0.0, damped = 0.0;
  for (Index k = 0; k < mode_count(); ++k) {
    const Oscillator& oscillator = steps_[k].oscillator();
    const double carried = slopes.size() > 0 ? system_.share.row(k).dot(slopes) : 0.0,
                 drag = inertia_damping_[k] * carried, way = dt_ * carried,
                 load = 0.5 * (loads_[k] + loads[k]);
    double q = q_[k], w = v_[k] - carried;
    const double before = oscillator.energy(q, w), w_before = w;
    const double work = steps_[k].advance(loads_[k] - drag, loads[k] - drag, q, w);
    const double moved = q - q_[k];
    by_loads += work + drag * moved + way * load;
    by_supports +=
        carried * (oscillator.mass * (w - w_before) + inertia_damping_[k] * (moved + way) - dt_ * load);
    if (oscillator.damping > 0.0)
      damped += work - (oscillator.energy(q, w) - before) + drag * (2.0 * moved + way);
    q_[k] = q;
    v_[k] = w + carried;
  }
  book(kLoadWork, by_loads);
  book(kSupportWork, by_supports);
  book(kDampedWork, damped);
}

void ModalMotion::move_supports(const ModalForces& loads, const VectorXd& slopes) {
  if (slopes.size() == 0) return;
  const VectorXd mean = 0.5 * (loads_ + loads);
  const VectorXd rest = mean.tail(motion_count()) - system_.share.transpose() * mean.head(mode_count());
  const double by_loads = dt_ * rest.dot(slopes);
  const double damped = dt_ * (system_.mass_damping * quadratic(system_.free_mass, slopes) +
                               quadratic(system_.viscous, slopes));
  const double strain = quadratic(system_.stiffness, s_);
  s_ = motions_at(time_ + dt_);
  book(kLoadWork, by_loads);
  book(kDampedWork, damped);
  book(kSupportWork, 0.5 * (quadratic(system_.stiffness, s_) - strain) + damped - by_loads);
}

// The velocity of a support is the mean of those before and after (support_motion.h).
void ModalMotion::end_step(const ModalForces& contacts) {
  contacts_ = contacts;
  kick(contacts_, 0.5 * dt_);
  if (motion_count() == 0) return;
  const double kinetic = quadratic(system_.mass, support_rates_);
  support_rates_ = 0.5 * (slopes_ + slopes_ahead());
  book(kSupportWork, 0.5 * (quadratic(system_.mass, support_rates_) - kinetic));
}

VectorXd ModalMotion::coordinates() const { return both(q_, s_); }

VectorXd ModalMotion::rates() const { return both(v_ - system_.share * support_rates_, support_rates_); }

VectorXd ModalMotion::support_accelerations() const {
  if (dt_ == 0.0) return VectorXd::Zero(motion_count());
  return 2.0 / dt_ * (slopes_ahead() - support_rates_);
}

double ModalMotion::kinetic_energy() const {
  double sum = quadratic(system_.mass, support_rates_);
  for (Index k = 0; k < mode_count(); ++k)
    sum += (steps_.empty() ? 1.0 : steps_[k].oscillator().mass) * v_[k] * v_[k];
  return 0.5 * sum;
}

double ModalMotion::strain_energy() const {
  return 0.5 * (q_.cwiseAbs2().dot(system_.eigenvalues) + quadratic(system_.stiffness, s_));
}

Work ModalMotion::work() const {
  return {strain_energy() - strain_start_, works_[kLoadWork].value(), works_[kContactWork].value(),
          works_[kSupportWork].value(), works_[kDampedWork].value()};
}

std::vector<double> ModalMotion::save() const {
  std::vector<double> state{time_};
  for (const VectorXd* values : {&q_, &v_, &support_rates_})
    state.insert(state.end(), values->begin(), values->end());
  return state;
}

void ModalMotion::load(const double* state) {
  set_state(state[0], VectorXd::Map(state + 1, mode_count()),
            VectorXd::Map(state + 1 + mode_count(), mode_count()));
  support_rates_ = VectorXd::Map(state + 1 + 2 * mode_count(), motion_count());
}

}  // namespace structure
