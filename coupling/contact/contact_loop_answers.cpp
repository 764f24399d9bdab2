// SPDX-License-Identifier: GPL-2.0-or-later
// What becomes of the model's answers: forces on particles and on the body, alarms.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/contact/contact_loop.h"
#include "coupling/force_distribution.h"

namespace contact {

// All contacts of a block, of which those are kept that touch or have a force.
void ContactLoop::answer(const ParticleView& particles, const StepInfo& step, ContactModel& model,
                         ContactObserver* observer, std::size_t first) {
  if (first == contacts_.size()) return;
  Contact *const begin = &contacts_[first], *const end = contacts_.data() + contacts_.size();
  if (correction_)
    evaluate_corrected(particles, {step.number, step.dt, step.is_setup}, model, begin, end);
  else
    model.evaluate(begin, static_cast<int>(end - begin));
  bool are_plain = !wall_.needs_forces() && !observer;
  Vector3 sum = Vector3::Zero();  // not finite if one of them is not
  for (const Contact* contact = begin; contact < end; ++contact) {
    const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(contact->particle);
    const Vector3 &F = contact->force, &T = contact->torque;
    Eigen::Map<Vector3>(particles.f + row) += F;
    Eigen::Map<Vector3>(particles.torque + row) += T;
    sum += F + T;
    are_plain &= !contact->inside & contact->touches;
  }
  if (!sum.allFinite()) expect_finite(particles, step, begin, end);
  if (!are_plain) look_at(particles, step, model, observer, first);
}

void ContactLoop::evaluate_corrected(const ParticleView& particles, const ComplianceCorrection::Time& now,
                                     ContactModel& model, Contact* begin, Contact* end) {
  constexpr int kMost = ComplianceCorrection::kCapacity;
  corrections_.assign(static_cast<std::size_t>(end - begin), ContactCorrection());
  for (Contact* contact = begin; contact < end; ++contact)
    contact->correction = &corrections_[contact - begin];
  for (Contact* piece = begin; piece < end; piece += kMost) {
    const int count = static_cast<int>(std::min<std::ptrdiff_t>(kMost, end - piece));
    correction_->before(particles, now, model, piece, count);
    model.evaluate(piece, count);
    correction_->after(particles, now, model, piece, count);
  }
}

double ContactLoop::ask_again(const ParticleView& particles, long step, ContactModel& model,
                              Contact& contact) const {
  if (!correction_) {
    model.evaluate(&contact, 1);
    return contact.overlap;
  }
  const ComplianceCorrection::Time now = {step, 0.0, true};
  ContactCorrection correction;
  contact.correction = &correction;
  correction_->before(particles, now, model, &contact, 1);
  model.evaluate(&contact, 1);
  const double overlap = contact.overlap;
  correction_->after(particles, now, model, &contact, 1);
  contact.correction = nullptr;
  return overlap;
}

// What is neither touch nor force is none; who else has to know of the others.
void ContactLoop::look_at(const ParticleView& particles, const StepInfo& step, const ContactModel& model,
                          ContactObserver* observer, std::size_t first) {
  const auto is_none = [](const Contact& contact) { return !contact.touches && contact.force.isZero(0.0); };
  contacts_.erase(
      std::remove_if(contacts_.begin() + static_cast<std::ptrdiff_t>(first), contacts_.end(), is_none),
      contacts_.end());
  for (std::size_t k = first; k < contacts_.size(); ++k) {
    Contact& contact = contacts_[k];
    const int i = contact.particle;
    if (mesh_) look_at_mesh(particles, step, model.hertz_constant(i), contact);
    if (wall_.needs_forces()) push_body(particles, step, model, contact);
    if (contact.inside) inside_.raise(contact.tag, particles.radius[i], particles.velocity(i).norm());
    if (observer) observer->see(contact);
  }
}

// Its foot would leave its place.
void ContactLoop::fail_as_turning(const ParticleView& particles, const StepInfo& step, const Contact& contact,
                                  double turning) {
  constexpr double kSafe = 1.1;
  const Vector3 foot = contact.centre - contact.delta;
  throw std::runtime_error(fmt::format(
      "elements at ({:.6g}, {:.6g}, {:.6g}) are too small for the contact of particle {} (radius {:.4g}, "
      "overlap {:.4g}) at step {}: they turn below it ({:.2g}, expected at most {:.2g}); use elements at "
      "least "
      "{:.2g} times as large there, or 'compliance none'",
      foot[0], foot[1], foot[2], contact.tag, particles.radius[contact.particle], contact.overlap,
      step.number, turning, kTurning, kSafe * std::cbrt(turning / kTurning)));
}

// The speed of the impact is that of the first step of a touch.
inline void ContactLoop::look_at_mesh(const ParticleView& particles, const StepInfo& step,
                                      double hertz_constant, Contact& contact) {
  contact.missing = mesh_->missing(contact, hertz_constant);
  const auto raise = [&](MeshAlarm& alarm, double value, double corrected = 0.0) {
    alarm.raise(contact.tag, contact.centre - contact.delta, mesh_->size(contact.foot), value, corrected);
  };
  if (!correction_) {
    if (contact.missing > kMissing) raise(uncorrected_, contact.missing);
    return;
  }
  constexpr double kAtSeam = 1.37,
                   kLooked = kTurning / kAtSeam;  // elements there turn as if 0.9 times as long
  if (const double squared = mesh_->squared_turning(contact, hertz_constant); squared > kLooked * kLooked) {
    const double turning = std::sqrt(squared) * (wall_.is_at_seam(contact.foot) ? kAtSeam : 1.0);
    if (turning > kTurning && contact.correction && contact.correction->spread != 0.0)
      fail_as_turning(particles, step, contact, turning);
    if (turning > kTurning) raise(turning_, turning);
  }
  if (contact.missing > kMissing && wall_.is_at_kink(contact.foot)) raise(kinked_, contact.missing);
  constexpr double kFirst = 1.01;  // of the way of a step
  const int i = contact.particle;
  const double approach = contact.normal().dot(contact.wall_velocity - particles.velocity(i));
  if (!particles.mass || !(kFirst * approach * step.dt > contact.overlap) || !(contact.overlap > 0.0)) return;
  const double mass = particles.mass[i], waves = mesh_->waves(contact, hertz_constant, mass, approach);
  if (waves > 1.0) raise(not_static_, waves, mesh_->missing_at_peak(contact, hertz_constant, mass, approach));
}

void ContactLoop::push_body(const ParticleView& particles, const StepInfo& step, const ContactModel& model,
                            const Contact& contact) {
  expect_stable(particles, step, model.hertz_damping(contact.particle), contact);
  const Vector3 on_body = -wall_.to_frame_direction(contact.force);
  coupling::ContactForce& force = forces_on_body_.emplace_back();  // a copy of the whole waits for its parts
  force.tag = particles.tag[contact.particle];
  force.branch = contact.slot;
  force.patch = contact.foot.patch;
  for (int i = 0; i < 2; ++i) force.xi[i] = contact.foot.xi[i];
  Vector3::Map(force.F) = on_body;
  if (contact.correction) {
    const ContactCorrection& by = *contact.correction;
    const double of_links = 1.0 - 0.5 * by.spread;  // links see that much of it, at most
    force.stiffness = by.stiffness * of_links * of_links;
    if (by.spread != 0.0) {
      force.is_spread = true;
      Vector3::Map(force.spread) = -by.spread * wall_.to_frame_direction(contact.force - by.further_force());
    }
  }
  if (wall_.deforms() && (contact.correction || !contact.torque.isZero(0.0))) turn_body(contact, force);
}

// What acts on the particle has a moment about the foot if the law has its point of contact elsewhere, or
// resists rolling: the body has the opposite one.  A rigid wall takes it from the contact's torque.
inline void ContactLoop::turn_body(const Contact& contact, coupling::ContactForce& on_body) const {
  Vector3 force = contact.force;
  Vector3 first, second;
  const ContactCorrection* const by = contact.correction;
  if (by) {
    first = wall_.to_frame_direction(by->tangents.col(0));
    second = wall_.to_frame_direction(by->tangents.col(1));
    // What follows the foot does work where the surface turns below the centre (surface_directions.h).
    force.noalias() -= by->tangents * by->follows;
  } else {
    const nurbs::Tangents S =
        coupling::FootSlopes(wall_.surface(), contact.foot).tangents(wall_.control_points());
    first = S.col(0), second = S.col(1);
  }
  Vector3 moment = contact.torque + contact.delta.cross(force);
  if (by) {
    moment += by->shift.cross(contact.force);  // the body's foot is where its nodes have it
    if (by->spread != 0.0) moment -= by->spread * by->beside.cross(contact.force - by->further_force());
  }
  const Vector3 couple = -wall_.to_frame_direction(moment);
  on_body.has_couple = true;
  const std::array<Vector3, 2> G = coupling::couple_forces(first, second, couple);
  const Vector3 delta = wall_.to_frame_direction(contact.delta);
  for (int j = 0; j < 2; ++j)
    Vector3::Map(on_body.couple[j]) = by ? Vector3(G[j] + by->follows[j] * delta) : G[j];
}

namespace {

/// A contact's springs between a particle and a surface that gives way like masses, along the normal and
/// along the surface, each with a damper that acts on the particle alone; and one along the normal that acts
/// on both.
struct ContactSprings {
  double stiffness, dashpot, shear_stiffness, shear_dashpot, dashpot_of_both;
  double of_particle;  // 1 / mass

  /// Squared frequency k / m, and gamma / m.
  struct Frequency {
    double squared, rate;
    // Of a damper that sees half-step velocities: k dt^2 + 2 gamma dt = 4 m.
    double stable_step() const { return 4.0 / (rate + std::sqrt(rate * rate + 4.0 * squared)); }
  };
  /// The one of the two with the smaller stable step.
  Frequency highest(double of_wall) const {
    constexpr double kSphere = 3.5;  // a sphere's surface gives way along itself like 2/7 of its mass
    const double along = kSphere * of_particle;
    const double of_both = of_wall + of_particle;
    const Frequency normal = {stiffness * of_both, dashpot * of_particle + dashpot_of_both * of_both},
                    shear = {shear_stiffness * (of_wall + along), shear_dashpot * along};
    return normal.stable_step() < shear.stable_step() ? normal : shear;
  }
};

}  // namespace

// A spring k between a particle and the surface has the squared frequency k (sum R_A^2 / m_A + 1 / m), and
// the body's own stiffness only adds to the largest (Rayleigh's quotient), at most its own largest (Weyl):
// beyond 4 / dt^2 the run blows up whatever the body, and below it together with the body's it does not.  k
// is the secant of the law, no more than its tangent as overlaps grow; in the first step of a touch it is
// that over the way of a step.  A dashpot takes 2 gamma / (m dt) of 4 / dt^2; that of the law, which acts on
// the particle and on the nodes, 2 gamma (sum R_A^2 / m_A + 1 / m) / dt.
void ContactLoop::expect_stable(const ParticleView& particles, const StepInfo& step, double hertz_damping,
                                const Contact& contact) {
  if (!wall_.knows_masses()) return;
  const int i = contact.particle;
  const Vector3 n = contact.normal(), v = particles.velocity(i) - contact.wall_velocity;
  const double depth = std::max(contact.overlap, step.dt * std::abs(n.dot(v)));
  static const ContactCorrection none;
  const ContactCorrection& by = contact.correction ? *contact.correction : none;
  const double stiffness = by.tangent > 0.0 ? by.tangent : n.dot(contact.force) / depth;
  const double of_particle = particles.mass ? 1.0 / particles.mass[i] : 0.0;
  expect_long(particles, step, contact, stiffness * of_particle, n.dot(v));
  const double law = contact.correction ? 0.0 : hertz_damping,
               of_both =
                   law * std::sqrt(std::sqrt(contact.effective_radius * std::max(contact.overlap, 0.0)));
  const ContactSprings springs = {std::max(stiffness, 0.0), by.dashpot, by.shear_tangent,
                                  by.shear_dashpot,         of_both,    of_particle};
  const auto is_stable = [&](ContactSprings::Frequency frequency, double of_body) {
    frequency.squared += of_body;
    return !(frequency.stable_step() < step.dt);
  };
  const double of_body = body_squared_frequency_;
  if (is_stable(springs.highest(wall_.largest_inverse_mass()), of_body)) return;
  const double of_wall = wall_.inverse_mass_at(contact.foot, n);
  ContactSprings::Frequency frequency = springs.highest(of_wall);
  if (is_stable(frequency, of_body)) return;
  const double stable = frequency.stable_step();
  if (is_stable(frequency, 0.0)) {
    frequency.squared += of_body;
    return stiff_.raise(particles.tag[i], particles.radius[i], 2.0 / frequency.stable_step());
  }
  throw std::runtime_error(
      fmt::format("the contact of particle {} is too stiff for the timestep {:.6g} at step {}: stiffness "
                  "{:.4g}{} between a particle of mass {:.4g} and a surface that gives way there like a mass "
                  "of {:.4g} is stable below {:.4g}; use a timestep of at most {:.2g}",
                  particles.tag[i], step.dt, step.number, stiffness,
                  of_both > 0.0 ? fmt::format(" with a damping of {:.4g}", of_both) : "", 1.0 / of_particle,
                  1.0 / of_wall, stable, 0.5 * stable));
}

// Where a contact is deepest its damping is out of it.  A sphere's after Hertz lasts 2.943 delta / V, and the
// secant there has sqrt(k/m) = sqrt(5/4) V / delta (Johnson 1985, sec. 11.4).
inline void ContactLoop::expect_long(const ParticleView& particles, const StepInfo& step,
                                     const Contact& contact, double squared_frequency, double speed) {
  constexpr double kDeep = 10.0, kTurn = 2.943 * 1.118;
  const double shortest = wall_.shortest_contact(), turn = kTurn / shortest;
  if (!(squared_frequency > turn * turn) || contact.overlap < kDeep * step.dt * std::abs(speed)) return;
  const int i = contact.particle;
  brief_.raise(particles.tag[i], particles.radius[i], std::sqrt(squared_frequency) / kTurn);
}

void ContactLoop::expect_finite(const ParticleView& particles, const StepInfo& step, const Contact* contacts,
                                const Contact* end) {
  const Contact* const found = std::find_if(
      contacts, end, [](const Contact& c) { return !std::isfinite(c.force.sum() + c.torque.sum()); });
  if (found == end) return;
  const Contact& contact = *found;
  const int i = contact.particle;
  const Vector3 x = particles.centre(i), v = particles.velocity(i);
  const Vector3& F = contact.force;
  throw std::runtime_error(fmt::format(
      "the contact of particle {} is not finite at step {}: centre ({:.6g}, {:.6g}, {:.6g}), {:.6g} from the "
      "wall, radius {:.6g}, velocity ({:.6g}, {:.6g}, {:.6g}), force ({:.6g}, {:.6g}, {:.6g}); use a smaller "
      "timestep, or look at the material and at what has changed the particle",
      particles.tag[i], step.number, x[0], x[1], x[2], contact.distance, particles.radius[i], v[0], v[1],
      v[2], F[0], F[1], F[2]));
}

}  // namespace contact
