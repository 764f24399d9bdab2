// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/substeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "coupling/two_masses.h"
#include "structure/time/stable_time_step.h"

namespace coupling {

namespace {

using structure::damped_stable_step;
using structure::step_text;
using Fast = SubstepOptions::Fast;

/// `auto` takes the stiffest contact to last 100 particle steps: Hertz' force is stiffest at the largest
/// overlap, where sqrt(k/m) is 4.03 over the duration of the contact.
constexpr double kContactAngle = 4.03 / 100.0;
/// Damping ratio of the mode that turns by pi in a particle step, with a fast structure; in proportion to the
/// frequency.
constexpr double kDamping = 0.02;

/// How much later the displacements are that internal forces belong to, with a fast structure.
double lead(double dt) { return 2.0 * kDamping / nurbs::kPi * dt; }

}  // namespace

Substeps::Substeps(std::unique_ptr<IgaStructure> body, SubstepOptions options)
    : body_(std::move(body)),
      solver_(body_->solver()),
      options_(std::move(options)),
      surface_nodes_(body_->surface().map.columns_of(body_->nodes())),
      spread_(solver_),
      F_(NodalVectors::Zero(3, solver_.positions().cols())),
      no_forces_(F_),
      contacts_(F_),
      x_(body_->positions()),
      v_(body_->velocities()),
      du_(F_.values),
      dv_(F_.values),
      J_(F_.values),
      a_(F_.values) {
  if (!options_.count) solver_.go_on_when_strained();
}

void Substeps::set_time_step(double dt) {
  if (done_ > 0) {
    if (dt != dt_)
      throw std::invalid_argument(fmt::format(
          "timestep {:.6g} comes within an outer step of {} particle steps of {:.6g}, of which {} "
          "are done: change it {} steps later",
          dt, count_, dt_, done_, count_ - done_));
    return take_steps(dt);
  }
  stable_ = body_->stable_time_step();
  if (!options_.count) stable_ = std::min(stable_, solver_.renew_stable_time_step());
  const auto shares = [this] { return std::tuple(particles_fast(), count_, spreads_); };
  const auto before = shares();
  const NodalForces forces = particles_fast() ? F_ : contacts_;
  choose(dt);
  take_steps(dt);
  if (shares() != before) kick_from_now(forces);
}

void Substeps::choose(double dt) {
  fast_ = options_.fast;
  if (fast_ == Fast::by_time_step) fast_ = dt > stable_ ? Fast::structure : Fast::particles;
  count_ = options_.count ? *options_.count : particles_fast() ? particle_steps(dt) : structure_steps(dt);
  spreads_ = !particles_fast() && count_ > 1 && needs_spread(dt);
}

// Damping alone costs nothing, but heavy particles make vibrations grow all the same.  Growth is largest
// close to the body's stable step, so `auto` may take some steps more.
bool Substeps::needs_spread(double dt) {
  const TwoMasses highest{2.0 / stable_, kContactAngle / dt, heaviest_ratio()};
  if (highest.mass_ratio == 0.0) return false;  // no particles yet: the next run knows more
  const auto grows = [&](int count, bool spread) {
    return most_growth_of_structure_substeps(highest, dt, count, lead(dt), spread);
  };
  const double damped = grows(count_, false);
  if (damped <= kMostGrowth) return false;
  const int most = options_.count ? count_ : std::min(count_ + 4, kMostSubsteps);
  for (int count = count_; structure::is_linear(solver_.body()) && count <= most; ++count) {
    if (grows(count, true) > kMostGrowth) continue;
    count_ = count;
    return true;
  }
  if (!options_.count)
    throw std::invalid_argument(
        fmt::format("substeps auto: with timestep {:.6g} and {} steps of the structure in it contacts may "
                    "make vibrations grow by {:.2g} per step, expected at most {:.0g}; use a timestep of at "
                    "most {:.3g}, or 'substeps structure {}' to take that",
                    dt, count_, damped, kMostGrowth, 0.9 * stable_, count_));
  return false;
}

void Substeps::take_steps(double dt) {
  dt_ = dt;
  const bool damped = !particles_fast() && count_ > 1;
  const double stable = damped_stable_step(body_->stable_time_step(), damped ? lead(dt) : 0.0),
               step = particles_fast() ? count_ * dt : dt / count_;
  if (step > stable)
    throw std::invalid_argument(
        fmt::format("{}: that is above its stable step {}{}", describe_step(), step_text(stable),
                    !particles_fast() ? fmt::format("; use at least {:.0f}", std::ceil(dt / stable))
                    : dt > stable     ? "; use 'substeps structure auto'"
                                      : fmt::format("; use at most {:.0f}", std::floor(stable / dt))));
  solver_.set_lead(damped ? lead(dt) : 0.0);
  body_->set_time_step(step);
}

void Substeps::choose_again(const NodalForces& forces) {
  stable_ = solver_.stable_time_step_now();
  choose(dt_);
  take_steps(dt_);
  change_ = fmt::format("{}, since strain has brought its stable step down to {}", describe_step(),
                        step_text(stable_));
  if (!particles_fast()) kick_from_now(forces);
}

// Of a particle's mass to that of a node of the surface: the heaviest and the lightest.
double Substeps::heaviest_ratio() const {
  double inverse = 0.0;
  for (const Eigen::Index A : surface_nodes_)
    inverse = std::max(inverse, solver_.mass().inverse_mass().col(A).maxCoeff());
  return options_.heaviest_particle() * solver_.halo().largest(inverse);
}

int Substeps::particle_steps(double dt) const {
  if (dt > stable_)
    throw std::invalid_argument(
        fmt::format("substeps particles auto: timestep {:.6g} is above the structure's stable step {}; "
                    "use a timestep of at most {:.3g}, or 'substeps auto'",
                    dt, step_text(stable_), 0.9 * stable_));
  const double ratio = heaviest_ratio();
  if (ratio == 0.0) return 1;  // no particles yet: the next run knows more
  const int most = static_cast<int>(std::min<double>(stable_ / dt, kMostSubsteps));
  return most_particle_substeps({2.0 / stable_, kContactAngle / dt, ratio}, dt, most);
}

int Substeps::structure_steps(double dt) const {
  if (dt <= stable_) return 1;
  const double steps = std::ceil(dt / damped_stable_step(stable_, lead(dt)));
  if (!(steps <= kMostSubsteps))
    throw std::invalid_argument(fmt::format(
        "substeps auto: timestep {:.6g} needs {:.6g} steps of the structure, whose stable step is "
        "{}, expected at most {}",
        dt, steps, step_text(stable_), kMostSubsteps));
  return static_cast<int>(steps);
}

std::string Substeps::describe_step() const {
  if (particles_fast())
    return fmt::format("substeps particles {}: the structure takes one step of {:.6g} in {} particle steps",
                       count_, count_ * dt_, count_);
  return fmt::format("substeps structure {}: the structure takes {} steps of {:.6g} in a particle step{}",
                     count_, count_, dt_ / count_, spreads_ ? ", contacts are spread over its waves" : "");
}

void Substeps::initialise_forces(const NodalForces& forces) {
  if (!particles_fast()) {
    body_->initialise_forces(forces);
    contacts_ = forces;
    if (count_ > 1) kick_from_now(forces);
    return;
  }
  body_->initialise_forces(no_forces_);
  take_contacts(forces);
  solver_.press_on_supports(F_.values, 1.0);
  place_surface();
}

void Substeps::begin_step() {
  is_within_step_ = true;
  if (particles_fast()) {
    kick_by_contact();
    drift_by_contact();
    ++done_;
    return place_surface();
  }
  x_ = body_->positions();
  solver_.follow_spin();
  body_->begin_step();
  for (int i = 1; i < count_; ++i) {
    solver_.press_evenly(contacts_.values, no_forces_.values);
    body_->end_step(no_forces_);
    body_->begin_step();
  }
  v_ = (body_->positions() - x_) / dt_;
}

void Substeps::end_step(const NodalForces& forces) {
  is_within_step_ = false;
  if (!particles_fast()) {
    set_impulse(forces);
    if (count_ > 1) solver_.press_evenly(contacts_.values, F_.values);
    body_->end_step(F_);
  } else {
    take_contacts(forces);
    kick_by_contact();
    if (done_ == count_) end_outer_step();
    place_surface();
  }
  if (done_ == 0 && solver_.is_too_strained()) choose_again(forces);
}

void Substeps::end_outer_step() {
  body_->begin_step();
  solver_.add_motion(du_, dv_, J_);
  body_->end_step(no_forces_);
  done_ = 0;
  for (NodalVectors* sum : {&du_, &dv_, &J_}) sum->setZero();
}

// Between steps, the last forces were these: contacts kick the body by as much as before, if in other shares.
void Substeps::kick_from_now(const NodalForces& forces) {
  if (particles_fast()) {
    solver_.change_forces(no_forces_.values);
    take_contacts(forces);
    return place_surface();
  }
  set_impulse(forces);
  solver_.change_forces(F_.values);
  if (count_ > 1) solver_.press_evenly(contacts_.values, F_.values);
}

// From the forces of the step: two half kicks of dt/count, which are to be those of dt.
void Substeps::set_impulse(const NodalForces& forces) {
  contacts_ = forces;
  F_.values = count_ * forces.values;
  if (spreads_) spread_.apply(F_.values, dt_ / count_, count_);
}

// For two half kicks: the second of this particle step and the first of the next.
void Substeps::take_contacts(const NodalForces& forces) {
  const structure::Halo& halo = solver_.halo();
  const structure::MassOperator& mass = solver_.mass();
  F_.touched = forces.touched;
  for (const Eigen::Index A : surface_nodes_) F_.values.col(A) = forces.values.col(A);
  halo.owners_to_ghosts(F_.values);
  if (mass.is_diagonal()) {
    for (const Eigen::Index A : surface_nodes_)
      a_.col(A) = mass.inverse_mass().col(A).cwiseProduct(F_.values.col(A));
  } else if (halo.any(!F_.touched.empty())) {
    mass.apply_inverse_mass(F_.values, a_);
    halo.owners_to_ghosts(a_);
  } else {
    a_.setZero();
  }
}

void Substeps::kick_by_contact() {
  const double h = 0.5 * dt_;
  for (const Eigen::Index A : surface_nodes_) J_.col(A) += h * F_.values.col(A);
  if (!solver_.mass().is_diagonal()) {
    dv_ += h * a_;
    return;
  }
  for (const Eigen::Index A : surface_nodes_) dv_.col(A) += h * a_.col(A);
}

void Substeps::drift_by_contact() {
  if (!solver_.mass().is_diagonal()) {
    du_ += dt_ * dv_;
    return;
  }
  for (const Eigen::Index A : surface_nodes_) du_.col(A) += dt_ * dv_.col(A);
}

// Until the outer step ends the body stands where it began: places have had the half kick of internal forces
// since, and those of contacts.  Velocities have as much of both as the time since then gives.
void Substeps::place_surface() {
  const double half_step = done_ > 0 ? 0.5 * count_ * dt_ : 0.0, since = done_ * dt_,
               pushed = is_within_step_ ? since - 0.5 * dt_ : since;
  for (const Eigen::Index A : surface_nodes_) {
    const Vector3 v = solver_.velocities().col(A), a = solver_.accelerations().col(A);
    v_.col(A) = v + pushed * a + dv_.col(A);
    x_.col(A) = solver_.positions().col(A) + since * (v + half_step * a) + du_.col(A);
  }
}

std::vector<double> Substeps::save() const {
  std::vector<double> state = body_->save();
  if (done_ == 0) return state;
  state.insert(state.end(), {static_cast<double>(done_), static_cast<double>(count_), dt_});
  for (const NodalVectors* values : {&du_, &dv_, &J_}) {
    const std::vector<double> rows = solver_.in_order(*values);
    state.insert(state.end(), rows.begin(), rows.end());
  }
  return state;
}

void Substeps::load(const std::vector<double>& state) {
  const std::size_t motion = 3 * solver_.all_nodes(), of_outer_step = 3 + 3 * motion,
                    own = state.size() - std::min(state.size(), of_outer_step);
  if (!solver_.can_load(own)) {
    body_->load(state);
    done_ = 0;
  } else {
    body_->load({state.begin(), state.begin() + own});
    if (options_.fast == Fast::structure)
      throw std::invalid_argument(
          "the state stands within an outer step of fast particles, expected 'substeps particles' or "
          "'substeps auto'");
    fast_ = Fast::particles;
    done_ = static_cast<int>(saved_size(state[own], kMostSubsteps));
    count_ = static_cast<int>(saved_size(state[own + 1], kMostSubsteps));
    if (done_ == 0 || done_ >= count_) fail_as_damaged();
    if (options_.count.value_or(count_) != count_)
      throw std::invalid_argument(fmt::format(
          "the state stands within an outer step of {} particle steps, expected 'substeps particles {}' "
          "or 'substeps auto'",
          count_, count_));
    dt_ = state[own + 2];
    solver_.from_order(state.data() + own + 3, du_);
    solver_.from_order(state.data() + own + 3 + motion, dv_);
    solver_.from_order(state.data() + own + 3 + 2 * motion, J_);
  }
  x_ = body_->positions();
  v_ = body_->velocities();
  place_surface();
}

std::unique_ptr<StructureSolver> with_substeps(std::unique_ptr<StructureSolver> solver,
                                               SubstepOptions options) {
  if (solver->take_substeps(options)) return solver;
  auto* const body = dynamic_cast<IgaStructure*>(solver.get());
  if (!body)
    throw std::invalid_argument("'substeps' are those of a deforming wall, expected 'structure FILE'");
  static_cast<void>(solver.release());
  return std::make_unique<Substeps>(std::unique_ptr<IgaStructure>(body), std::move(options));
}

}  // namespace coupling
