// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/contact_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/force_distribution.h"
#include "nurbs/assert.h"

namespace contact {

ContactLoop::ContactLoop(const coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange,
                         const Options& options)
    : options_(options),
      wall_(structure, exchange, options.edge_angle),
      tracker_(wall_.shape().track(candidates_, options.search, searches_)) {}

void ContactLoop::forget_reports() {
  searches_ = SearchCounts();
  inside_ = crossing_ = stiff_ = brief_ = RunAlarm();
}

/* ---------------------------------------------------------------------- the list of candidates */

void ContactLoop::build_list(const ParticleView& particles, const ListReach& reach) {
  wall_.begin_list();
  wall_travel_ = wall_.max_speed() * reach.dt;
  list_reach_.resize(particles.count);
  radius_limit_.resize(particles.count);
  double largest = 0.0;
  for (int i = 0; i < particles.count; ++i) {
    const double travel = particles.velocity(i).norm() * reach.dt + wall_travel_;
    list_reach_[i] = particles.radius[i] * reach.touch_factor + 1.5 * reach.skin + travel;
    radius_limit_[i] = particles.radius[i] + 0.5 * reach.skin / reach.touch_factor;
    largest = std::max(largest, list_reach_[i]);
  }
  const std::vector<Vector3> images = wall_images(reach.box, wall_.bounds(), wall_.frame(), largest);
  expect_images_to_stay(images);
  candidates_.build(wall_.frame(), images, {particles.count, particles.x, list_reach_.data()},
                    [&](const Vector3& point, double near, std::vector<int>& elements) {
                      wall_.shape().near(point, near, elements);
                    });
  if (wall_.deforms()) wall_.follow(candidates_.all_elements());
  tracker_->list_is_new();
  surface_motion_ = 0.0;
  forget_lost_contacts(particles);
}

// Feet keep their image while the wall turns.
void ContactLoop::expect_images_to_stay(const std::vector<Vector3>& images) const {
  constexpr double kSame = 1e-9;
  for (const Vector3& image : images)
    if ((wall_.frame().rotation * image - image).norm() > kSame * image.norm())
      throw std::runtime_error(
          "the wall turns about an axis that is not along the periodic direction across which it reaches; "
          "use a "
          "boundary that is not periodic there, or a box that holds the whole wall");
}

void ContactLoop::forget_lost_contacts(const ParticleView& particles) {
  is_candidate_.assign(particles.count, false);
  used_slots_.resize(particles.count);
  for (const Candidate& candidate : candidates_.candidates()) is_candidate_[candidate.particle] = true;
  for (int i = 0; i < particles.count; ++i) {
    const ParticleSlots slots = slots_of(particles, i);
    slots.count_used();
    if (!is_candidate_[i]) slots.clear();
  }
}

// A point of the surface is a convex combination of control points.
double ContactLoop::wall_motion() {
  if (!wall_.deforms()) return wall_.frame().max_displacement(candidates_.frame_at_build(), wall_.bounds());
  return surface_motion_ = wall_.motion_of_shape();
}

bool ContactLoop::has_outgrown_list(const ParticleView& particles) const {
  bool outgrown = false;  // no way out of the loop, so that it is vectorised
  for (int i = 0; i < particles.count; ++i) outgrown |= particles.radius[i] > radius_limit_[i];
  return wall_.any(outgrown);
}

/* ---------------------------------------------------------------------- one step */

void ContactLoop::step(const ParticleView& particles, const StepInfo& step, ContactModel& model,
                       ContactObserver* observer) {
  contacts_.clear();
  forces_on_body_.clear();
  tracker_->begin_step(surface_motion_);
  body_squared_frequency_ = wall_.squared_frequency();
  FeetTracker::Query queries[FeetTracker::kBlock];  // found together, and still at hand afterwards
  const int candidates = static_cast<int>(candidates_.candidates().size());
  for (int candidate = 0; candidate < candidates;) {
    const int count = next_block(particles, step, candidate, queries);
    tracker_->follow(queries, count);
    batch_.clear();
    for (int k = 0; k < count; ++k)
      if (!queries[k].steady || !go_on(particles, step, queries[k]))
        find_contacts(particles, step, queries[k]);
    answer(particles, step, model, observer);
  }
}

// All contacts of the batch.
inline void ContactLoop::answer(const ParticleView& particles, const StepInfo& step, ContactModel& model,
                                ContactObserver* observer) {
  if (batch_.empty()) return;
  model.evaluate(batch_.data(), static_cast<int>(batch_.size()));
  for (const Contact& contact : batch_) apply(particles, step, contact);
  if (observer)
    for (const Contact& contact : batch_)
      if (contact.touches || !contact.force.isZero(0.0)) observer->see(contact);
}

// The next candidates that may touch, from number `candidate` on.
inline int ContactLoop::next_block(const ParticleView& particles, const StepInfo& step, int& candidate,
                                   FeetTracker::Query* queries) {
  const std::vector<Candidate>& candidates = candidates_.candidates();
  int count = 0;
  for (; candidate < static_cast<int>(candidates.size()) && count < FeetTracker::kBlock; ++candidate) {
    const int i = candidates[candidate].particle;
    if (!particles.meets_wall(i)) continue;
    FeetTracker::Query& query = queries[count];
    query.centre = wall_.to_frame(particles.centre(i));
    query.touch_reach = particles.radius[i] * step.touch_factor;
    if (tracker_->is_quiet(candidate, query.centre, query.touch_reach)) continue;
    query.candidate = candidate;
    query.list_reach = list_reach_[i];
    query.particle = i;
    query.contacts = used_slots_[i];
    query.steady = nullptr;
    query.squared_travel =
        2.0 * (step.dt * step.dt * particles.velocity(i).squaredNorm() + wall_travel_ * wall_travel_);
    ++count;
  }
  return count;
}

namespace {

// The side changes where the branch goes on to another patch, and where the centre passes the surface.
bool keeps_side(const ContactSlot& slot, const Foot& foot, double radius) {
  constexpr double kDeep = 0.5;  // of the radius
  return slot.is_beside(foot.patch) && foot.distance >= kDeep * radius;
}

}  // namespace

// A contact that keeps its slot and its side; false: it may be another, ask find_contacts.
inline bool ContactLoop::go_on(const ParticleView& particles, const StepInfo& step,
                               const FeetTracker::Query& query) {
  const int i = query.particle;
  const TrackedFoot& tracked = *query.steady;
  const Foot& foot = tracked.foot;
  const double radius = particles.radius[i];
  ContactSlot slot = particles.memory.slot(i, tracked.slot);
  if (foot.distance > radius || foot.distance <= wall_.resolution() || !keeps_side(slot, foot, radius))
    return false;
  slot.set_parameters(foot.at());
  const Vector3 delta = wall_.to_space_direction(query.centre - foot.point);
  const Vector3 v_wall = wall_.velocity_below(foot, particles.centre(i), delta);
  check_crossing(particles, step, query, foot.distance, delta, v_wall);
  add_contact(particles, i, tracked, slot.history(), delta, v_wall);
  return true;
}

inline void ContactLoop::find_contacts(const ParticleView& particles, const StepInfo& step,
                                       const FeetTracker::Query& query) {
  const int i = query.particle;
  const ParticleSlots slots = slots_of(particles, i);
  const double radius = particles.radius[i];
  for (TrackedFoot& tracked : query.steady ? FeetRange{query.steady, 1} : tracker_->feet(query, slots)) {
    Foot& foot = tracked.foot;
    const bool touches = foot.distance <= radius || foot.distance < query.touch_reach;
    Vector3 delta = wall_.to_space_direction(query.centre - foot.point);
    if (std::abs(foot.distance) <= wall_.resolution()) {
      const bool is_known = tracked.slot >= 0 && slots.slot(tracked.slot).foot().patch == foot.patch;
      delta = wall_.leave(foot, delta, is_known ? slots.slot(tracked.slot).side() : 0, radius,
                          particles.centre(i), particles.velocity(i));
      tracked.side = 0;
    }
    Vector3 v_wall;
    if (touches || may_cross(particles, step, i, foot.distance)) {
      v_wall = wall_.velocity_below(foot, particles.centre(i), delta);
      check_crossing(particles, step, query, foot.distance, delta, v_wall);
    }
    if (touches) {
      tracked.slot = take_slot(particles, step, i, tracked, slots, delta);
      add_contact(particles, i, tracked, slots.slot(tracked.slot).history(), delta, v_wall);
    } else if (tracked.slot >= 0) {
      slots.slot(tracked.slot).clear();
      tracked.slot = -1;
    }
  }
}

// Whether the centre may come to the surface within one step; a wall that deforms is asked for its velocity
// only where it matters.
inline bool ContactLoop::may_cross(const ParticleView& particles, const StepInfo& step, int i,
                                   double distance) const {
  constexpr double kNear = 0.1;  // of the distance
  return !wall_.deforms() || particles.velocity(i).norm() * step.dt + wall_travel_ >= kNear * distance;
}

// A centre that comes to the surface within one step would leave it on the other side; one that was on the
// other side a step ago has done so.
inline void ContactLoop::check_crossing(const ParticleView& particles, const StepInfo& step,
                                        const FeetTracker::Query& query, double distance,
                                        const Vector3& delta, const Vector3& v_wall) {
  if (wall_.stands() && query.squared_travel < distance * distance) return;
  if (distance < 0.0) return;  // it stays on its side
  const int i = query.particle;
  const double approach = (v_wall - particles.velocity(i)).dot(delta);  // times the distance
  // In this order: the sign of the approach is anyone's guess, for the processor too.
  if (std::abs(approach) * step.dt >= distance * distance &&
      (approach > 0.0 || (approach < 0.0 && !step.is_setup)))
    crossing_.raise(particles.tag[i], particles.radius[i], std::abs(approach) / distance);
}

inline int ContactLoop::take_slot(const ParticleView& particles, const StepInfo& step, int i,
                                  const TrackedFoot& tracked, const ParticleSlots& slots,
                                  const Vector3& delta) const {
  const int place = tracked.slot >= 0 ? tracked.slot : slots.take_empty();
  if (place < 0)
    throw TooManyContacts(fmt::format("particle {} touches the wall in more than {} places at step {}",
                                      particles.tag[i], slots.slot_count(), step.number));
  ContactSlot slot = slots.slot(place);
  if (keeps_side(slot, tracked.foot, particles.radius[i]))
    slot.set_parameters(tracked.foot.at());
  else
    slot.set_foot(tracked.foot.at(), tracked.side != 0 ? tracked.side : wall_.side_of(tracked.foot, delta));
  return place;
}

inline void ContactLoop::add_contact(const ParticleView& particles, int i, const TrackedFoot& tracked,
                                     double* history, const Vector3& delta, const Vector3& v_wall) {
  NURBS_ASSERT(0 <= i && i < particles.count, i, particles.count);
  const Foot& foot = tracked.foot;
  const double radius = particles.radius[i];
  Contact& contact = batch_.emplace_back();
  contact.particle = i;
  contact.slot = tracked.slot;
  contact.foot = foot.at();
  contact.touches = foot.distance <= radius;
  contact.inside =
      foot.distance < 0.0 || (wall_.has_inside(foot.patch) && wall_.is_inside(foot, delta, tracked.side));
  contact.distance = foot.distance;
  contact.overlap = radius - foot.distance;
  contact.effective_radius = options_.curvature_radius ? wall_.effective_radius(foot, delta, radius) : radius;
  contact.delta = delta;
  contact.wall_velocity = v_wall;
  contact.history = history;
}

inline void ContactLoop::apply(const ParticleView& particles, const StepInfo& step, const Contact& contact) {
  const int i = contact.particle;
  const Vector3 &F = contact.force, &T = contact.torque;
  if (!std::isfinite(F.sum() + T.sum())) fail_as_not_finite(particles, step, contact);
  Eigen::Map<Vector3>(particles.f + 3 * i) += F;
  Eigen::Map<Vector3>(particles.torque + 3 * i) += T;
  if (contact.overlap < 0.0 && F.isZero(0.0)) return;
  if (wall_.needs_forces()) push_body(particles, step, contact);
  add_row(particles, contact);
  if (contact.inside) inside_.raise(particles.tag[i], particles.radius[i], particles.velocity(i).norm());
}

inline void ContactLoop::add_row(const ParticleView& particles, const Contact& contact) {
  const int i = contact.particle;
  const Vector3& F = contact.force;
  const Vector3 x = particles.centre(i);
  WallContact& row = contacts_.emplace_back();
  row.tag = particles.tag[i];
  row.patch = contact.foot.patch;
  row.xi[0] = contact.foot.xi[0], row.xi[1] = contact.foot.xi[1];
  Vector3::Map(row.point) = x - contact.delta;
  Vector3::Map(row.force) = -F;
  row.overlap = contact.overlap;
  Vector3::Map(row.torque) = -(contact.torque + x.cross(F));
  row.power = wall_.stands() ? 0.0 : power_of(contact, row);
  row.slot = contact.slot;
}

// The wall feels -F at the foot and what is left of the torque.
double ContactLoop::power_of(const Contact& contact, const WallContact& row) const {
  const Vector3 &F = contact.force, left = Vector3::Map(row.torque) + Vector3::Map(row.point).cross(F);
  return F.dot(contact.wall_velocity) - left.dot(wall_.frame().angular_velocity);
}

void ContactLoop::push_body(const ParticleView& particles, const StepInfo& step, const Contact& contact) {
  expect_stable(particles, step, contact);
  const Vector3 on_body = -(wall_.frame().rotation.transpose() * contact.force);
  forces_on_body_.push_back({particles.tag[contact.particle],
                             contact.slot,
                             contact.foot.patch,
                             {contact.foot.xi[0], contact.foot.xi[1]},
                             {on_body[0], on_body[1], on_body[2]}});
}

// A spring k between a particle and the surface has the squared frequency k (sum R_A^2 / m_A + 1 / m), and
// the body's own stiffness only adds to the largest (Rayleigh's quotient), at most its own largest (Weyl):
// beyond 4 / dt^2 the run blows up whatever the body, and below it together with the body's it does not.  k
// is the secant of the law, no more than its tangent as overlaps grow; in the first step of a touch it is
// that over the way of a step.
void ContactLoop::expect_stable(const ParticleView& particles, const StepInfo& step, const Contact& contact) {
  const nurbs::NodalVectors& inverse_masses = wall_.inverse_masses();
  if (inverse_masses.cols() == 0) return;
  const int i = contact.particle;
  const Vector3 n = contact.delta / contact.distance, v = particles.velocity(i) - contact.wall_velocity;
  const double depth = std::max(contact.overlap, step.dt * std::abs(n.dot(v)));
  const double stiffness = n.dot(contact.force) / depth, limit = 4.0 / (step.dt * step.dt);
  const double of_particle = particles.mass ? 1.0 / particles.mass[i] : 0.0;
  expect_long(particles, step, contact, stiffness * of_particle, n.dot(v));
  const double of_body = body_squared_frequency_;
  if (!(stiffness * (wall_.largest_inverse_mass() + of_particle) + of_body > limit)) return;
  const double of_wall = coupling::FootBasis(wall_.surface(), contact.foot).sum_of_squares(n, inverse_masses);
  const double squared_frequency = stiffness * (of_wall + of_particle);
  if (!(squared_frequency + of_body > limit)) return;
  if (!(squared_frequency > limit))
    return stiff_.raise(particles.tag[i], particles.radius[i], std::sqrt(squared_frequency + of_body));
  const double stable = 2.0 / std::sqrt(squared_frequency);
  throw std::runtime_error(
      fmt::format("the contact of particle {} is too stiff for the timestep {:.6g} at step {}: stiffness "
                  "{:.4g} between a particle of "
                  "mass {:.4g} and a surface that gives way there like a mass of {:.4g} is stable below "
                  "{:.4g}; use a timestep of "
                  "at most {:.2g}",
                  particles.tag[i], step.dt, step.number, stiffness, 1.0 / of_particle, 1.0 / of_wall, stable,
                  0.5 * stable));
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

void ContactLoop::fail_as_not_finite(const ParticleView& particles, const StepInfo& step,
                                     const Contact& contact) {
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
