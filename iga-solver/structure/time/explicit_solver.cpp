// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/explicit_solver.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structure/material/viscous.h"
#include "structure/time/stable_time_step.h"

namespace structure {

namespace {

std::vector<Id> ids_of(const Halo& halo, Eigen::Index columns) {
  std::vector<Id> ids(columns);
  for (Eigen::Index i = 0; i < columns; ++i) ids[i] = halo.node_id(i);
  return ids;
}

}  // namespace

ExplicitSolver::ExplicitSolver(std::unique_ptr<Body> body, Supports supports,
                               std::unique_ptr<const Halo> halo)
    : body_(std::move(body)),
      supports_(std::move(supports)),
      halo_(std::move(halo)),
      node_ids_(ids_of(*halo_, body_->node_count())),
      mass_(mass_of(*body_, supports_, *halo_)),
      motion_(supports_),
      f_ext_(NodalVectors::Zero(3, body_->node_count())),
      f_int_(f_ext_),
      u_(f_ext_),
      x_(body_->reference()),
      v_(f_ext_),
      a_(f_ext_) {
  if (!motion_.is_empty() && !mass_->is_diagonal()) of_supports_ = f_ext_;
}

void ExplicitSolver::check_size(const NodalVectors& values, const char* what) const {
  if (values.cols() != u_.cols())
    throw std::invalid_argument(
        fmt::format("ExplicitSolver: {} for {} nodes, expected {}", what, values.cols(), u_.cols()));
}

void ExplicitSolver::set_load(const NodalVectors& f_ext) {
  check_size(f_ext, "load");
  budget_.reset();
  (loads_.empty() ? f_ext_ : f_dead_) = f_ext;
}

void ExplicitSolver::add_load(std::unique_ptr<const ChangingLoad> load, std::string name) {
  if (loads_.empty()) f_dead_ = f_ext_;
  loads_.push_back(std::move(load));
  load_names_.push_back(std::move(name));
  budget_.reset();
}

void ExplicitSolver::set_mass_damping(double rate) {
  damping_ = rate;
  momenta_damped_.reset();
  if (rate > 0.0 && !mass_->is_diagonal())
    momenta_damped_ = std::make_unique<MomentumDamping>(rate, *mass_, halo_->owned(v_.cols()));
}

void ExplicitSolver::set_time_step(double dt) {
  if (!(dt > 0.0 && std::isfinite(dt)))
    throw std::invalid_argument(fmt::format("ExplicitSolver: time step is {}, expected a number > 0", dt));
  if (damping_ * dt > 2.0)
    throw std::invalid_argument(
        fmt::format("damping by the mass at a rate of {:.6g} with time step {:.6g}: velocities would change "
                    "their sign in each step, expected a time step of at most {:.6g}, or a rate of at most "
                    "{:.6g}",
                    damping_, dt, 2.0 / damping_, 2.0 / dt));
  dt_ = dt;
  watch_.reset();
  is_too_strained_ = false;
}

void ExplicitSolver::internal_forces(const NodalVectors& u, NodalVectors& f) const {
  body_->internal_force(u, f);
  halo_->sum_to_owners(f);
  springs_.add_forces(u, f);
}

void ExplicitSolver::external_forces(const NodalVectors& u, double t, NodalVectors& f) const {
  f = load();
  if (loads_.empty()) return;
  const NodalVectors x = body_->reference() + u;
  for (const std::unique_ptr<const ChangingLoad>& load : loads_) load->add(t, x, *halo_, f);
}

void ExplicitSolver::initialise_forces(const NodalVectors& F) {
  check_size(F, "forces");
  motion_.place(conditions_time(time_), body_->reference(), u_, x_);
  internal_forces(led_displacements(), f_int_);
  find_loads();
  if (momenta_damped_) momenta_damped_->start(*mass_, v_);
  carried_.clear();
  accelerate(F, 0.0);
  largest_u_ = u_.lpNorm<Eigen::Infinity>();
  ledger_ = WorkLedger();
  dissipated_start_ = dissipated_energy();
  strain_start_.reset();
  budget_.reset();
  check_divergence(F);
}

void ExplicitSolver::begin_step() {
  if (dt_ == 0.0) throw std::logic_error("ExplicitSolver: begin_step before set_time_step");
  if (!watch_ && stable_time_step_) {
    const double room = *stable_time_step_ / undamped_step(dt_, lead_);
    watch_.emplace(*body_, room * room);
  }
  carried_.clear();
  for (const ForceSums& run : sums_) ledger_.half_kick(run.work_from_now(0.5 * dt_));
  if (momenta_damped_) momenta_damped_->kick_on(0.5 * dt_);
  largest_u_ = kick_and_drift(dt_, a_, body_->reference(), v_, u_, x_);
  motion_.place(conditions_time(time_ + dt_), body_->reference(), u_, x_);
}

void ExplicitSolver::add_motion(const NodalVectors& displacements, const NodalVectors& velocities,
                                const NodalVectors& impulses) {
  check_size(displacements, "displacements");
  check_size(velocities, "velocities");
  check_size(impulses, "impulses");
  press_on_supports(impulses, dt_);
  halo_->for_each_run(v_.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto gain = velocities.middleCols(first, count);
    const auto v = v_.middleCols(first, count);
    PerForce work = PerForce::Zero();
    work[kForces] = impulses.middleCols(first, count).cwiseProduct(v + 0.5 * gain).sum();
    work[kSupports] = dt_ * power_of_carried(first, count);
    ledger_.half_kick(work);
    added_energy_.add(work.sum());
  });
  if (momenta_damped_) momenta_damped_->add(impulses);
  u_ += displacements;
  v_ += velocities;
  halo_->owners_to_ghosts(u_);  // they have no forces of others
  halo_->owners_to_ghosts(v_);
  x_ = body_->reference() + u_;
  largest_u_ = u_.lpNorm<Eigen::Infinity>();
  added_displacements_ = &displacements;
}

// That is inertia of the accelerations that impulses cause, less what acts on the support itself.
void ExplicitSolver::press_on_supports(const NodalVectors& impulses, double duration) {
  if (!keeps_reactions_ && supports_.motions().empty()) return;
  if (!mass_->is_diagonal()) mass_->apply_inverse_mass(impulses, gain_);
  carried_.clear();
  for (const Eigen::Index dof : supports_.fixed_dofs())
    carried_.push_back((mass_->inertia_of_support(dof, 0.0) - impulses.data()[dof]) / duration);
}

void ExplicitSolver::press_evenly(const NodalVectors& forces, const NodalVectors& kicks) {
  if (!keeps_reactions_) return;
  carried_.clear();
  for (const Eigen::Index dof : supports_.fixed_dofs())
    carried_.push_back(kicks.data()[dof] - forces.data()[dof]);
}

double ExplicitSolver::power_of_carried(Eigen::Index first, Eigen::Index count) const {
  const std::vector<Eigen::Index>& fixed = supports_.fixed_dofs();
  double power = 0.0;
  if (carried_.empty()) return power;
  const auto end = fixed.end();
  for (auto dof = std::lower_bound(fixed.begin(), end, 3 * first); dof != end && *dof < 3 * (first + count);
       ++dof)
    power += carried_[dof - fixed.begin()] * v_.data()[*dof];
  return power;
}

void ExplicitSolver::add_strain_energy() {
  const NodalVectors& added = *std::exchange(added_displacements_, nullptr);
  halo_->for_each_run(v_.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto f = f_int_.middleCols(first, count) - f_ext_.middleCols(first, count);
    added_energy_.add(added.middleCols(first, count).cwiseProduct(f).sum());
  });
}

void ExplicitSolver::end_step(const NodalVectors& F) {
  check_size(F, "forces");
  body_->evolve(led_displacements(), dt_, f_int_, [this] { halo_->begin_sum(f_int_); });
  halo_->finish_sum(f_int_);
  springs_.add_forces(lead_ == 0.0 ? u_ : led_u_, f_int_);
  time_ += dt_;
  find_loads();
  accelerate(F, 0.5 * dt_);
  if (added_displacements_) add_strain_energy();
  for (const ForceSums& run : sums_) ledger_.half_kick(run.work_until_now(0.5 * dt_));
  body_->commit();
  check_divergence(F);
}

void ExplicitSolver::change_forces(const NodalVectors& F) {
  check_size(F, "forces");
  carried_.clear();
  accelerate(F, 0.0);
  budget_.reset();
}

void ExplicitSolver::find_loads() {
  if (loads_.empty()) return;
  f_ext_ = f_dead_;
  for (const std::unique_ptr<const ChangingLoad>& load : loads_)
    load->add(conditions_time(time_), x_, *halo_, f_ext_);
}

void ExplicitSolver::accelerate(const NodalVectors& F, double h) {
  const bool moves = !motion_.is_empty() && dt_ > 0.0;
  if (moves) motion_.find_velocities(conditions_time(time_ + dt_), dt_, h > 0.0, u_, v_);
  const NodalForces forces{f_int_, f_ext_, F, momenta_damped_ ? &momenta_damped_->forces() : nullptr};
  if (!mass_->is_diagonal()) {
    a_ = f_ext_ + F - f_int_;
    if (momenta_damped_) momenta_damped_->kick(h, a_);
    if (moves) motion_.set_accelerations(of_supports_);
    mass_->apply_inverse_mass(a_, a_, moves ? &of_supports_ : nullptr);
  }
  sums_.clear();
  halo_->for_each_run(v_.cols(), [&](Eigen::Index first, Eigen::Index count) {
    sums_.push_back(kick_run(forces, h, first, count));
    if (moves) motion_.add_accelerations(first, count, forces, *mass_, a_, sums_.back());
  });
  if (keeps_reactions_) find_reactions(F);
  halo_->owners_to_ghosts(a_);
  const Eigen::Index ghosts = v_.cols() - halo_->owned(v_.cols());
  if (damping_ > 0.0)
    halo_->owners_to_ghosts(v_);
  else
    v_.rightCols(ghosts) += h * a_.rightCols(ghosts);
  if (moves) motion_.set_velocities(v_);
}

ForceSums ExplicitSolver::kick_run(const NodalForces& forces, double h, Eigen::Index first,
                                   Eigen::Index count) {
  return mass_->is_diagonal()
             ? accelerate_and_kick(h, forces, mass_->inverse_mass(), first, count, a_, v_, damping_)
             : kick(h, forces, first, count, a_, v_);
}

void ExplicitSolver::find_reactions(const NodalVectors& F) {
  const std::vector<Eigen::Index>& fixed = supports_.fixed_dofs();
  reactions_.resize(fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const double inertia = mass_->inertia_of_support(fixed[i], a_.data()[fixed[i]]);
    reactions_[i] = inertia + f_int_.data()[fixed[i]] - f_ext_.data()[fixed[i]] - F.data()[fixed[i]];
  }
}

Vector3 ExplicitSolver::reaction(const NamedSupport& support) const {
  std::array<ExactSum, 3> sums;
  const Eigen::Index own = 3 * halo_->owned(u_.cols());
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    const Eigen::Index dof = supports_.fixed_dofs()[i];
    if (dof < own &&
        std::binary_search(support.dofs.begin(), support.dofs.end(), 3 * node_ids_[dof / 3] + Id(dof % 3)))
      sums[dof % 3].add(reactions_[i] + (carried_.empty() ? 0.0 : carried_[i]));
  }
  if (support.spring_group)
    springs_.add_reaction(*support.spring_group, u_, halo_->owned(u_.cols()), sums.data());
  halo_->sum(sums.data(), sums.size());
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

double ExplicitSolver::truncation(double strain) const {
  return work().internal - (strain - strain_start_.value_or(strain));
}

void ExplicitSolver::start_energy_budget() {
  constexpr double kNegligibleStrain = 1e-9;
  const Work work = ledger_.work(*halo_);
  const double strain = strain_energy(), kinetic = kinetic_energy(), kick = 0.125 * dt_ * dt_ * nodal_sum(a_);
  kinetic_start_ = kinetic + work.internal + work.damped - work.loads - work.forces - work.supports;
  if (!strain_start_) strain_start_ = strain - work.internal;
  double stiffness = 0.0;
  for (const Material* material : body_->materials())
    stiffness = std::max(stiffness, material->youngs_modulus());
  const double negligible =
      stiffness * halo_->total(body_->volume_sum()) * kNegligibleStrain * kNegligibleStrain;
  budget_.emplace(kinetic + strain + kick, negligible);
}

// One message of all ranks, and no pass over the nodes: the ledger knows the kinetic energy, and is not
// finite if one velocity or acceleration is not.
void ExplicitSolver::check_divergence(const NodalVectors& F) {
  const bool starts = !budget_;
  if (starts) start_energy_budget();
  enum { kPower = kForceKinds, kAdded, kPartsBeyond, kPartsAlarmed, kSums };
  std::array<ExactSum, kSums> sums;
  std::copy(ledger_.sums().begin(), ledger_.sums().end(), sums.begin());
  for (const ForceSums& run : sums_)
    sums[kPower].add(run.f_v[kLoads] + run.f_v[kForces] + run.f_v[kSupports]);
  sums[kAdded] = std::exchange(added_energy_, ExactSum());
  sums[kPartsBeyond].add(largest_u_ <= kLargestDisplacement ? 0.0 : 1.0);
  const bool is_strained = watch_ && !is_too_strained_ && watch_->look(x_);
  elements_.look(*body_, u_, largest_u_);
  const bool is_turned = !has_warned_ && elements_.turned();
  sums[kPartsAlarmed].add(is_strained || is_turned || elements_.folded() ? 1.0 : 0.0);
  halo_->sum(sums.data(), sums.size());

  const double kinetic = kinetic_start_ + sums[kLoads].value() + sums[kForces].value() +
                         sums[kSupports].value() + sums[kDamping].value() - sums[kInternal].value();
  const double power_before = std::exchange(power_, sums[kPower].value());
  if (!starts) budget_->add(0.5 * dt_ * (power_before + power_) + sums[kAdded].value());
  if (!budget_->allows(kinetic) || sums[kPartsBeyond].value() > 0.0) {
    expect_finite_conditions(conditions_time(time_));  // or it is the model's fault
    throw Diverged(describe_divergence(
        {*body_, *halo_, *mass_, u_, v_, a_, F, time_, dt_, stable_time_step_, kinetic, budget_->most()}));
  }
  if (sums[kPartsAlarmed].value() == 0.0) return;
  tell_of_elements();
  if (halo_->any(is_strained)) look_at_strain();
}

void ExplicitSolver::tell_of_elements() {
  const std::string folded = describe_folded(*body_, *halo_, elements_, time_);
  if (!folded.empty()) throw Diverged(folded);
  if (has_warned_) return;
  warning_ = describe_turned(*body_, *halo_, elements_, time_);
  has_warned_ = !warning_.empty();
}

void ExplicitSolver::look_at_elements() {
  elements_.look_at_all(*body_, u_);
  tell_of_elements();
}

void ExplicitSolver::look_at_strain() {
  constexpr double kLeastGrowth = 1.005;  // of the stiffness, until it is worth to look again
  stable_now_ = find_stable_step(u_);
  const double room = *stable_now_ / undamped_step(dt_, lead_);
  is_too_strained_ = room < 1.0;
  if (is_too_strained_ && !goes_on_when_strained_)
    throw TooStrained(describe_too_strained(*body_, *halo_, *watch_,
                                            {time_, dt_, damped_stable_step(stable_time_step(), lead_),
                                             damped_stable_step(*stable_now_, lead_)}));
  watch_->allow_more(std::max(kLeastGrowth, room * room));
}

double ExplicitSolver::find_stable_step(const NodalVectors& u) const {
  const double undamped = structure::stable_time_step(*body_, *mass_, supports_, u, *halo_, springs_);
  double most_viscous = 0.0;
  for (const Material* material : body_->materials())
    most_viscous = std::max(most_viscous, viscosity(*material));
  return damped_stable_step(undamped, most_viscous);  // rates are those of half a step before
}

double ExplicitSolver::stable_time_step() const {
  if (!stable_time_step_) {
    const bool remembers = halo_->any(!body_->memory().empty());
    stable_time_step_ = find_stable_step(remembers ? u_ : NodalVectors(NodalVectors::Zero(3, u_.cols())));
  }
  return *stable_time_step_;
}

double ExplicitSolver::renew_stable_time_step() {
  const bool is_strained = largest_displacement() > 0.0;
  if (!is_strained || !is_stiffened_by_strain(*body_)) return stable_time_step();
  stable_now_ = find_stable_step(u_);
  return *stable_now_;
}

// What the material has lost by viscosity is damped, not internal.
Work ExplicitSolver::work() const {
  Work work = ledger_.work(*halo_);
  const double dissipated = dissipated_energy() - dissipated_start_;
  work.internal -= dissipated;
  work.damped += dissipated;
  return work;
}

double ExplicitSolver::dissipated_energy() const {
  const std::vector<const Material*> materials = body_->materials();
  const bool remembers = std::any_of(materials.begin(), materials.end(),
                                     [](const Material* material) { return material->state_size() > 0; });
  return remembers ? halo_->total(body_->dissipated_sum()) : 0.0;
}

double ExplicitSolver::load_work() const { return loads_.empty() ? halo_->dot(f_ext_, u_) : work().loads; }

}  // namespace structure
