// SPDX-License-Identifier: GPL-2.0-or-later
// Particles in; forces on particles, contacts of the wall and alarms out.  One call of step() per time step:
// the feet of each particle near the wall are followed (contact_tracker.h), those within reach become
// contacts with a slot of the particle's memory, the contact model answers a batch of them at a time, and its
// answers are added to the particles.  Method: Gao & Feng (2019), section 4.
//
// Before the first step wall().import() and build_list(); then a time step of a particle code is, in this
// order:
//   structure.begin_step(), particles drift
//   wall().import();  if (wall_motion() > skin / 2 or the particles' own list is due) build_list()
//   step();  nodal forces = exchange.export_add(forces_on_body())
//   structure.end_step(nodal forces), particles' second half kick
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "coupling/contact/candidate_list.h"
#include "coupling/contact/compliance.h"
#include "coupling/contact/contact_model.h"
#include "coupling/contact/contact_rows.h"
#include "coupling/contact/feet_tracker.h"
#include "coupling/contact/mesh_estimate.h"
#include "coupling/contact/particle_view.h"
#include "coupling/contact/periodic_images.h"
#include "coupling/contact/repeated_elements.h"
#include "coupling/contact/run_alarm.h"
#include "coupling/contact/wall.h"

namespace contact {

/// How far the list of candidates reaches: from where the particles' code built its own lists a particle
/// moves by half a skin to either side (what it grows counts as motion) before they are built anew, and the
/// wall may move half a skin more; what is faster than that must not slip through unseen.
struct ListReach {
  double skin;          ///< [length]
  double touch_factor;  ///< on the radius: within how much of it models with cohesion act; 1 without
  double dt;            ///< [time]
  PeriodicBox box;
};

/// What step() needs to know of the time step.
struct StepInfo {
  long number;
  double dt;            ///< [time]
  double touch_factor;  ///< as in ListReach
  bool is_setup;        ///< forces are evaluated before a run, nothing has moved
};

/// A particle touches the wall in more places than its memory has slots.
struct TooManyContacts : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ContactLoop {
 public:
  struct Options {
    SearchMethod search = SearchMethod::newton;
    double edge_angle = brep::kEdgeAngle;  ///< edges between patches that turn by no more are smooth [rad]
    bool curvature_radius = false;         ///< the effective radius takes the wall's curvature into account
  };

  /// Keeps references to both.
  ContactLoop(const coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange,
              const Options& options);

  Wall& wall() { return wall_; }

  /// Global search, for all particles of this rank; forgets the contacts of those that are out of reach.
  /// Collective, as are the next three.
  /// Throws std::runtime_error if the wall has turned so that its periodic images do not fit.
  void build_list(const ParticleView& particles, const ListReach& reach);
  /// Largest distance that a point of the wall has moved since then, at most; not finite if its place is not
  /// [length].
  double wall_motion();
  /// Whether a particle has grown more than the list allows for: of this rank or, where the wall is in parts,
  /// of any.
  bool has_outgrown_list(const ParticleView& particles) const;
  /// Whether other particles than those of the list meet the wall now; likewise.
  bool has_other_members(const ParticleView& particles) const;
  long candidate_count() const { return static_cast<long>(candidates_.candidates().size()); }

  /// Adds the wall's forces to the particles, whose number and order are those of build_list.  Throws
  /// TooManyContacts, and std::runtime_error if an answer of the model is not finite or a contact is so stiff
  /// that no body could bear the time step: particle, place, step.
  void step(const ParticleView& particles, const StepInfo& step, ContactModel& model,
            ContactObserver* observer = nullptr);

  /// Of the last step, those that touch or have a force; this rank's.  Their `history` is gone with the step.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// The same as the wall feels them, made when asked for.
  const std::vector<WallContact>& rows() const { return rows_.of(contacts_); }
  /// The same for SurfaceExchange::export_add, in the wall's frame; empty if the structure needs no forces.
  const std::vector<coupling::ContactForce>& forces_on_body() const { return forces_on_body_; }

  /// Asks the model once more for a contact of the last step whose memory is at hand again, as step() did;
  /// adds nothing to anything.  The result is the overlap that the model has seen [length].
  double ask_again(const ParticleView& particles, long step, ContactModel& model, Contact& contact) const;

  /// What has happened since these were forgotten last, on this rank.
  void forget_reports();
  const SearchCounts& searches() const { return searches_; }
  const RunAlarm& inside() const { return inside_; }      ///< centres inside the body
  const RunAlarm& crossing() const { return crossing_; }  ///< centres that may cross the surface in a step
  /// Contacts that together with the body's vibrations may be too stiff for the step, which either alone is
  /// not.  No frequency of the two is above that of the alarm.
  const RunAlarm& stiff() const { return stiff_; }
  /// Contacts that are too short for the body (StructureSolver::shortest_contact); 1 over how long they last.
  const RunAlarm& brief() const { return brief_; }
  /// Contacts that miss more than kMissing of their force to the mesh: nothing corrects them.
  const MeshAlarm& uncorrected() const { return uncorrected_; }
  static constexpr double kMissing = 0.02;
  /// Contacts that are corrected on elements so small that they turn below them
  /// (MeshEstimate::squared_turning).
  const MeshAlarm& turning() const { return turning_; }
  static constexpr double kTurning = 0.41;  ///< those that are spread are refused then
  /// Contacts that are corrected where the mesh kinks under them, by more than kMissing of their force.
  const MeshAlarm& kinked() const { return kinked_; }
  /// Contacts that are corrected by what is static, and are shorter than that (MeshEstimate::waves > 1).
  const MeshAlarm& not_static() const { return not_static_; }

 private:
  void expect_images_to_stay(const std::vector<Vector3>& images) const;
  void forget_lost_contacts(const ParticleView& particles);
  std::vector<nurbs::SurfacePoint> feet_in_memory(const ParticleView& particles);
  int take_steady(const ParticleView& particles, const StepInfo& step, int begin, int end,
                  FeetTracker::Query* queries);
  SteadyFeet* find_steady(const ParticleView& particles, const StepInfo& step, int begin, int end,
                          const Contact* next);
  void begin_query(const ParticleView& particles, const StepInfo& step, int candidate,
                   FeetTracker::Query& query) const;
  double squared_travel(const ParticleView& particles, int particle) const;
  void prefetch_rows(const ParticleView& particles, int begin, int end) const;
  double touch_reach(const ParticleView& particles, const StepInfo& step, int particle) const;
  bool settle(const ParticleView& particles, SteadyFeet& steady, int k, int i);
  static bool find_slots(const ParticleSlots& slots, SteadyFeet& steady, int k);
  void go_on(const ParticleView& particles, const StepInfo& step, int i, const SteadyFeet::Foot& foot,
             Contact& contact);
  Contact* go_on_with_others(const ParticleView& particles, const StepInfo& step, int i,
                             const SteadyFeet& steady, int k, Contact* next);
  void complete(const ParticleView& particles, const StepInfo& step, const SteadyFeet::Foot& foot,
                Contact& contact);
  void find_contacts(const ParticleView& particles, const StepInfo& step, const FeetTracker::Query& query);
  bool may_cross(const ParticleView& particles, const StepInfo& step, int particle, double distance) const;
  void check_crossing(const ParticleView& particles, const StepInfo& step, int particle, double distance,
                      const Vector3& delta, const Vector3& v_wall);
  ParticleSlots slots_of(const ParticleView& particles, int particle) {
    return particles.memory.of(particle, used_slots_[particle]);
  }
  int take_slot(const ParticleView& particles, const StepInfo& step, int particle, const TrackedFoot& tracked,
                const ParticleSlots& slots, const Vector3& delta) const;
  static void begin_contact(const ParticleView& particles, int particle, int slot, double distance,
                            Contact& contact);
  void push_body(const ParticleView& particles, const StepInfo& step, const ContactModel& model,
                 const Contact& contact);
  void turn_body(const Contact& contact, coupling::ContactForce& on_body) const;
  void answer(const ParticleView& particles, const StepInfo& step, ContactModel& model,
              ContactObserver* observer, std::size_t first);
  void evaluate_corrected(const ParticleView& particles, const ComplianceCorrection::Time& now,
                          ContactModel& model, Contact* begin, Contact* end);
  void look_at(const ParticleView& particles, const StepInfo& step, const ContactModel& model,
               ContactObserver* observer, std::size_t first);
  [[noreturn]] static void fail_as_turning(const ParticleView& particles, const StepInfo& step,
                                           const Contact& contact, double turning);
  void look_at_mesh(const ParticleView& particles, const StepInfo& step, double hertz_constant,
                    Contact& contact);
  void expect_stable(const ParticleView& particles, const StepInfo& step, double hertz_damping,
                     const Contact& contact);
  /// `squared_frequency` of the particle on the spring of the contact; `speed` along the normal.
  void expect_long(const ParticleView& particles, const StepInfo& step, const Contact& contact,
                   double squared_frequency, double speed);
  static void expect_finite(const ParticleView& particles, const StepInfo& step, const Contact* contacts,
                            const Contact* end);

  Options options_;
  Wall wall_;
  RepeatedElements repeated_;
  CandidateList candidates_;
  SearchCounts searches_;
  std::unique_ptr<FeetTracker> tracker_;
  std::unique_ptr<ComplianceCorrection> correction_;  // null: none asked for
  std::unique_ptr<MeshEstimate> mesh_;                // null: no solid whose mesh is known
  FeetKernel kernel_;
  bool list_is_new_ = true;           // no step since it was built
  double surface_motion_ = 0.0;       // of a deforming wall since the list was built
  double wall_travel_ = 0.0;          // in a step, when the list was built [length]
  std::vector<double> list_reach_;    // per particle, when the list was built
  std::vector<double> radius_limit_;  // likewise: what the list is good for
  std::vector<bool> is_candidate_;
  std::vector<int> used_slots_;  // per particle (ParticleSlots)

  std::vector<Contact> contacts_;
  std::vector<ContactCorrection> corrections_;  // of the last of them, while they are answered
  mutable ContactRows rows_;
  std::vector<coupling::ContactForce> forces_on_body_;
  RunAlarm inside_, crossing_, stiff_, brief_;
  MeshAlarm uncorrected_, turning_, kinked_, not_static_;
  double body_squared_frequency_ = 0.0;            // in this step [1/time^2]
  double squared_time_ = 0.0, squared_way_ = 0.0;  // in this step: see squared_travel()
  bool is_plain_ = false;                          // in this step: steady contacts are soon complete
};

}  // namespace contact
