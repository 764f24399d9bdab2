// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/compliance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/assert.h"

namespace contact {

static_assert(ShearBlock::kCapacity >= ApproachBlock::kCapacity, "each contact may have a spring");

namespace {

// Where a particle stands deep in the wall it is that which is wrong, whatever the elements are.
[[noreturn]] void fail_as_too_fine(const ParticleView& particles, long step, const Contact& contact,
                                   double s) {
  constexpr double kSafe = 0.8, kDeep = 0.05;
  const int i = contact.particle, tag = particles.tag[i];
  const double radius = particles.radius[i], depth = contact.overlap / radius;
  const Vector3 foot = particles.centre(i) - contact.delta;
  const std::string at = fmt::format("({:.6g}, {:.6g}, {:.6g})", foot[0], foot[1], foot[2]);
  const std::string what =
      depth > kDeep
          ? fmt::format("particle {} (radius {:.4g}) stands {:.2g} of its radius deep in the wall at {}", tag,
                        radius, depth, at)
          : fmt::format(
                "elements at {} are too small for the contact of particle {} (radius {:.4g}, overlap "
                "{:.4g})",
                at, tag, radius, contact.overlap);
  throw std::runtime_error(fmt::format(
      "{} at step {}: what elements give way is {:.2g} of what its law does, expected at most {:.2g}; {}use "
      "elements at least {:.2g} times as large there, or 'compliance none'",
      what, step, s, ComplianceCorrection::kLargest,
      depth > kDeep ? "begin with particles outside of the wall, or " : "", s / kSafe));
}

double mass_of(const ParticleView& particles, int i) {
  return particles.mass ? particles.mass[i] : std::numeric_limits<double>::infinity();
}

/// u, as a vector in space, so that it does not depend on who looks, and how the normal turns.
Eigen::Map<Vector3> body_speed(double* memory) { return Eigen::Map<Vector3>(memory + ApproachBlock::kU); }

/// Vectors to and from a lane.
template <class Vector>
void put(const Vector& v, ShearBlock::Lanes* lanes, int lane) {
  for (int d = 0; d < 3; ++d) lanes[d][lane] = v[d];
}
Vector3 vector_of(const ShearBlock::Lanes* lanes, int lane) {
  return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
}

}  // namespace

ComplianceCorrection::ComplianceCorrection(coupling::LocalCompliance& compliance, const Wall& wall,
                                           const MeshEstimate* mesh)
    : compliance_(compliance),
      wall_(wall),
      mesh_(mesh),
      has_links_(!compliance.links().empty()),
      net_spread_(wall.net_spread()),
      keeps_forces_(has_links_ || net_spread_),
      approach_kernel_(approach_kernel(nurbs::simd_level())),
      shear_kernel_(shear_kernel(nurbs::simd_level())) {}

double* ComplianceCorrection::memory_of(const ParticleView& particles, const Contact& contact) {
  const int kept = particles.memory.history_count - kMemory;
  if (kept < 0)
    throw std::logic_error(
        fmt::format("slots of contacts have room for {} numbers, expected {} more than the contact model "
                    "keeps, for those that are corrected",
                    particles.memory.history_count, kMemory));
  return contact.history + kept;
}

/// A contact without damping keeps nothing of its approach: it is asked what it gives way now.
void ComplianceCorrection::forget_approach(const ParticleView& particles, const Contact& contact) {
  if (particles.memory.history_count < kMemory) return;
  double* const memory = approach_memory_of(particles, contact);
  if (memory[ApproachBlock::kX] != 0.0) std::fill_n(memory, kApproach, 0.0);
}

double ComplianceCorrection::held_gap(const ParticleSlots& slots, int history_count) {
  double gap = 0.0;
  if (history_count < kMemory) return gap;
  for (int s = 0; s < slots.used(); ++s)
    if (ContactSlot slot = slots.slot(s); !slot.empty())
      gap = std::max(gap, held_gap(slot.history()[history_count - kMemory + kForces + ApproachBlock::kX]));
  return gap;
}

void ComplianceCorrection::follow_strain(const std::vector<nurbs::SurfacePoint>& feet) {
  std::vector<double> numbers;
  for (const nurbs::SurfacePoint& foot : feet)
    numbers.insert(numbers.end(), {double(foot.patch), foot.xi[0], foot.xi[1]});
  numbers = wall_.all(numbers);
  std::vector<nurbs::SurfacePoint> all;
  for (std::size_t k = 0; k < numbers.size(); k += 3)
    all.push_back({static_cast<int>(numbers[k]), {numbers[k + 1], numbers[k + 2]}});
  compliance_.follow_strain(all);
}

void ComplianceCorrection::before(const ParticleView& particles, const Time& now, const ContactModel& model,
                                  Contact* contacts, int count) {
  NURBS_ASSERT(count <= kCapacity, count);
  elastic_count_ = damped_count_ = shear_count_ = 0;
  // Tables come from far: all are on their way before the first is read.
  for (int k = 0; k < count; ++k) look_at(particles, model, contacts[k], before_[k]);
  for (int k = 0; k < count; ++k)
    if (before_[k].is_corrected) enter(particles, now, model, contacts[k], before_[k]);
  const ApproachStep step = {kLargest, now.dt, now.is_setup ? 0.0 : now.dt};
  if (elastic_count_ > 0) approach_kernel_.elastic(elastic_, step);
  if (damped_count_ > 0) approach_kernel_.damped(damped_, step);
  for (int k = 0; k < count; ++k) {
    if (!before_[k].block) continue;
    if (net_spread_ && before_[k].block == &elastic_) spread_elastic(particles, now, contacts[k], before_[k]);
    see_overlap(particles, now, contacts[k], before_[k]);
    if (before_[k].block && before_[k].has_shear && !before_[k].is_light)
      enter_shear(particles, model, contacts[k], before_[k]);
  }
  if (shear_count_ == 0) return;
  shear_kernel_.begin(shear_, now.dt);
  for (int k = 0; k < count; ++k)
    if (before_[k].shear_lane >= 0) see_slip(particles, now, contacts[k], before_[k]);
}

void ComplianceCorrection::look_at(const ParticleView& particles, const ContactModel& model,
                                   const Contact& contact, Before& before) const {
  before.overlap = contact.overlap, before.distance = contact.distance, before.touches = contact.touches;
  before.delta = contact.delta, before.wall_velocity = before.met_velocity = contact.wall_velocity;
  before.block = nullptr, before.shear_lane = -1, before.is_light = false;
  before.spread = nullptr, before.w = before.expected_spread = 0.0;
  before.damping = model.hertz_damping(contact.particle);
  before.is_corrected =
      contact.overlap > 0.0 ||
      (before.damping > 0.0 && held_gap(approach_memory_of(particles, contact)[ApproachBlock::kX]) > 0.0);
  if (!before.is_corrected) return;
  before.directions.find(wall_, contact.foot, contact.delta);
  compliance_.foresee(contact.foot, before.directions.element);
}

void ComplianceCorrection::enter(const ParticleView& particles, const Time& now, const ContactModel& model,
                                 Contact& contact, Before& before) {
  const int i = contact.particle;
  const double damping = before.damping;
  const bool is_damped = damping > 0.0;
  double* const memory = is_damped ? approach_memory_of(particles, contact) : nullptr;
  before.has_shear = model.shear_constant(i) > 0.0;
  const nurbs::Indices<2>& element = before.directions.element;
  compliance_.find(contact.foot, element, before.has_shear, before.give);
  before.n = contact.normal();
  const double of_surface = before.n.dot(contact.wall_velocity);
  const double of_particle = -before.n.dot(particles.velocity(i));
  before.approach = of_particle + of_surface;
  ApproachBlock& block = is_damped ? damped_ : elastic_;
  const int lane = is_damped ? damped_count_++ : elastic_count_++;
  before.block = &block, before.lane = lane;
  block.overlap[lane] = keeps_forces_ ? overlap_of_others(particles, now, contact, before) : contact.overlap;
  block.of_particle[lane] = of_particle, block.of_surface[lane] = of_surface;
  block.radius[lane] = contact.effective_radius;
  block.constant[lane] = model.hertz_constant(i);
  block.give[lane] = before.give.normal.c + before.give.taken;
  if (!is_damped) return forget_approach(particles, contact);
  block.damping[lane] = damping;
  block.inertia[lane] = mass_of(particles, i);
  block.delay[lane] = mesh_ ? mesh_->delay(contact.foot.patch, element) : 0.0;
  const bool is_new = !(memory[ApproachBlock::kX] > 0.0);
  block.credit[lane] = is_new ? credit(particles, model, contact, before) : 0.0;
  before.is_light = is_new ? block.credit[lane] == 0.0 : memory[kLight] > 0.0;
  for (int m = 0; m < ApproachBlock::kU; ++m) block.memory[m][lane] = memory[m];
  block.memory[ApproachBlock::kU][lane] = before.n.dot(body_speed(memory));
  if (net_spread_) spread_damped(particles, now, contact, before);
}

// The surface is where it was expected, by links, for this contact's own force, too.
double ComplianceCorrection::overlap_of_others(const ParticleView& particles, const Time& now,
                                               const Contact& contact, Before& before) {
  const double* const forces = memory_of(particles, contact);
  before.expected = Vector3::Map(forces + kExpected);
  before.expected_spread = forces[kSpreadExpected];
  if (!now.is_setup) {
    before.expected = 2.0 * Vector3::Map(forces + kLast) - Vector3::Map(forces + kBefore);
    before.expected_spread = 2.0 * forces[kSpreadLast] - forces[kSpreadBefore];
  }
  double taken = before.give.taken;
  if (before.expected_spread != 0.0)
    taken += before.expected_spread * know_spread(contact, before).give.taken_one;
  const double overlap = contact.overlap - taken * before.expected.dot(before.n);
  return before.block == &damped_ ? overlap : std::max(overlap, 0.0);
}

void ComplianceCorrection::remember(const ParticleView& particles, const Contact& contact,
                                    const Before& before) {
  double* const forces = memory_of(particles, contact);
  if (!before.block) {
    std::fill_n(forces, kForces, 0.0);
    return;
  }
  Vector3::Map(forces + kExpected) = before.expected;
  std::copy_n(forces + kLast, 3, forces + kBefore);
  Vector3::Map(forces + kLast) = contact.force;
  forces[kSpreadExpected] = before.expected_spread;
  forces[kSpreadBefore] = forces[kSpreadLast];
  forces[kSpreadLast] = before.w;
  forces[kAbove] = before.spread ? before.spread->above : 0.0;
}

// The energy of the impact, from bodies that weigh a dozen times as much, none from those that weigh thrice
// as much as the particle: where they are hit plates follow it.
double ComplianceCorrection::credit(const ParticleView& particles, const ContactModel& model,
                                    const Contact& contact, const Before& before) const {
  constexpr double kLightest = 3.0, kHeaviest = 13.0;
  if (!mesh_ || !particles.mass || !(before.approach > 0.0)) return 0.0;
  const double m = particles.mass[contact.particle], v = before.approach,
               ratio = mesh_->mass_near(contact, model.hertz_constant(contact.particle), m, v) / m;
  return 0.5 * m * v * v * std::clamp((ratio - kLightest) / (kHeaviest - kLightest), 0.0, 1.0);
}

void ComplianceCorrection::see_overlap(const ParticleView& particles, const Time& now, Contact& contact,
                                       Before& before) {
  const ApproachBlock& block = *before.block;
  const int lane = before.lane;
  if (&block == &damped_) {
    if (!now.is_setup) {
      double* const memory = approach_memory_of(particles, contact);
      for (int m = 0; m < ApproachBlock::kU; ++m) memory[m] = block.memory[m][lane];
      memory[kLight] = before.is_light ? 1.0 : 0.0;
      body_speed(memory) =
          before.met_velocity + (block.memory[ApproachBlock::kU][lane] - block.of_surface[lane]) * before.n;
    }
    contact.touches = block.x[lane] > 0.0;
    if (!contact.touches) {
      before.block = nullptr;
      if (!now.is_setup) std::fill_n(shear_memory_of(particles, contact), ShearBlock::kMemory, 0.0);
      return;
    }
  }
  const double s = block.give_way[lane], x = block.x[lane];
  if (s >= kLargest) fail_as_too_fine(particles, now.step, contact, s);
  contact.wall_velocity += (block.rate[lane] - before.approach) * before.n;
  contact.distance += contact.overlap - x;
  contact.delta = contact.distance * before.n;
  contact.overlap = x;
}

void ComplianceCorrection::enter_shear(const ParticleView& particles, const ContactModel& model,
                                       const Contact& contact, Before& before) {
  constexpr double kSphere = 2.0 / 7.0;  // of its mass is what moves its surface along itself
  const int i = contact.particle, lane = before.shear_lane = shear_count_++;
  const ApproachBlock& block = *before.block;
  put(before.n, shear_.normal, lane);
  put(before.directions.tangents.col(0), shear_.first, lane);
  for (int c = 0; c < 3; ++c) {
    Eigen::Vector2d gradient;
    shear_.give[c][lane] = give_along(before, c, gradient);
    shear_.gradient[c][0][lane] = gradient[0], shear_.gradient[c][1][lane] = gradient[1];
  }
  const double of_disc = block.root[before.lane] * std::sqrt(contact.effective_radius);
  shear_.stiffness[lane] = model.shear_constant(i) * of_disc;
  put(model.slip(contact), shear_.slip, lane);
  put(before.met_velocity, shear_.wall, lane);
  put(model.shear_stretch(contact), shear_.stretch, lane);
  shear_.normal_stiffness[lane] = block.stiffness[before.lane];
  shear_.normal_dashpot[lane] = block.dashpot[before.lane];
  shear_.inertia[lane] = kSphere * mass_of(particles, i);
  const double* const memory = shear_memory_of(particles, contact);
  for (int m = 0; m < ShearBlock::kMemory; ++m) shear_.memory[m][lane] = memory[m];
}

void ComplianceCorrection::see_slip(const ParticleView& particles, const Time& now, Contact& contact,
                                    const Before& before) const {
  const int lane = before.shear_lane;
  if (shear_.share[lane] >= kLargest) fail_as_too_fine(particles, now.step, contact, shear_.share[lane]);
  if (now.is_setup) return;
  contact.wall_velocity -= vector_of(shear_.more_rate, lane);
  contact.correction->further_slip = vector_of(shear_.more, lane);
}

void ComplianceCorrection::after(const ParticleView& particles, const Time& now, ContactModel& model,
                                 Contact* contacts, int count) {
  for (int k = 0; k < count; ++k)
    if (const int lane = before_[k].shear_lane; lane >= 0)
      put(model.shear_stretch(contacts[k]), shear_.stretch, lane);
  if (shear_count_ > 0) shear_kernel_.end(shear_);
  for (int k = 0; k < count; ++k) {
    Contact& contact = contacts[k];
    const Before& before = before_[k];
    contact.overlap = before.overlap;
    contact.distance = before.distance;
    contact.touches = before.touches;
    contact.delta = before.delta;
    contact.wall_velocity = before.wall_velocity;
    if (!before.block) {
      contact.correction = nullptr;
      if (keeps_forces_ && !now.is_setup) remember(particles, contact, before);
      continue;
    }
    // Of c without what links take: that tilts the surface where it is met.
    const double F = before.block->force[before.lane];
    Eigen::Vector2d along = -0.5 * F * F * before.directions.gradient(before.give.normal.change);
    ContactCorrection& by = *contact.correction;
    by.tangents = before.directions.tangents;
    double taken = before.give.taken;
    if (before.w != 0.0) {
      const Spread& spread = *before.spread;
      along += spread_along(contact, before, F);
      by.spread = before.w;
      by.beside = spread.beside;
      by.tilt = -F * before.w / contact.distance * across(spread.beside, before.n);
      taken += before.expected_spread * spread.give.taken_one;
    }
    by.stiffness = before.block->stiffness[before.lane];
    by.tangent = before.block->tangent[before.lane];
    by.dashpot = before.block->dashpot[before.lane];
    if (const int lane = before.shear_lane; lane >= 0) {
      along += Eigen::Vector2d(shear_.along[0][lane], shear_.along[1][lane]);
      by.shear_tangent = shear_.stiffness[lane] / (1.0 - shear_.share[lane]);
      by.shear_dashpot = shear_.dashpot[lane];
      double* const memory = shear_memory_of(particles, contact);
      if (!now.is_setup)
        for (int m = 0; m < ShearBlock::kMemory; ++m) memory[m] = shear_.memory[m][lane];
    }
    by.follows = along;
    contact.force.noalias() += by.tangents * along;
    if (before.w != 0.0) contact.force += by.tilt;
    if (has_links_) by.shift = taken * before.expected;
    if (keeps_forces_ && !now.is_setup) remember(particles, contact, before);
  }
  model.hear_of_corrections(contacts, count);
}

}  // namespace contact
