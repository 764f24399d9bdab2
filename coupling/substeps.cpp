// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/substeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupling/two_masses.h"

namespace coupling {

namespace {

using Fast = SubstepOptions::Fast;

constexpr double kPi = 3.14159265358979323846;
/// `auto` takes the stiffest contact to last 100 particle steps: Hertz' force is stiffest at the largest
/// overlap, where sqrt(k/m) is 4.03 over the duration of the contact.
constexpr double kContactAngle = 4.03 / 100.0;
/// Damping ratio of the mode that turns by pi in a particle step, with a fast structure; in proportion to the
/// frequency.
constexpr double kDamping = 0.02;

/// How much later the displacements are that internal forces belong to, with a fast structure.
double lead(double dt) { return 2.0 * kDamping / kPi * dt; }

/// The stable step of a body that is damped so: (omega h)^2 + 2 omega^2 lead h = 4 bounds the step h.
double damped_stable_step(double stable, double lead) {
  return std::sqrt(stable * stable + lead * lead) - lead;
}

/// Columns of the nodes that the surface hangs on.
std::vector<Eigen::Index> surface_nodes(const StructureSolver& body) {
  const SurfaceMap& map = body.surface().map;
  NodalVectors marks = NodalVectors::Zero(3, map.node_count());
  map.add_to_nodes(NodalVectors::Ones(3, map.control_point_count()), marks);
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < body.nodes().size(); ++i)
    if (body.nodes()[i] >= 0 && marks(0, body.nodes()[i]) != 0.0)
      columns.push_back(static_cast<Eigen::Index>(i));
  return columns;
}

}  // namespace

Substeps::Substeps(std::unique_ptr<IgaStructure> body, SubstepOptions options)
    : body_(std::move(body)),
      solver_(body_->solver()),
      options_(std::move(options)),
      surface_nodes_(surface_nodes(*body_)),
      F_(NodalVectors::Zero(3, solver_.positions().cols())),
      no_forces_(F_),
      x_(body_->positions()),
      v_(body_->velocities()),
      du_(F_.values),
      dv_(F_.values) {}

void Substeps::set_time_step(double dt) {
  if (done_ > 0) {
    if (dt != dt_)
      throw std::invalid_argument(fmt::format(
          "timestep {:.6g} comes within an outer step of {} particle steps of {:.6g}, of which {} "
          "are done: change it {} steps later",
          dt, count_, dt_, done_, count_ - done_));
  } else {
    choose(dt);
  }
  dt_ = dt;
  const double stable = body_->stable_time_step();
  const bool damped = !particles_fast() && count_ > 1;
  if (damped && dt / count_ > damped_stable_step(stable, lead(dt)))
    throw std::invalid_argument(
        fmt::format("{}: that is above its stable step {:.6g}, less what damping takes; use at least {:.0f}",
                    describe_step(), stable, std::ceil(dt / damped_stable_step(stable, lead(dt)))));
  if (particles_fast() && count_ * dt > stable)
    throw std::invalid_argument(fmt::format("{}: that is above its stable step {:.6g}; use at most {:.0f}",
                                            describe_step(), stable, std::max(1.0, std::floor(stable / dt))));
  solver_.set_lead(damped ? lead(dt) : 0.0);
  body_->set_time_step(particles_fast() ? count_ * dt : dt / count_);
}

void Substeps::choose(double dt) {
  fast_ = options_.fast;
  if (fast_ == Fast::by_time_step) fast_ = dt > body_->stable_time_step() ? Fast::structure : Fast::particles;
  count_ = options_.count ? *options_.count : particles_fast() ? particle_steps(dt) : structure_steps(dt);
}

// Of a particle's mass to that of a node of the surface: the heaviest and the lightest.
double Substeps::heaviest_ratio() const {
  double inverse = 0.0;
  for (const Eigen::Index A : surface_nodes_)
    inverse = std::max(inverse, solver_.inverse_mass().col(A).maxCoeff());
  return options_.heaviest_particle() * solver_.halo().largest(inverse);
}

int Substeps::particle_steps(double dt) const {
  const double ratio = heaviest_ratio(), stable = body_->stable_time_step();
  if (ratio == 0.0) return 1;  // no particles yet: the next run knows more
  const int most = static_cast<int>(std::clamp<double>(stable / dt, 1.0, kMostSubsteps));
  return most_particle_substeps({2.0 / stable, kContactAngle / dt, ratio}, dt, most);
}

int Substeps::structure_steps(double dt) const {
  const double stable = body_->stable_time_step();
  if (dt <= stable) return 1;
  const double steps = std::ceil(dt / damped_stable_step(stable, lead(dt)));
  if (!(steps <= kMostSubsteps))
    throw std::invalid_argument(fmt::format(
        "substeps auto: timestep {:.6g} needs {:.6g} steps of the structure, whose stable step is "
        "{:.6g}, expected at most {}",
        dt, steps, stable, kMostSubsteps));
  const int count = static_cast<int>(steps);
  const double most = most_growth_of_structure_substeps({2.0 / stable, kContactAngle / dt, heaviest_ratio()},
                                                        dt, count, lead(dt));
  if (most > kMostGrowth)
    throw std::invalid_argument(fmt::format(
        "substeps auto: with timestep {:.6g} and {} steps of the structure in it contacts may make "
        "vibrations "
        "grow by {:.2g} per step, expected at most {:.0g}; use a timestep of at most {:.3g}, or 'substeps "
        "structure {}' to take that",
        dt, count, most, kMostGrowth, 0.9 * stable, count));
  return count;
}

std::string Substeps::describe_step() const {
  if (particles_fast())
    return fmt::format("substeps particles {}: the structure takes one step of {:.6g} in {} particle steps",
                       count_, count_ * dt_, count_);
  return fmt::format("substeps structure {}: the structure takes {} steps of {:.6g} in a particle step",
                     count_, count_, dt_ / count_);
}

void Substeps::initialise_forces(const NodalForces& forces) {
  F_ = forces;
  if (!particles_fast()) {
    F_.values *= count_;
    return body_->initialise_forces(F_);
  }
  solver_.halo().owners_to_ghosts(F_.values);
  body_->initialise_forces(no_forces_);
  place_surface();
}

void Substeps::begin_step() {
  if (particles_fast()) {
    kick_by_contact();
    for (const Eigen::Index A : surface_nodes_) du_.col(A) += dt_ * dv_.col(A);
    ++done_;
    return place_surface();
  }
  body_->begin_step();
  for (int i = 1; i < count_; ++i) {
    body_->end_step(no_forces_);
    body_->begin_step();
  }
}

void Substeps::end_step(const NodalForces& forces) {
  F_ = forces;
  if (!particles_fast()) {
    F_.values *= count_;  // two half kicks of dt/count, which are to be those of dt
    return body_->end_step(F_);
  }
  solver_.halo().owners_to_ghosts(F_.values);
  kick_by_contact();
  if (done_ == count_) {
    body_->begin_step();
    solver_.add_motion(du_, dv_);
    body_->end_step(no_forces_);
    done_ = 0;
    du_.setZero();
    dv_.setZero();
  }
  place_surface();
}

void Substeps::kick_by_contact() {
  for (const Eigen::Index A : surface_nodes_)
    dv_.col(A) += 0.5 * dt_ * solver_.inverse_mass().col(A).cwiseProduct(F_.values.col(A));
}

// Until the outer step ends the body stands where it began: velocities have had their half kick by internal
// forces since, and those of contacts.
void Substeps::place_surface() {
  const double half_step = done_ > 0 ? 0.5 * count_ * dt_ : 0.0, since = done_ * dt_;
  for (const Eigen::Index A : surface_nodes_) {
    const Vector3 v = solver_.velocities().col(A) + half_step * solver_.accelerations().col(A);
    v_.col(A) = v + dv_.col(A);
    x_.col(A) = solver_.positions().col(A) + since * v + du_.col(A);
  }
}

std::vector<double> Substeps::save() const {
  std::vector<double> state = body_->save();
  if (done_ == 0) return state;
  state.insert(state.end(), {static_cast<double>(done_), static_cast<double>(count_), dt_});
  for (const NodalVectors* values : {&du_, &dv_}) {
    const std::vector<double> rows = solver_.in_order(*values);
    state.insert(state.end(), rows.begin(), rows.end());
  }
  return state;
}

void Substeps::load(const std::vector<double>& state) {
  const std::size_t own = solver_.state_size(), motion = 3 * solver_.all_nodes(),
                    within = own + 3 + 2 * motion;
  if (state.size() != within) {
    body_->load(state);
    done_ = 0;
  } else {
    body_->load({state.begin(), state.begin() + own});
    if (options_.fast == Fast::structure)
      throw std::invalid_argument(
          "the state stands within an outer step of fast particles, expected 'substeps particles' or "
          "'substeps auto'");
    fast_ = Fast::particles;
    done_ = static_cast<int>(state[own]);
    count_ = static_cast<int>(state[own + 1]);
    dt_ = state[own + 2];
    solver_.from_order(state.data() + own + 3, du_);
    solver_.from_order(state.data() + own + 3 + motion, dv_);
  }
  x_ = body_->positions();
  v_ = body_->velocities();
  place_surface();
}

std::unique_ptr<StructureSolver> with_substeps(std::unique_ptr<StructureSolver> solver,
                                               SubstepOptions options) {
  auto* const body = dynamic_cast<IgaStructure*>(solver.get());
  if (!body)
    throw std::invalid_argument("'substeps' are those of a deforming wall, expected 'structure FILE'");
  static_cast<void>(solver.release());
  return std::make_unique<Substeps>(std::unique_ptr<IgaStructure>(body), std::move(options));
}

}  // namespace coupling
