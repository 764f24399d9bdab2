// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/compliance.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "coupling/contact/foot_motion.h"

namespace contact {

// With c > 0 the left side is concave and Newton's steps come up from below; with c < 0 it is convex, and
// they come down from above.
CorrectedOverlap corrected_overlap(double overlap, double c, double K, double limit) {
  constexpr int kMostSteps = 60;
  constexpr double kSame = 1e-14;
  CorrectedOverlap at{overlap, 0.0};
  for (int step = 0; step < kMostSteps; ++step) {
    const double cK_root = c * K * std::sqrt(at.x);
    at.s = 1.5 * cK_root;
    if (at.s >= limit) return at;
    const double change = (overlap - at.x * (1.0 - cK_root)) / (1.0 - at.s);
    at.x += change;
    if (std::abs(change) <= kSame * at.x) break;
  }
  return at;
}

namespace {

[[noreturn]] void fail_as_too_fine(const ParticleView& particles, long step, const Contact& contact,
                                   double s) {
  constexpr double kSafe = 0.6;
  const int i = contact.particle;
  const Vector3 foot = particles.centre(i) - contact.delta;
  throw std::runtime_error(fmt::format(
      "elements at ({:.6g}, {:.6g}, {:.6g}) are too small for the contact of particle {} at step {}: what "
      "they give way is {:.2g} of what its law does, expected at most {:.2g}; use elements at least {:.2g} "
      "times as large there, or 'compliance none'",
      foot[0], foot[1], foot[2], particles.tag[i], step, s, ComplianceCorrection::kLargest, s / kSafe));
}

}  // namespace

/// Of c with the centre's place.
Vector3 ComplianceCorrection::gradient(const Contact& contact, const std::array<double, 2>& change) const {
  const nurbs::MultiPatch& surface = wall_.surface();
  const int patch = contact.foot.patch;
  const Eigen::Matrix<double, 3, 2> motion =
      foot_motion(surface.patch(patch), contact.foot.xi, {wall_.control_points(), undeformed_},
                  surface.first_control_point(patch), wall_.to_frame_direction(contact.delta));
  return wall_.to_space_direction(motion * Eigen::Vector2d(change[0], change[1]));
}

void ComplianceCorrection::correct(const ParticleView& particles, long step, double K, Contact& contact,
                                   Before& before) {
  const coupling::LocalCompliance::Value c = compliance_.at(contact.foot);
  const auto [x, s] = corrected_overlap(contact.overlap, c.normal, K, kLargest);
  if (s >= kLargest) fail_as_too_fine(particles, step, contact, s);
  const double F = K * x * std::sqrt(x), tangent = 1.5 * K * std::sqrt(x) / (1.0 - s);
  before.along = -0.5 * F * F * gradient(contact, c.change);
  before.tangent = tangent;
  // dx/dt = d(overlap)/dt / (1 - s), for what depends on it
  const Vector3 n = contact.delta / contact.distance;
  const double approach = n.dot(contact.wall_velocity - particles.velocity(contact.particle));
  contact.wall_velocity += approach * s / (1.0 - s) * n;
  const double distance = contact.distance + contact.overlap - x;
  contact.delta *= distance / contact.distance;
  contact.distance = distance;
  contact.overlap = x;
}

void ComplianceCorrection::before(const ParticleView& particles, long step, const ContactModel& model,
                                  Contact* begin, Contact* end) {
  before_.clear();
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    Before& before = before_.emplace_back(Before{contact.overlap, contact.distance, contact.delta,
                                                 contact.wall_velocity, Vector3::Zero(), 0.0});
    if (!(contact.overlap > 0.0)) continue;
    const double K = model.hertz_constant(contact.particle) * std::sqrt(contact.effective_radius);
    correct(particles, step, K, contact, before);
  }
}

void ComplianceCorrection::after(Contact* begin, Contact* end) {
  for (Contact* c = begin; c < end; ++c) {
    Contact& contact = *c;
    const Before& before = before_[c - begin];
    contact.overlap = before.overlap;
    contact.distance = before.distance;
    contact.delta = before.delta;
    contact.wall_velocity = before.wall_velocity;
    contact.force += before.along;
    contact.tangent = before.tangent;
  }
}

}  // namespace contact
