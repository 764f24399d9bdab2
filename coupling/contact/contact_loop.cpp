// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/contact_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/force_distribution.h"
#include "nurbs/assert.h"
#include "nurbs/processor.h"

namespace contact {

ContactLoop::ContactLoop(const coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange,
                         const Options& options)
    : options_(options),
      wall_(structure, exchange, options.edge_angle),
      repeated_(wall_.shape()),
      tracker_(wall_.shape().track(candidates_, options.search, searches_)),
      mesh_(MeshEstimate::of(structure, exchange.positions())),
      kernel_(feet_kernel(nurbs::simd_level())) {
  if (coupling::LocalCompliance* const compliance = structure.local_compliance())
    correction_ = std::make_unique<ComplianceCorrection>(*compliance, wall_, mesh_.get());
}

void ContactLoop::forget_reports() {
  searches_ = SearchCounts();
  inside_ = crossing_ = stiff_ = brief_ = RunAlarm();
  uncorrected_ = turning_ = kinked_ = not_static_ = MeshAlarm();
}

/* ---------------------------------------------------------------------- the list of candidates */

void ContactLoop::build_list(const ParticleView& particles, const ListReach& reach) {
  wall_.begin_list();
  wall_travel_ = wall_.max_speed() * reach.dt;
  list_reach_.resize(particles.count);
  radius_limit_.resize(particles.count);
  double largest = 0.0;
  for (int i = 0; i < particles.count; ++i) {
    if (!particles.meets_wall(i)) {
      list_reach_[i] = CandidateList::kNotAtAll;
      radius_limit_[i] = std::numeric_limits<double>::infinity();
      continue;
    }
    const double travel = particles.velocity(i).norm() * reach.dt + wall_travel_;
    list_reach_[i] = particles.radius[i] * reach.touch_factor + 1.5 * reach.skin + travel;
    radius_limit_[i] = particles.radius[i] + 0.5 * reach.skin / reach.touch_factor;
    largest = std::max(largest, list_reach_[i]);
  }
  const std::vector<Vector3> images = wall_images(reach.box, wall_.bounds(), wall_.frame(), largest);
  expect_images_to_stay(images);
  candidates_.build(
      wall_.frame(), images, {particles.count, particles.x, list_reach_.data()},
      [&](int particle, const Vector3& point, double near, std::vector<int>& elements) {
        if (images.size() > 1) return wall_.shape().near(point, near, elements);
        wall_.shape().near_particle(particle, point, near, elements);
      },
      [&](const Vector3& shift, const Vector3& point, double near, const int* elements, int count) {
        return !wall_.deforms() && repeated_.all(shift, point, near, elements, count);
      });
  if (wall_.deforms()) wall_.follow(candidates_.all_elements());
  tracker_->list_is_new();
  tracker_->go_on({particles.tag, particles.x, list_reach_.data()});
  surface_motion_ = 0.0;
  list_is_new_ = true;
  forget_lost_contacts(particles);
  if (correction_ && correction_->follows_strain()) correction_->follow_strain(feet_in_memory(particles));
}

// Feet keep their image while the wall turns.
void ContactLoop::expect_images_to_stay(const std::vector<Vector3>& images) const {
  constexpr double kSame = 1e-9;
  for (const Vector3& image : images)
    if ((wall_.frame().rotation * image - image).norm() > kSame * image.norm())
      throw std::runtime_error(
          "the wall turns about an axis that is not along the periodic direction across which it reaches; "
          "use a boundary that is not periodic there, or a box that holds the whole wall");
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

std::vector<nurbs::SurfacePoint> ContactLoop::feet_in_memory(const ParticleView& particles) {
  std::vector<nurbs::SurfacePoint> feet;
  for (int i = 0; i < particles.count; ++i) {
    const ParticleSlots slots = slots_of(particles, i);
    for (int s = 0; s < slots.used(); ++s)
      if (const ContactSlot slot = slots.slot(s); !slot.empty()) feet.push_back(slot.foot());
  }
  return feet;
}

// A point of the surface is a convex combination of control points.
double ContactLoop::wall_motion() {
  if (!wall_.deforms()) return wall_.frame().max_displacement(candidates_.frame_at_build(), wall_.bounds());
  return surface_motion_ = wall_.motion_of_shape();
}

bool ContactLoop::has_outgrown_list(const ParticleView& particles) const {
  return wall_.any(kernel_.any_above(particles.radius, radius_limit_.data(), particles.count));
}

bool ContactLoop::has_other_members(const ParticleView& particles) const {
  bool differs = particles.count != static_cast<int>(list_reach_.size());
  for (int i = 0; i < particles.count && !differs; ++i)
    differs = particles.meets_wall(i) == (list_reach_[i] == CandidateList::kNotAtAll);
  return wall_.any(differs);
}

/* ---------------------------------------------------------------------- one step */

void ContactLoop::step(const ParticleView& particles, const StepInfo& step, ContactModel& model,
                       ContactObserver* observer) {
  contacts_.clear();
  rows_.begin_step(wall_.stands(), wall_.frame().angular_velocity);
  forces_on_body_.clear();
  tracker_->begin_step(surface_motion_);
  body_squared_frequency_ = wall_.squared_frequency();
  is_plain_ = wall_.stands() && !options_.curvature_radius;
  squared_time_ = 2.0 * step.dt * step.dt, squared_way_ = 2.0 * wall_travel_ * wall_travel_;
  FeetTracker::Query queries[FeetTracker::kBlock];  // found together, and still at hand afterwards
  const int candidates = static_cast<int>(candidates_.candidates().size()), block = tracker_->block();
  searches_.near += candidates;
  for (int begin = 0; begin < candidates; begin += block) {
    const std::size_t first = contacts_.size();
    const int end = std::min(begin + block, candidates);
    const int count = take_steady(particles, step, begin, end, queries);
    tracker_->follow(queries, count);
    for (int k = 0; k < count; ++k) find_contacts(particles, step, queries[k]);
    if (correction_) prefetch_rows(particles, end, std::min(end + block, candidates));
    answer(particles, step, model, observer, first);
  }
  list_is_new_ = false;
}

// Candidates [begin, end) that are steady become contacts, others that may touch queries; how many of these.
inline int ContactLoop::take_steady(const ParticleView& particles, const StepInfo& step, int begin, int end,
                                    FeetTracker::Query* queries) {
  const Candidate* const candidates = candidates_.candidates().data();
  const std::size_t before = contacts_.size();
  if (tracker_->steady()) contacts_.resize(before + SteadyFeet::kMostFeet * SteadyFeet::kBlock);  // at most
  Contact* next = contacts_.data() + before;
  SteadyFeet* const steady = find_steady(particles, step, begin, end, next);
  int count = 0;
  for (int candidate = begin; candidate < end; ++candidate) {
    const int i = candidates[candidate].particle, k = candidate - begin;
    if (steady && steady->is_there(k) && settle(particles, *steady, k, i)) {
      go_on(particles, step, i, steady->foot(k), *next++);
      if (steady->feet(k) > 1) next = go_on_with_others(particles, step, i, *steady, k, next);
    } else if (particles.meets_wall(i)) {
      FeetTracker::Query& query = queries[count];
      begin_query(particles, step, candidate, query);
      if (!tracker_->is_quiet(candidate, query.centre, query.touch_reach)) ++count;
    }
  }
  contacts_.resize(static_cast<std::size_t>(next - contacts_.data()));
  return count;
}

// Null: none of them is steady.  Contacts will be written from `next` on; most particles have one, in their
// first slot.
inline SteadyFeet* ContactLoop::find_steady(const ParticleView& particles, const StepInfo& step, int begin,
                                            int end, const Contact* next) {
  SteadyFeet* const steady = tracker_->steady();
  if (!steady || !steady->begin_block(begin, end - begin, wall_.frame(), wall_.is_turned())) return nullptr;
  const Candidate* const candidates = candidates_.candidates().data();
  const ParticleView p = particles;
  for (int candidate = begin; candidate < end; ++candidate) {
    if (!steady->has(candidate - begin)) {
      tracker_->prefetch_quiet(candidate);
      continue;
    }
    const std::ptrdiff_t i = candidates[candidate].particle;
    nurbs::prefetch_to_write(p.memory.slots[0] + p.memory.offset(static_cast<int>(i)), sizeof(double));
    nurbs::prefetch_to_write(next + (candidate - begin), sizeof(Contact));
    if (p.meets_wall(static_cast<int>(i)))
      steady->add(candidate - begin, p.x + 3 * i, p.v + 3 * i,
                  touch_reach(particles, step, static_cast<int>(i)));
  }
  steady->find({squared_time_, squared_way_, wall_.resolution()});
  return steady;
}

// Rows of contacts that are corrected are long, and the first to be read.
[[gnu::always_inline]] inline void ContactLoop::prefetch_rows(const ParticleView& particles, int begin,
                                                              int end) const {
  const ContactMemory& memory = particles.memory;
  const std::size_t bytes = sizeof(double) * ContactMemory::row_size(memory.history_count);
  for (int candidate = begin; candidate < end; ++candidate)
    if (const int i = candidates_.candidates()[candidate].particle; used_slots_[i] > 0)
      nurbs::prefetch_to_write(memory.slots[0] + memory.offset(i), bytes);
}

// Contacts that are corrected may go on where the surfaces have lost touch.
inline double ContactLoop::touch_reach(const ParticleView& particles, const StepInfo& step, int i) const {
  const double reach = particles.radius[i] * step.touch_factor;
  if (!correction_) return reach;
  const ContactMemory& memory = particles.memory;
  int used = used_slots_[i];
  return reach + ComplianceCorrection::held_gap(memory.of(i, used), memory.history_count);
}

inline void ContactLoop::begin_query(const ParticleView& particles, const StepInfo& step, int candidate,
                                     FeetTracker::Query& query) const {
  const int i = candidates_.candidates()[candidate].particle;
  query.candidate = candidate, query.particle = i;
  query.centre = wall_.to_frame(particles.centre(i));
  query.touch_reach = touch_reach(particles, step, i), query.list_reach = list_reach_[i];
  query.squared_travel = squared_travel(particles, i);
}

// How far a particle and the wall move in a step, at most, squared.
inline double ContactLoop::squared_travel(const ParticleView& particles, int i) const {
  const double* const v = particles.v + 3 * static_cast<std::ptrdiff_t>(i);
  return squared_time_ * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + squared_way_;
}

namespace {

// The side changes where the branch goes on to another patch or, of one that is cut, to another part, and
// where the centre passes the surface; and somebody may have put the particle elsewhere before a new list.
bool keeps_side(const ContactSlot& slot, const TrackedFoot& tracked, double radius) {
  return slot.is_beside(tracked.foot.patch) && (tracked.side == 0 || tracked.side == slot.side()) &&
         tracked.foot.distance >= kDeepInReach * radius;
}

}  // namespace

// Finds the slots of a candidate's feet, each on its face; false: they may be others, ask find_contacts.
inline bool ContactLoop::settle(const ParticleView& particles, SteadyFeet& steady, int k, int i) {
  return steady.foot(k).slot() >= 0 || find_slots(slots_of(particles, i), steady, k);
}

bool ContactLoop::find_slots(const ParticleSlots& slots, SteadyFeet& steady, int k) {
  if (slots.filled() != steady.feet(k)) return false;
  for (int n = 0; n < steady.feet(k); ++n) {
    const SteadyFeet::Foot foot = steady.foot(k, n);
    int s = 0;
    while (s < slots.used() && !steady.has_been_on_face(slots.slot(s), foot)) ++s;
    if (s == slots.used()) return false;
    steady.settle(k, n, s);
  }
  return true;
}

// A contact that keeps its slot and its side.
[[gnu::always_inline]] inline void ContactLoop::go_on(const ParticleView& particles, const StepInfo& step,
                                                      int i, const SteadyFeet::Foot& foot, Contact& contact) {
  const nurbs::Parameter<2> xi = foot.xi();
  begin_contact(particles, i, foot.slot(), foot.distance(), contact);
  contact.foot.patch = foot.patch(), contact.foot.xi = xi;
  contact.delta = foot.delta();
  contact.wall_velocity.setZero();
  contact.inside = false;  // bodies with an inside deform
  ContactSlot slot = particles.memory.slot(i, foot.slot());
  slot.set_parameters({foot.patch(), xi});
  contact.history = slot.history();
  searches_.add_direct(foot.status());
  if (!is_plain_) complete(particles, step, foot, contact);
}

// On walls that move, or whose curvature counts.
void ContactLoop::complete(const ParticleView& particles, const StepInfo& step, const SteadyFeet::Foot& foot,
                           Contact& contact) {
  if (!wall_.stands()) {
    contact.wall_velocity = wall_.velocity_of_rigid(contact.centre - contact.delta, contact.delta);
    check_crossing(particles, step, contact.particle, contact.distance, contact.delta, contact.wall_velocity);
  }
  if (options_.curvature_radius) {
    const Vector3 point = wall_.to_frame(contact.centre - contact.delta);
    contact.effective_radius =
        wall_.effective_radius({foot.xi(), point, contact.distance, foot.status(), 0, foot.patch()},
                               contact.delta, contact.effective_radius);
  }
}

Contact* ContactLoop::go_on_with_others(const ParticleView& particles, const StepInfo& step, int i,
                                        const SteadyFeet& steady, int k, Contact* next) {
  for (int n = 1; n < steady.feet(k); ++n) go_on(particles, step, i, steady.foot(k, n), *next++);
  return next;
}

inline void ContactLoop::find_contacts(const ParticleView& particles, const StepInfo& step,
                                       const FeetTracker::Query& query) {
  const int i = query.particle;
  const ParticleSlots slots = slots_of(particles, i);
  const double radius = particles.radius[i];
  for (TrackedFoot& tracked : tracker_->feet(query, slots)) {
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
      if (!wall_.stands() || query.squared_travel >= foot.distance * foot.distance)
        check_crossing(particles, step, i, foot.distance, delta, v_wall);
    }
    if (touches) {
      const int slot = tracked.slot = take_slot(particles, step, i, tracked, slots, delta);
      Contact& contact = contacts_.emplace_back();
      begin_contact(particles, i, slot, foot.distance, contact);
      contact.foot.patch = foot.patch, contact.foot.xi = foot.xi;  // a copy of the whole waits for its parts
      contact.delta = delta;
      contact.wall_velocity = v_wall;
      ContactSlot own = slots.slot(slot);
      contact.inside = foot.distance < 0.0 || wall_.is_inside(foot, own.side());
      if (options_.curvature_radius) contact.effective_radius = wall_.effective_radius(foot, delta, radius);
      contact.history = own.history();
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
inline void ContactLoop::check_crossing(const ParticleView& particles, const StepInfo& step, int i,
                                        double distance, const Vector3& delta, const Vector3& v_wall) {
  if (distance < 0.0) return;                                           // it stays on its side
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
  if (!list_is_new_ && keeps_side(slot, tracked, particles.radius[i]))
    slot.set_parameters(tracked.foot.at());
  else
    slot.set_foot(tracked.foot.at(), tracked.side != 0 ? tracked.side : wall_.side_of(tracked.foot, delta));
  return place;
}

// All but its foot and the wall's velocity there.
inline void ContactLoop::begin_contact(const ParticleView& particles, int i, int slot, double distance,
                                       Contact& contact) {
  NURBS_ASSERT(0 <= i && i < particles.count, i, particles.count);
  const double radius = particles.radius[i];
  const int tag = particles.tag[i];
  const Vector3 centre = particles.centre(i);
  contact.particle = i;
  contact.tag = tag;
  contact.slot = slot;
  contact.touches = distance <= radius;
  contact.distance = distance;
  contact.overlap = radius - distance;
  contact.effective_radius = radius;
  contact.centre = centre;
  contact.missing = 0.0;
  contact.correction = nullptr;
}

}  // namespace contact
