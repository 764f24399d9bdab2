// SPDX-License-Identifier: GPL-2.0-or-later
// The whole body's state, in an order that does not depend on how it is cut.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "structure/time/explicit_solver.h"

namespace structure {

std::vector<Id> ExplicitSolver::fixed_dofs() const { return of_whole_body(supports_.fixed_dofs()); }

std::vector<Id> ExplicitSolver::moved_dofs() const {
  std::vector<Eigen::Index> moved;
  for (const Motion& motion : supports_.motions())
    moved.insert(moved.end(), motion.dofs.begin(), motion.dofs.end());
  return of_whole_body(moved);
}

std::vector<Id> ExplicitSolver::of_whole_body(const std::vector<Eigen::Index>& dofs) const {
  const Eigen::Index owned = halo_->owned(u_.cols());
  std::vector<double> directions(owned, 0.0);  // as bits
  for (const Eigen::Index dof : dofs)
    if (dof < 3 * owned) directions[dof / 3] += 1 << dof % 3;
  std::vector<Id> whole;
  Id node = 0;
  halo_->in_slices({node_ids_.begin(), node_ids_.begin() + owned}, directions.data(), directions.size(),
                   [&](const double* some, std::size_t count) {
                     for (std::size_t i = 0; i < count; ++i, ++node)
                       for (int c = 0; c < 3; ++c)
                         if (static_cast<int>(some[i]) >> c & 1) whole.push_back(3 * node + c);
                   });
  return whole;
}

std::vector<Id> ExplicitSolver::element_ids() const {
  std::vector<Id> ids(body_->element_count());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = halo_->element_id(i);
  return ids;
}

std::size_t ExplicitSolver::all_nodes() const {
  return std::llround(halo_->sum(static_cast<double>(halo_->owned(u_.cols()))));
}

std::size_t ExplicitSolver::memory_size() const {
  return std::llround(halo_->sum(static_cast<double>(body_->memory().size())));
}

std::size_t ExplicitSolver::state_size() const {
  return 1 + (momenta_damped_ ? 12 : 9) * all_nodes() + memory_size();
}

bool ExplicitSolver::can_load(std::size_t size) const {
  const std::size_t nodes = all_nodes(), without_momenta = 1 + 9 * nodes + memory_size();
  return size == without_momenta || size == without_momenta + 3 * nodes;
}

std::vector<double> ExplicitSolver::momenta_in_order() const {
  return momenta_damped_ ? in_order(momenta_damped_->momenta()) : std::vector<double>();
}

NodalVectors ExplicitSolver::reference_of(const std::vector<Id>& nodes) const {
  std::vector<Id> asked(nodes), places;  // asked: each once, rising
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  const auto begin = node_ids_.begin(), end = begin + halo_->owned(u_.cols());
  std::vector<double> rows;
  for (std::size_t place = 0; place < asked.size(); ++place) {
    const auto own = std::lower_bound(begin, end, asked[place]);
    if (own == end || *own != asked[place]) continue;
    const Vector3 X = body_->reference().col(own - begin);
    places.push_back(static_cast<Id>(place));
    rows.insert(rows.end(), X.begin(), X.end());
  }
  rows = halo_->in_order(places, rows.data(), rows.size());
  NodalVectors X(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto place = std::lower_bound(asked.begin(), asked.end(), nodes[i]) - asked.begin();
    X.col(i) = Vector3::Map(&rows[3 * place]);
  }
  return X;
}

std::vector<double> ExplicitSolver::in_order(const NodalVectors& values) const {
  const std::vector<Id> nodes(node_ids_.begin(), node_ids_.begin() + halo_->owned(u_.cols()));
  return halo_->in_order(nodes, values.data(), 3 * nodes.size());
}

void ExplicitSolver::from_order(const double* rows, NodalVectors& values) const {
  for (Eigen::Index i = 0; i < halo_->held(u_.cols()); ++i)
    values.col(i) = Vector3::Map(rows + 3 * node_ids_[i]);
}

std::vector<double> ExplicitSolver::save() const {
  std::vector<double> state{time_};
  const auto append = [&](const std::vector<double>& rows) {
    state.insert(state.end(), rows.begin(), rows.end());
  };
  for (const NodalVectors* values : {&u_, &v_, &a_}) append(in_order(*values));
  append(memory_in_order());
  append(momenta_in_order());
  return state;
}

void ExplicitSolver::load(const std::vector<double>& state) {
  const std::size_t all_values = 3 * all_nodes();
  if (!can_load(state.size()))
    throw std::invalid_argument(
        fmt::format("ExplicitSolver: state of {} numbers, expected {}", state.size(), state_size()));
  const double* next = state.data();
  time_ = *next++;
  for (NodalVectors* values : {&u_, &v_, &a_}) {
    from_order(next, *values);
    next += all_values;
  }
  const std::vector<Id> elements = element_ids();
  std::vector<double> memory(body_->memory().size());
  const std::size_t width = elements.empty() ? 0 : memory.size() / elements.size();  // equally much of each
  for (std::size_t i = 0; i < elements.size(); ++i)
    std::copy_n(next + width * elements[i], width, memory.data() + width * i);
  body_->set_memory(std::move(memory));
  next += memory_size();
  const bool were_supports_held = !hold_supports();  // others may have moved them
  if (momenta_damped_ && were_supports_held && next != state.data() + state.size()) {
    NodalVectors momenta = NodalVectors::Zero(3, u_.cols());
    from_order(next, momenta);
    momenta_damped_->set_momenta(momenta);
  } else if (momenta_damped_) {
    momenta_damped_->forget();
  }
  x_ = body_->reference() + u_;
  budget_.reset();
}

// Words of exact sums are whole numbers below 2^53.
std::vector<double> ExplicitSolver::save_work_done() const {
  std::array<ExactSum, kForceKinds> sums = ledger_.sums();
  halo_->sum(sums.data(), sums.size());
  std::vector<double> numbers{strain_start_.value_or(0.0), dissipated_start_};
  for (ExactSum& sum : sums) numbers.insert(numbers.end(), sum.words().begin(), sum.words().end());
  numbers.push_back(dissipated_energy());
  return numbers;
}

void ExplicitSolver::load_work_done(const std::vector<double>& numbers) {
  constexpr std::size_t kNumbers = 3 + kForceKinds * ExactSum::kWords;  // older states lack the last one
  if (numbers.size() != kNumbers && numbers.size() != kNumbers - 1)
    throw std::invalid_argument(
        fmt::format("ExplicitSolver: work of {} numbers, expected {}", numbers.size(), kNumbers));
  const bool is_first_part = halo_->owned(u_.cols()) > 0 && node_ids_[0] == 0;
  std::array<ExactSum, kForceKinds> sums;
  auto word = numbers.begin() + 2;
  for (ExactSum& sum : sums)
    for (std::int64_t& value : sum.words()) value = is_first_part ? static_cast<std::int64_t>(*word++) : 0;
  ledger_.set_sums(sums);
  strain_start_ = numbers[0];
  dissipated_start_ = numbers[1];
  if (numbers.size() == kNumbers)  // a material that has not kept its memory goes on from the energy of then
    dissipated_start_ += dissipated_energy() - numbers.back();
  budget_.reset();
}

void ExplicitSolver::set_velocities(const NodalVectors& v) {
  check_size(v, "velocities");
  v_ = v;
  hold_supports();
  if (momenta_damped_) momenta_damped_->forget();
  budget_.reset();
}

// What is fixed stands; what is moved has the velocity that it is given until its motion takes it.
bool ExplicitSolver::hold_supports() {
  const NodalVectors given = v_;
  supports_.apply(v_);
  for (const Motion& motion : supports_.motions())
    for (const Eigen::Index dof : motion.dofs) v_.data()[dof] = given.data()[dof];
  return halo_->any(v_ != given);
}

void ExplicitSolver::set_motion(const NodalVectors& u, const NodalVectors& v, double time) {
  check_size(u, "displacements");
  check_size(v, "velocities");
  u_ = u;
  v_ = v;
  x_ = body_->reference() + u;
  time_ = time;
  if (momenta_damped_) momenta_damped_->forget();
  budget_.reset();
}

void ExplicitSolver::settle() {
  if (body_->memory().empty()) return;
  NodalVectors f(3, u_.cols());
  body_->evolve(u_, 0.0, f);
  body_->commit();
}

}  // namespace structure
