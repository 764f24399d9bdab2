// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/compliance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace contact {

// With c > 0 the left side is concave and Newton's steps come up from below; with c < 0 it is convex, and
// they come down from above.  They begin at the first terms of Lagrange's series in e = c K overlap^(1/2),
// 1 + e + 3/2 e^2 + 21/8 e^3 + 5 e^4 + ..., which is on that side.  After a step the error is 1/4 s/(1 - s)
// of the step's share of x, squared.
CorrectedOverlap corrected_overlap(double overlap, double c, double K, double limit) {
  constexpr int kMostSteps = 60;
  constexpr double kSame = 5e-9, kSeries = 0.5;
  const double e = c * K * std::sqrt(overlap);
  const double series = 1.0 + e * (1.0 + e * (1.5 + e * (2.625 + e * 5.0)));
  CorrectedOverlap at{std::abs(e) < kSeries ? overlap * series : overlap, 0.0, 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    at.root = std::sqrt(at.x);
    const double cK_root = c * K * at.root;
    at.s = 1.5 * cK_root;
    if (at.s >= limit) return at;
    const double change = (overlap - at.x * (1.0 - cK_root)) / (1.0 - at.s);
    at.x += change;
    if (std::abs(change) <= kSame * at.x) {
      const double share = 1.0 + 0.5 * change / at.x;
      at.s *= share;
      at.root *= share;
      break;
    }
  }
  return at;
}

// x - c (K x^(3/2) + stiffness x) = overlap + c force
DampedOverlap damped_overlap(double overlap, const DampedLaw& law, const DampedApproach::Damper& damper,
                             double limit) {
  const double share = 1.0 - law.give * damper.stiffness, left = (overlap + law.give * damper.force) / share;
  DampedOverlap at{left, 1.0 - share, damper.force + damper.stiffness * left};
  if (!(left > 0.0)) return at;
  const CorrectedOverlap own = corrected_overlap(left, law.give / share, law.K, limit);
  return {own.x, 1.0 - share * (1.0 - own.s),
          law.K * own.x * own.root + damper.force + damper.stiffness * own.x};
}

namespace {

[[noreturn]] void fail_as_too_fine(const ParticleView& particles, long step, const Contact& contact,
                                   double s) {
  constexpr double kSafe = 0.8;
  const int i = contact.particle;
  const Vector3 foot = particles.centre(i) - contact.delta;
  throw std::runtime_error(fmt::format(
      "elements at ({:.6g}, {:.6g}, {:.6g}) are too small for the contact of particle {} at step {}: what "
      "they give way is {:.2g} of what its law does, expected at most {:.2g}; use elements at least {:.2g} "
      "times as large there, or 'compliance none'",
      foot[0], foot[1], foot[2], particles.tag[i], step, s, ComplianceCorrection::kLargest, s / kSafe));
}

double mass_of(const ParticleView& particles, int i) {
  return particles.mass ? particles.mass[i] : std::numeric_limits<double>::infinity();
}

/// What a contact keeps.
double* memory_of(const ParticleView& particles, const Contact& contact) {
  const int kept = particles.memory.history_count - ComplianceCorrection::kMemory;
  if (kept < 0)
    throw std::logic_error(
        fmt::format("slots of contacts have room for {} numbers, expected {} more than the contact model "
                    "keeps, for those that are corrected and damped or have a spring along the surface",
                    particles.memory.history_count, ComplianceCorrection::kMemory));
  return contact.history + kept;
}

void forget_shear(const ParticleView& particles, const ComplianceCorrection::Time& now,
                  const Contact& contact) {
  if (!now.is_setup)
    std::fill_n(memory_of(particles, contact) + DampedApproach::kMemory, ShearCompliance::kMemory, 0.0);
}

}  // namespace

double ComplianceCorrection::held_gap(const ParticleSlots& slots, int history_count) {
  double gap = 0.0;
  if (history_count < kMemory) return gap;
  for (int s = 0; s < slots.used(); ++s)
    if (ContactSlot slot = slots.slot(s); !slot.empty())
      gap = std::max(gap, DampedApproach::held_gap(slot.history() + history_count - kMemory));
  return gap;
}

// dx/dt = d(overlap)/dt / (1 - s), for what depends on it.
ComplianceCorrection::Seen ComplianceCorrection::elastic(double approach, double K, double c,
                                                         const Contact& contact) const {
  const auto [x, s, root] = corrected_overlap(contact.overlap, c, K, kLargest);
  return {x, root, approach / (1.0 - s), s, K * x * root, 0.0, 0.0};
}

// The law is called with the x that is kept, and with a rate by which its force is that of both.
bool ComplianceCorrection::damped(const ParticleView& particles, const Time& now, const DampedLaw& law,
                                  const Vector3& n, double approach, const Contact& contact,
                                  Seen& seen) const {
  const double of_surface = n.dot(contact.wall_velocity), dt = now.is_setup ? 0.0 : now.dt;
  double* const memory = memory_of(particles, contact);
  DampedApproach kept(memory);
  kept.advance(contact.overlap, approach - of_surface, of_surface, dt);
  if (kept.is_on()) {
    const DampedApproach::Damper damper = kept.damper(law, dt);
    const DampedOverlap own = damped_overlap(contact.overlap, law, damper, kLargest);
    seen = {kept.x(), kept.root(), 0.0, own.s, own.force, kept.dashpot(law), damper.stiffness};
    seen.rate = (seen.force - law.K * seen.x * seen.root) / seen.dashpot;
    if (!now.is_setup) kept.observe(contact.overlap + law.give * seen.force, dt);
  }
  if (!now.is_setup) kept.keep(memory);
  return kept.is_on();
}

void ComplianceCorrection::correct(const ParticleView& particles, const Time& now, const ContactModel& model,
                                   Contact& contact, Before& before) {
  const int i = contact.particle;
  const double root = std::sqrt(contact.effective_radius), K = model.hertz_constant(i) * root,
               D = model.hertz_damping(i) * std::sqrt(root);
  if (!(contact.overlap > 0.0) && !(D > 0.0 && DampedApproach::held_gap(memory_of(particles, contact)) > 0.0))
    return;
  const bool has_shear = model.shear_constant(i) > 0.0;
  const coupling::LocalCompliance::Value c = compliance_.at(contact.foot, has_shear);
  const double of_distance = 1.0 / contact.distance;
  const Vector3 n = of_distance * contact.delta;
  const double approach = n.dot(contact.wall_velocity - particles.velocity(i));
  Seen seen;
  if (D > 0.0) {
    const double delay = mesh_ ? mesh_->delay(contact.foot) : 0.0;
    const DampedLaw law = {K, D, mass_of(particles, i), c.normal.c, delay};
    contact.touches = damped(particles, now, law, n, approach, contact, seen);
    if (!contact.touches) return forget_shear(particles, now, contact);
  } else {
    seen = elastic(approach, K, c.normal.c, contact);
  }
  if (seen.s >= kLargest) fail_as_too_fine(particles, now.step, contact, seen.s);
  const SurfaceDirections directions = SurfaceDirections::at(wall_, contact.foot, contact.delta);
  before.has_tangents = true;
  before.tangents = directions.tangents;
  before.along = -0.5 * seen.force * seen.force * directions.gradient(c.normal.change);
  const double way = now.dt * std::abs(seen.rate);
  before.dashpot = seen.dashpot;
  before.stiffness = 1.5 * K * seen.root;
  before.tangent =
      ((way > seen.x ? 1.5 * K * std::sqrt(way) : before.stiffness) + seen.damper) / (1.0 - seen.s);
  contact.wall_velocity += (seen.rate - approach) * n;
  const double distance = contact.distance + contact.overlap - seen.x;
  contact.delta *= distance * of_distance;
  contact.distance = distance;
  contact.overlap = seen.x;
  if (!has_shear) return;
  const ContactModel::Shear shear = model.shear(contact);
  correct_shear(particles, now, shear, {n, shear.constant * root * seen.root}, c, directions, contact,
                before);
}

void ComplianceCorrection::correct_shear(const ParticleView& particles, const Time& now,
                                         const ContactModel::Shear& shear, const Spring& spring,
                                         const coupling::LocalCompliance::Value& c,
                                         const SurfaceDirections& directions, Contact& contact,
                                         Before& before) {
  constexpr double kSphere = 2.0 / 7.0;  // of its mass is what moves its surface along itself
  const auto& [n, stiffness] = spring;
  const Vector3 slip = shear.slip - n.dot(shear.slip) * n;
  before.shear.emplace(c, directions, n, stiffness);
  const double share = before.shear->largest_share();
  if (share >= kLargest) fail_as_too_fine(particles, now.step, contact, share);
  if (now.is_setup) return;
  // dampers of both directions have the same share of critical damping
  if (before.dashpot > 0.0) before.shear_dashpot = before.dashpot * std::sqrt(stiffness / before.stiffness);
  const double inertia = kSphere * mass_of(particles, contact.particle);
  const ShearCompliance::Step seen = before.shear->begin(
      {slip, slip + contact.wall_velocity, shear.stretch, before.shear_dashpot, inertia, now.dt},
      memory_of(particles, contact) + DampedApproach::kMemory);
  contact.wall_velocity -= seen.rate - slip;
  contact.further_slip = seen.more;
  before.goes_on = true;
}

void ComplianceCorrection::before(const ParticleView& particles, const Time& now, const ContactModel& model,
                                  Contact* begin, Contact* end) {
  before_.resize(end - begin);
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    Before& before = before_[c - begin];
    before = {contact.overlap, contact.distance, contact.touches, contact.delta, contact.wall_velocity};
    contact.further_slip.setZero();  // of the last step, if somebody asks once more
    correct(particles, now, model, contact, before);
  }
}

void ComplianceCorrection::after(const ParticleView& particles, const ContactModel& model, Contact* begin,
                                 Contact* end) {
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    const Before& before = before_[c - begin];
    Eigen::Vector2d along = before.along;
    if (before.shear) {
      const Vector3 stretch = model.shear(contact).stretch;
      if (before.goes_on) before.shear->end(stretch, memory_of(particles, contact) + DampedApproach::kMemory);
      along += before.shear->force_along(stretch);
      contact.shear_tangent = before.shear->stiffness();
      contact.shear_dashpot = before.shear_dashpot;
    }
    contact.overlap = before.overlap;
    contact.distance = before.distance;
    contact.touches = before.touches;
    contact.delta = before.delta;
    contact.wall_velocity = before.wall_velocity;
    contact.force += before.tangents * along;
    contact.has_tangents = before.has_tangents;
    contact.tangents = before.tangents;
    contact.tangent = before.tangent;
    contact.dashpot = before.dashpot;
  }
}

}  // namespace contact
