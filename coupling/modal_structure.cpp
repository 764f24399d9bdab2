// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/modal_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace coupling {

using Eigen::Index;
using Eigen::VectorXd;
using structure::ModalBasis;
using structure::ModalForces;

namespace {

/// A contact is felt as by the whole solid, within 2 %, if it lasts so many periods of the highest mode
/// (test_modal_body.py).
constexpr double kPeriods = 4.0;

std::vector<NodalVectors> all_shapes(const ModalBasis& basis) {
  std::vector<NodalVectors> shapes = basis.modes;
  shapes.insert(shapes.end(), basis.follow.begin(), basis.follow.end());
  return shapes;
}

NodalVectors times_mass(const NodalVectors& q, const structure::ExplicitSolver& solver) {
  return q * solver.mass().nodal_mass().asDiagonal();
}

/// Values without any symmetry, the same for a node whatever its column.
NodalVectors pattern(const std::vector<NodeId>& nodes) {
  constexpr double kGoldenRatio = 0.61803398874989485;
  NodalVectors values(3, static_cast<Index>(nodes.size()));
  for (Index dof = 0; dof < values.size(); ++dof)
    values.data()[dof] = std::fmod(kGoldenRatio * static_cast<double>(3 * nodes[dof / 3] + dof % 3 + 4), 1.0);
  return values;
}

}  // namespace

ModalStructure::ModalStructure(std::unique_ptr<IgaStructure> body, const ModalBasis& basis,
                               const ModalDamping& damping)
    : body_(std::move(body)),
      solver_(body_->solver()),
      rows_(all_shapes(basis)),
      surface_nodes_(surface().map.columns_of(nodes())),
      viscosity_(damping.stiffness),
      lowest_(std::sqrt(basis.eigenvalues.minCoeff()) / nurbs::kTwoPi),
      highest_(std::sqrt(basis.eigenvalues.maxCoeff()) / nurbs::kTwoPi),
      motion_(system_of(basis, damping)),
      dead_loads_(VectorXd::Zero(rows_.shape_count())),
      F_(NodalVectors::Zero(3, solver_.positions().cols())),
      x_(body_->positions()),
      v_(body_->velocities()) {
  take_state();
  motion_.set_support_rates(support_rates());
  measure_shapes(basis);
  place_surface(motion_.rates());
}

structure::ModalSystem ModalStructure::system_of(const ModalBasis& basis, const ModalDamping& damping) const {
  const Index modes = basis.eigenvalues.size(), motions = static_cast<Index>(basis.follow.size());
  const structure::Halo& halo = solver_.halo();
  structure::ModalSystem system;
  system.eigenvalues = basis.eigenvalues;
  system.damping_ratio = VectorXd::Zero(modes);
  system.mass_damping = damping.mass;
  system.viscosity = damping.stiffness * basis.eigenvalues;
  system.share.resize(modes, motions);
  system.stiffness.resize(motions, motions);
  for (Index k = 0; k < modes && !damping.ratio.empty(); ++k)
    system.damping_ratio[k] = damping.ratio[std::min<std::size_t>(k, damping.ratio.size() - 1)];
  for (Index k = 0; k < modes && !solver_.springs().empty(); ++k)
    system.viscosity[k] = std::max(
        0.0, system.viscosity[k] - damping.stiffness * halo.dot(basis.modes[k], of_springs(basis.modes[k])));
  system.mass = system.free_mass = system.viscous = system.stiffness;
  for (Index j = 0; j < motions; ++j) {
    const NodalVectors m_psi = times_mass(basis.follow[j], solver_);
    NodalVectors free = m_psi, K_psi(3, m_psi.cols());
    solver_.supports().apply(free);
    solver_.internal_forces(basis.follow[j], K_psi);
    const NodalVectors body_psi = K_psi - of_springs(basis.follow[j]);
    for (Index k = 0; k < modes; ++k) system.share(k, j) = halo.dot(basis.modes[k], m_psi);
    for (Index i = 0; i < motions; ++i) {
      system.stiffness(i, j) = halo.dot(basis.follow[i], K_psi);
      system.viscous(i, j) = damping.stiffness * halo.dot(basis.follow[i], body_psi);
      system.mass(i, j) = halo.dot(basis.follow[i], m_psi);
      system.free_mass(i, j) = halo.dot(basis.follow[i], free);
    }
    system.times.push_back(solver_.supports().motions()[j].time);
  }
  const Eigen::MatrixXd of_modes = system.share.transpose() * system.share;
  system.mass -= of_modes;
  system.free_mass -= of_modes;
  return system;
}

NodalVectors ModalStructure::of_springs(const NodalVectors& u) const {
  NodalVectors f = NodalVectors::Zero(3, u.cols());
  solver_.springs().add_forces(u, f);
  return f;
}

// Shape by shape, as if the body stood and moved so.
void ModalStructure::measure_shapes(const ModalBasis& basis) {
  const std::vector<NodalVectors> shapes = all_shapes(basis);
  const Index count = rows_.shape_count();
  const NodalVectors none = NodalVectors::Zero(3, x_.cols());
  NodalVectors force(3, x_.cols());
  momentum_.resize(3, count);
  signature_ = rows_.project(pattern(nodes()), solver_.halo());
  probes_.assign(body_->watched_points().size(), Row3(3, count));
  supports_.assign(body_->watched_supports().size(), {Row3(3, count), Row3(3, count), Row3::Zero(3, count)});
  for (Index k = 0; k < count; ++k) {
    const NodalVectors& shape = shapes[k];
    solver_.set_motion(shape, shape, 0.0);
    momentum_.col(k) = solver_.linear_momentum();
    for (std::size_t i = 0; i < probes_.size(); ++i)
      probes_[i].col(k) = solver_.displacement(body_->watched_points()[i]);
    if (supports_.empty()) continue;
    solver_.internal_forces(shape, force);
    const NodalVectors springs = of_springs(shape);
    force -= springs;
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      const structure::NamedSupport& support = body_->watched_supports()[i];
      supports_[i].body.col(k) = force_at(support, force);
      supports_[i].springs.col(k) = force_at(support, springs) + spring_force(support, shape);
      if (k >= motion_.mode_count())
        supports_[i].inertia.col(k) = force_at(support, times_mass(shape, solver_));
    }
  }
  place_all();
}

void ModalStructure::take_state() {
  const NodalVectors u = solver_.displacements(), v = solver_.velocities();
  motion_.set_state(solver_.time(), VectorXd::Zero(motion_.mode_count()),
                    VectorXd::Zero(motion_.mode_count()));
  const VectorXd at_rest = rows_.padded(motion_.coordinates());  // where the supports take it
  NodalVectors rest = u;
  Vector3 psi, same;
  for (Index A = 0; A < u.cols(); ++A) {
    rows_.at(A, at_rest, at_rest, psi, same);
    rest.col(A) -= psi;
  }
  expect_supports_in_place(rest);
  const auto modes = [&](const NodalVectors& q) -> VectorXd {
    return rows_.project(times_mass(q, solver_), solver_.halo()).head(motion_.mode_count());
  };
  motion_.set_state(solver_.time(), modes(rest), modes(v));
}

// Modes and motions are all that it has: a displacement at what is fixed would be gone.
void ModalStructure::expect_supports_in_place(NodalVectors displacements) const {
  constexpr double kRoundOff = 1e-9;  // of the largest displacement
  const double largest = solver_.largest_displacement();
  const NodalVectors all = displacements;
  solver_.supports().apply(displacements);
  displacements = all - displacements;  // where they hold
  for (const structure::Motion& motion : solver_.supports().motions())
    for (const Index dof : motion.dofs) displacements.data()[dof] = 0.0;
  const double held = solver_.halo().largest(displacements.lpNorm<Eigen::Infinity>());
  if (held > kRoundOff * largest)
    throw std::invalid_argument(
        fmt::format("body modal: the state has control points displaced by up to {:.6g} where 'fix' holds "
                    "them, and modes know supports in their places: expected 'move' there, by as much",
                    held));
}

// As the whole solid, supports begin with the velocity that the body is given there, until they take their
// own; of others than motions have, what these have of it.
VectorXd ModalStructure::support_rates() const {
  const std::vector<structure::Motion>& motions = solver_.supports().motions();
  const NodalVectors& v = solver_.velocities();
  const Index own = 3 * solver_.halo().owned(v.cols());
  std::vector<structure::ExactSum> sums(2 * motions.size());  // m size v, m size^2
  for (std::size_t j = 0; j < motions.size(); ++j)
    for (std::size_t i = 0; i < motions[j].dofs.size(); ++i) {
      const Index dof = motions[j].dofs[i];
      if (dof >= own) continue;
      const double size = motions[j].size[i], momentum = solver_.mass().nodal_mass()[dof / 3] * size;
      sums[2 * j].add(momentum * v.data()[dof]);
      sums[2 * j + 1].add(momentum * size);
    }
  solver_.halo().sum(sums.data(), sums.size());
  VectorXd rates = VectorXd::Zero(static_cast<Index>(motions.size()));
  for (std::size_t j = 0; j < motions.size(); ++j)
    if (const double inertia = sums[2 * j + 1].value(); inertia > 0.0)
      rates[static_cast<Index>(j)] = sums[2 * j].value() / inertia;
  return rates;
}

ModalForces ModalStructure::loads_at(double time) const {
  if (!solver_.has_changing_loads()) return dead_loads_;
  NodalVectors f;
  solver_.external_forces(NodalVectors::Zero(3, x_.cols()), time, f);
  return rows_.project(f, solver_.halo());
}

// Those that are not touched are zero.
void ModalStructure::take_forces(const NodalForces& forces) {
  for (const Index A : F_.touched) F_.values.col(A).setZero();
  F_.touched = forces.touched;
  for (const Index A : F_.touched) F_.values.col(A) = forces.values.col(A);
}

void ModalStructure::initialise_forces(const NodalForces& forces) {
  take_forces(forces);
  if (!solver_.has_changing_loads()) dead_loads_ = rows_.project(solver_.load(), solver_.halo());
  motion_.initialise_forces(rows_.project(F_.values, F_.touched, solver_.halo()), loads_at(motion_.time()));
  write_output();
}

void ModalStructure::begin_step() {
  motion_.begin_step(loads_at(motion_.time() + motion_.time_step()));
  place_surface(motion_.half_step_rates());
}

void ModalStructure::end_step(const NodalForces& forces) {
  take_forces(forces);
  motion_.end_step(rows_.project(F_.values, F_.touched, solver_.halo()));
  write_output();
  if (++steps_since_look_ < structure::ElementWatch::kTurns) return;
  steps_since_look_ = 0;
  place_all();
  solver_.look_at_elements();
}

void ModalStructure::set_time_step(double dt) {
  motion_.set_time_step(dt);
  solver_.set_time_step(dt);
}

double ModalStructure::shortest_contact() const { return kPeriods / highest_; }

std::string ModalStructure::describe_step() const {
  std::string text = fmt::format(
      "modal body: {} modes, frequencies {:.6g} to {:.6g}, good for contacts that "
      "last {:.3g} or longer",
      motion_.mode_count(), lowest_, highest_, shortest_contact());
  if (motion_.slowed() > 0)
    text += fmt::format("; {} of them turn by more than {} in a timestep, and are slowed to that",
                        motion_.slowed(), structure::ModalMotion::kMostTurn);
  return text;
}

void ModalStructure::place_surface(const VectorXd& rates) {
  const VectorXd u = rows_.padded(motion_.coordinates()), v = rows_.padded(rates);
  Vector3 u_A, v_A;
  for (const Index A : surface_nodes_) {
    rows_.at(A, u, v, u_A, v_A);
    x_.col(A) = solver_.body().reference().col(A) + u_A;
    v_.col(A) = v_A;
  }
}

void ModalStructure::place_all() const {
  const VectorXd u = rows_.padded(motion_.coordinates()), v = rows_.padded(motion_.rates());
  NodalVectors all_u(3, x_.cols()), all_v(3, x_.cols());
  Vector3 u_A, v_A;
  for (Index A = 0; A < x_.cols(); ++A) {
    rows_.at(A, u, v, u_A, v_A);
    all_u.col(A) = u_A;
    all_v.col(A) = v_A;
  }
  solver_.set_motion(all_u, all_v, motion_.time());
}

void ModalStructure::write_output() {
  const auto amend = [this](io::HistoryRow& row) {
    row.work = motion_.work();
    row.load_work = row.work.loads;
    row.truncation = 0.0;
    row.kinetic_energy = kinetic_energy();
    row.strain_energy = strain_energy();
    const std::vector<Reaction> forces = reactions();
    for (std::size_t i = 0; i < forces.size(); ++i) row.reactions[i] = forces[i].force;
  };
  body_->write_output(
      motion_.time(), motion_.time_step(), [this] { place_all(); }, amend);
}

Work ModalStructure::work() const {
  const structure::Work work = motion_.work();
  return {work.forces, work.loads, work.internal, work.supports, work.damped};
}

Vector3 ModalStructure::angular_momentum(const Vector3& about) const {
  place_all();
  return solver_.angular_momentum(about);
}

std::vector<Probe> ModalStructure::probes() const {
  std::vector<Probe> values;
  for (std::size_t i = 0; i < probes_.size(); ++i)
    values.push_back({body_->watched_points()[i].name, probes_[i] * motion_.coordinates()});
  return values;
}

/* ---------------------------------------------------------------------- supports */

Vector3 ModalStructure::force_at(const structure::NamedSupport& support, const NodalVectors& f) const {
  std::array<structure::ExactSum, 3> sums;
  const Index own = 3 * solver_.halo().owned(f.cols());
  for (const Index dof : solver_.supports().fixed_dofs()) {
    const structure::Id id = 3 * nodes()[dof / 3] + dof % 3;
    if (dof < own && std::binary_search(support.dofs.begin(), support.dofs.end(), id))
      sums[dof % 3].add(f.data()[dof]);
  }
  solver_.halo().sum(sums.data(), sums.size());
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

Vector3 ModalStructure::spring_force(const structure::NamedSupport& support, const NodalVectors& u) const {
  std::array<structure::ExactSum, 3> sums;
  if (support.spring_group)
    solver_.springs().add_reaction(*support.spring_group, u, solver_.halo().owned(u.cols()), sums.data());
  solver_.halo().sum(sums.data(), sums.size());
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

std::vector<Reaction> ModalStructure::reactions() const {
  std::vector<Reaction> reactions;
  if (supports_.empty()) return reactions;
  NodalVectors given;
  solver_.external_forces(NodalVectors::Zero(3, x_.cols()), motion_.time(), given);
  given += F_.values;
  const VectorXd strained = motion_.coordinates() + viscosity_ * motion_.rates();
  VectorXd accelerations = VectorXd::Zero(rows_.shape_count());
  accelerations.tail(motion_.motion_count()) = motion_.support_accelerations();
  for (std::size_t i = 0; i < supports_.size(); ++i) {
    const structure::NamedSupport& support = body_->watched_supports()[i];
    reactions.push_back({support.name, supports_[i].body * strained +
                                           supports_[i].springs * motion_.coordinates() +
                                           supports_[i].inertia * accelerations - force_at(support, given)});
  }
  return reactions;
}

/* ---------------------------------------------------------------------- state */

std::vector<double> ModalStructure::save() const {
  place_all();
  std::vector<double> state = solver_.save();
  const std::vector<double> modes = motion_.save();
  state.insert(state.end(), modes.begin(), modes.end());
  state.insert(state.end(), signature_.begin(), signature_.end());
  return state;
}

std::size_t ModalStructure::state_size() const {
  return solver_.state_size() + motion_.save().size() + signature_.size();
}

void ModalStructure::load(const std::vector<double>& state) {
  const std::size_t own = solver_.state_size(), modes = motion_.save().size();
  if (state.size() != own + modes + signature_.size())
    throw std::invalid_argument(fmt::format("modal body: state of {} numbers, expected {}", state.size(),
                                            own + modes + signature_.size()));
  body_->load({state.begin(), state.begin() + static_cast<long>(own)});
  motion_.load(state.data() + own);
  if (!std::equal(signature_.begin(), signature_.end(), state.data() + own + modes)) take_state();
  place_surface(motion_.rates());
}

Fingerprint ModalStructure::fingerprint() const {
  Fingerprint fingerprint = body_->fingerprint();
  fingerprint.push_back({"modal body",
                         fmt::format("{} modes", motion_.mode_count()),
                         {static_cast<double>(motion_.mode_count())}});
  return fingerprint;
}

}  // namespace coupling
