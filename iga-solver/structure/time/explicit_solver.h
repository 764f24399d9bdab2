// SPDX-License-Identifier: GPL-2.0-or-later
// A solid in time: central differences as velocity Verlet (Newmark with beta = 0, gamma = 1/2), with the mass
// that the body asks for (mass.h).
//   begin_step  v(n+1/2) = v(n) + dt/2 a(n),  u(n+1) = u(n) + dt v(n+1/2)
//   end_step    a(n+1) = M^-1 (F(n+1) + f_ext - f_int(u(n+1))),  v(n+1) = v(n+1/2) + dt/2 a(n+1)
// Between the two calls somebody else may work out forces F at the new positions (contact); all of the step's
// results then belong to one time level.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "structure/body.h"
#include "structure/conditions/changing_load.h"
#include "structure/conditions/named_support.h"
#include "structure/conditions/probe.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"
#include "structure/halo.h"
#include "structure/time/divergence.h"
#include "structure/time/element_watch.h"
#include "structure/time/mass.h"
#include "structure/time/momentum_damping.h"
#include "structure/time/stretch_watch.h"
#include "structure/time/support_motion.h"
#include "structure/time/verlet_update.h"
#include "structure/time/work_ledger.h"

namespace structure {

/// All nodal arrays are 3 x node_count.  Fixed dofs have u = v = a = 0 and take any force; moved ones go
/// where they are told (support_motion.h).
class ExplicitSolver {
 public:
  /// At rest, undeformed.  Of a body that is cut, each part has a solver, and what is
  /// asked of all nodes (energies, momenta, work, stable step) is collective, as the steps are.
  ExplicitSolver(std::unique_ptr<Body> body, Supports supports,
                 std::unique_ptr<const Halo> halo = std::make_unique<const Halo>());

  /// Constant external nodal forces f_ext [force], whole at the nodes that the part owns; throws
  /// std::invalid_argument if the size does not fit.
  void set_load(const NodalVectors& f_ext);
  const NodalVectors& load() const { return loads_.empty() ? f_ext_ : f_dead_; }
  /// One more that changes with time or with the motion, from the next forces on; `name` is for messages.
  void add_load(std::unique_ptr<const ChangingLoad> load, std::string name = {});
  /// Springs to the ground: stiffness and strain energy count as the body's.  Before the stable step is asked
  /// for.
  void set_springs(Springs springs) { springs_ = std::move(springs); }
  /// Forces - rate M v [1/time] from the next forces on.
  void set_mass_damping(double rate);
  /// From the next forces on loads and supports are those of the time t, whenever it is.
  void hold_conditions_at(double t) { held_at_ = t; }
  /// Current velocities [length/time], set to 0 at fixed dofs that do not move; throws as above.
  void set_velocities(const NodalVectors& v);
  /// dt [time]; throws std::invalid_argument unless it is positive and finite.
  void set_time_step(double dt);
  /// Displacements and velocities that somebody else has worked out, of all columns, and their time: for what
  /// is then asked of the nodes.
  void set_motion(const NodalVectors& u, const NodalVectors& v, double time);
  /// The material remembers what it does at rest where displacements are now: no rate, whatever it was
  /// strained by before.
  void settle();

  /// Accelerations for the current state under further nodal forces F [force], whole at the nodes that the
  /// part owns; advances nothing.  Call before
  /// the first step and whenever state or loads were set.  Throws Diverged as end_step does.
  void initialise_forces(const NodalVectors& F);
  /// Half kick and drift; throws std::logic_error before set_time_step.
  void begin_step();
  /// Accelerations under further nodal forces F [force] and half kick.  Throws Diverged when the solid blows
  /// up: values that are not finite, displacements beyond kLargestDisplacement, or more kinetic energy than
  /// the EnergyBudget allows; a step later the state would mean nothing.  Also if an element is seen folded
  /// (element_watch.h).  Also if the body is strained so much that the stable step has come down to dt:
  /// TooStrained, unless somebody is to shorten it.
  void end_step(const NodalVectors& F);

  // For time steps that are made of several (coupling/substeps.h).
  /// Between begin_step and end_step: adds displacements [length] and velocities dv [length/time] that
  /// somebody's forces have given to the nodes meanwhile, 0 at fixed dofs, whose supports carry the impulses
  /// there.  `impulses` [mass length/time]: of these forces, on fixed dofs, too; dv = M^-1 impulses.  Their
  /// work is that of velocities v(n+1/2) + dv/2.  The displacements must live until end_step.
  void add_motion(const NodalVectors& displacements, const NodalVectors& velocities,
                  const NodalVectors& impulses);
  /// Until the next step or other forces, reactions have the mean of what supports carry of such impulses in
  /// `duration` [time].  Collective.
  void press_on_supports(const NodalVectors& impulses, double duration);
  /// Between begin_step and end_step, or after change_forces: what end_step is given are `kicks` of `forces`
  /// that act all the time; of those on fixed dofs reactions have the latter, until the next step or other
  /// forces.
  void press_evenly(const NodalVectors& forces, const NodalVectors& kicks);
  /// Internal forces are those of the displacements u + lead v from now on: a mode of frequency omega is
  /// damped by the ratio omega lead/2.  Collective.
  void set_lead(double lead);
  /// With a lead: a body that nothing holds turns as it does now, and v is without that, which no strain
  /// comes of; it would brake the spin by the rate lead spin^2.  Collective.
  void follow_spin();
  /// From now on steps go on where the stable step has come down to dt; somebody sees that and sets another.
  void go_on_when_strained() { goes_on_when_strained_ = true; }
  bool is_too_strained() const { return is_too_strained_; }
  /// Between steps: other forces F [force] than those of the last one, as if it had ended with them.
  void change_forces(const NodalVectors& F);
  const Halo& halo() const { return *halo_; }

  const Springs& springs() const { return springs_; }
  bool has_changing_loads() const { return !loads_.empty(); }
  /// Of the body and its springs [force] at displacements u of all columns, whole at own nodes; 3 x n.
  /// Collective.
  void internal_forces(const NodalVectors& u, NodalVectors& f) const;
  /// All loads [force] at displacements u and the time t, 3 x n.  Collective.
  void external_forces(const NodalVectors& u, double t, NodalVectors& f) const;
  /// Throws Diverged if a load on the undeformed body or the motion of a support is not finite then.
  /// Collective.
  void expect_finite_conditions(double t) const;
  const Body& body() const { return *body_; }
  const Supports& supports() const { return supports_; }
  const MassOperator& mass() const { return *mass_; }
  double time() const { return time_; }
  double time_step() const { return dt_; }
  const NodalVectors& displacements() const { return u_; }  ///< [length]
  const NodalVectors& positions() const { return x_; }      ///< of the control points [length]
  const NodalVectors& velocities() const { return v_; }     ///< [length/time]; v(n+1/2) within a step
  const NodalVectors& accelerations() const { return a_; }  ///< [length/time^2]

  /// 2 / omega_max of the undeformed body, which takes seconds for large models; then remembered.  If the
  /// material has a memory, about the state of the first call.
  double stable_time_step() const;
  /// About the present state, if that makes a difference to the law; collective.
  double renew_stable_time_step();
  /// The same about the last state for which it was worked out anew: if it is known, steps watch how the body
  /// is strained, and do so where it may have come down to the time step.
  double stable_time_step_now() const { return stable_now_.value_or(stable_time_step()); }

  double largest_displacement() const;  ///< of all nodes [length]
  double kinetic_energy() const;        ///< p . v / 2 of momenta p = M v
  double strain_energy() const;
  /// Since initialise_forces: kinetic energy + internal + damped - loads - forces - supports is constant
  /// to round-off.
  Work work() const;
  double load_work() const;  ///< f_ext . u: kinetic + strain energy - load work is conserved without further
                             ///< forces; of loads that change what the ledger has
  Vector3 linear_momentum() const;                       ///< sum m_A v_A
  Vector3 angular_momentum(const Vector3& about) const;  ///< sum (x_A - about) x p_A

  /// By how much the work against internal forces exceeds the change of strain energy since then:
  /// the error of the time step, of order dt^2, and what a material has dissipated otherwise than by
  /// viscosity. `strain`: strain_energy().
  double truncation(double strain) const;

  /// From the next forces on reactions are known.
  void keep_reactions() { keeps_reactions_ = true; }
  /// Force of a support on the body [force], at the time of the last forces: what its degrees of freedom need
  /// to stay where they are, f_int - f_ext - F, or to move, m a more.  Collective.
  Vector3 reaction(const NamedSupport& support) const;

  /// That a law of small strain has been turned too far, in one line, once; empty else.  The same on all
  /// parts.
  std::string take_warning() { return std::exchange(warning_, {}); }
  /// For those who take no steps: looks at all elements for that, and for folds.  Throws Diverged.
  /// Collective.
  void look_at_elements();

  /// Displacement of a point whose nodes are those of the whole body.  Collective.
  Vector3 displacement(const Probe& probe) const;

  /// Ids of the nodes that the part holds, one per column of nodal arrays: those that it owns, rising, then
  /// others; -1 for columns of no node.
  const std::vector<Id>& node_ids() const { return node_ids_; }
  /// Degrees of freedom of the whole body that are held, and those of them that supports move: 3 node +
  /// direction, rising.  Collective.
  std::vector<Id> fixed_dofs() const;
  std::vector<Id> moved_dofs() const;

  /// The whole body's time, displacements, velocities and accelerations in the order of node ids, what the
  /// material remembers in the order of element ids, and momenta_in_order(), to continue in parts cut in any
  /// way, to the last bit if cut in the same.  Collective.
  std::vector<double> save() const;
  /// Takes what is of the part; momenta only if they are kept, and there may be none.  Throws
  /// std::invalid_argument if the size does not fit.  Collective.
  void load(const std::vector<double>& state);
  std::size_t state_size() const;         ///< what save() gives, collective
  bool can_load(std::size_t size) const;  ///< a state of so many numbers, collective
  /// The work since initialise_forces as numbers, without round-off, and back, after initialise_forces: so a
  /// later run goes on with it.  Both collective; load_work_done throws as load().
  std::vector<double> save_work_done() const;
  void load_work_done(const std::vector<double>& numbers);
  std::size_t all_nodes() const;  ///< of all parts, collective
  /// Undeformed positions of nodes of the whole body [length], wherever they are held: 3 x nodes. Collective.
  NodalVectors reference_of(const std::vector<Id>& nodes) const;
  /// Nodal values of the whole body in the order of node ids, collective; and back to the part's.
  std::vector<double> in_order(const NodalVectors& values) const;
  void from_order(const double* rows, NodalVectors& values) const;
  /// Of the whole body, where damping has momenta carried from step to step; else none.  Collective.
  std::vector<double> momenta_in_order() const;
  std::size_t memory_size() const;  ///< of the next, collective
  /// What the material of the whole body remembers, in the order of element ids, collective.
  std::vector<double> memory_in_order() const {
    return halo_->in_order(element_ids(), body_->memory().data(), body_->memory().size());
  }

 private:
  void check_size(const NodalVectors& values, const char* what) const;
  std::vector<Id> of_whole_body(const std::vector<Eigen::Index>& dofs) const;
  /// Whether some part had a velocity where it is fixed.
  bool hold_supports();
  /// What supports that move carry of impulses, times their velocities: in some columns.
  double power_of_carried(Eigen::Index first, Eigen::Index count) const;
  /// What add_motion's displacements have added to the strain energy, at most, if that is convex.
  void add_strain_energy();
  /// The displacements whose internal forces count.
  const NodalVectors& led_displacements();
  /// f_ext_ now.
  void find_loads();
  /// From f_int_, whole at own nodes: accelerations under F too, and a kick of `h` by them.
  void accelerate(const NodalVectors& F, double h);
  ForceSums kick_run(const NodalForces& forces, double h, Eigen::Index first, Eigen::Index count);
  void find_reactions(const NodalVectors& F);
  /// Of loads and supports when the solid's is t.
  double conditions_time(double t) const { return held_at_.value_or(t); }
  /// Sum of m_A |q_A|^2 over all nodes.
  double nodal_sum(const NodalVectors& q) const;
  /// Over the nodes of all parts.
  Vector3 sum_of_own(const std::function<Vector3(Eigen::Index node)>& value) const;
  void start_energy_budget();
  /// Which load on the undeformed body is not finite at the time t, in a line; empty if all are.
  std::string load_not_finite(double t) const;
  double dissipated_energy() const;
  void check_divergence(const NodalVectors& F);
  /// Throws Diverged if an element is folded; a warning if one is turned too far.
  void tell_of_elements();
  /// Throws TooStrained if the time step is above the stable one, unless it is to go on.
  void look_at_strain();
  double find_stable_step(const NodalVectors& u) const;
  std::vector<Id> element_ids() const;

  std::unique_ptr<Body> body_;
  Supports supports_;
  std::unique_ptr<const Halo> halo_;
  std::vector<Id> node_ids_;
  std::unique_ptr<MassOperator> mass_;
  SupportMotion motion_;
  double dt_ = 0.0, time_ = 0.0;
  std::optional<double> held_at_;  // the time of loads and supports, if it does not go on
  double lead_ = 0.0;
  bool turns_freely_ = false;  // nothing holds it, and there is a lead
  Vector3 led_spin_ = Vector3::Zero();
  double damping_ = 0.0;                             // rate
  std::unique_ptr<MomentumDamping> momenta_damped_;  // by it, if the mass is not diagonal
  NodalVectors f_ext_, f_int_, u_, x_, v_, a_;
  NodalVectors f_dead_;  // what does not change of f_ext, if something does
  std::vector<std::unique_ptr<const ChangingLoad>> loads_;
  std::vector<std::string> load_names_;
  Springs springs_;
  NodalVectors of_supports_;     // accelerations of those that move, if the mass is not diagonal
  NodalVectors led_u_;           // u + lead (v - spin x), where there is a lead
  double largest_u_ = 0.0;       // of all components that the part holds
  std::vector<ForceSums> sums_;  // of the last kick, for each run of nodes that the part owns
  WorkLedger ledger_;
  ExactSum added_energy_;                              // by add_motion in this step
  const NodalVectors* added_displacements_ = nullptr;  // likewise
  bool keeps_reactions_ = false;
  std::vector<double> reactions_;       // of the supports' fixed dofs
  std::vector<double> carried_;         // beside them, of impulses
  NodalVectors gain_;                   // of velocities by these, where the mass is not diagonal
  std::optional<double> strain_start_;  // strain energy when the ledger began
  double dissipated_start_ = 0.0;       // likewise
  double kinetic_start_ = 0.0;          // what the ledger's work goes on from
  double power_ = 0.0;                  // of f_ext, F and supports [energy/time]
  std::optional<EnergyBudget> budget_;  // since state or loads were set
  mutable std::optional<double> stable_time_step_;
  std::optional<StretchWatch> watch_;  // if the stable step is known
  std::optional<double> stable_now_;   // when it was found last
  ElementWatch elements_;
  bool has_warned_ = false;
  std::string warning_;
  bool goes_on_when_strained_ = false, is_too_strained_ = false;
};

}  // namespace structure
