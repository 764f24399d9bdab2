// SPDX-License-Identifier: GPL-2.0-or-later
// The port to a structure solver: all that contact needs to know of a deforming (or rigid) body.
// One step is velocity Verlet, which is the central difference scheme; particles and surface share one time
// level:
//   begin_step  v(n+1/2) = v(n) + dt/2 a(n),  x(n+1) = x(n) + dt v(n+1/2)
//   [contact forces F(n+1) from x(n+1), v(n+1/2)]
//   end_step    a(n+1) = M^-1 (F(n+1) + f_ext - f_int(x(n+1))),  v(n+1) = v(n+1/2) + dt/2 a(n+1)
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/fingerprint.h"
#include "coupling/local_compliance.h"
#include "coupling/nodal_forces.h"
#include "coupling/rigid_frame.h"

namespace coupling {

/// Elastic constants of the material below a surface, or some of its patches, to be compared with the deck's.
struct SurfaceMaterial {
  double youngs_modulus;  ///< [Pa]
  double poissons_ratio;  ///< [-]

  bool operator==(const SurfaceMaterial& other) const {
    return youngs_modulus == other.youngs_modulus && poissons_ratio == other.poissons_ratio;
  }
};

/// Isotropic solid below a surface whose elements are those of the solid's mesh.
struct MeshedSolid {
  double plane_modulus;  ///< E' = E / (1 - nu^2) [pressure]
  double shear_speed;    ///< of waves [length/time]
  double density;        ///< [mass/length^3]
  double mass;           ///< of the whole body
};

/// A displacement history that the model file asks for.
struct Probe {
  std::string name;
  Vector3 displacement;  ///< [length]
};

/// Of a support that the model file names.
struct Reaction {
  std::string name;
  Vector3 force;  ///< on the body [force]
};

/// Work since initialise_forces by the rule of the time step [energy]: a half kick by a force F
/// that takes v to v' does dt/2 F . (v + v')/2, so kinetic energy + internal + damped - loads - contacts -
/// supports is constant to round-off.
struct Work {
  double contacts = 0.0;  ///< of the contact forces on the body
  double loads = 0.0;     ///< of its own loads
  double internal = 0.0;  ///< done against internal forces
  double supports = 0.0;  ///< of supports that move
  double damped = 0.0;    ///< taken by damping
};

/// What only this rank knows of: the others may be waiting for it already, and the run is to be ended on all.
struct FailedOnThisRank : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SubstepOptions;

class StructureSolver {
 public:
  virtual ~StructureSolver() = default;

  virtual const ContactSurface& surface() const = 0;
  /// Ids of the nodes that this rank holds, one for each column of nodal arrays: those that it owns, rising,
  /// then others; -1 for columns that are no node.
  virtual const std::vector<NodeId>& nodes() const = 0;
  /// Whether each node is owned by one rank; if not, every rank holds and moves them all alike.
  virtual bool is_in_parts() const { return false; }
  /// How many of nodes() this rank owns: forces on the others are not asked for.
  virtual Eigen::Index owned_node_count() const { return static_cast<Eigen::Index>(nodes().size()); }
  /// In the body frame: current positions [length] and velocities relative to it [length/time].  During a
  /// step (after begin_step) the velocities are those of the half step.
  virtual const NodalVectors& positions() const = 0;
  virtual const NodalVectors& velocities() const = 0;
  /// Where the body frame is; the identity for a solver whose positions are in space.
  virtual RigidFrame frame() const { return {}; }
  /// Whether the surface slides within itself (a conveyor belt), and what this adds to the velocity of the
  /// wall at x in space [length/time]; `normal` is the unit normal there, of either sign.
  virtual bool slides() const { return false; }
  virtual Vector3 surface_velocity(const Vector3& /*x*/, const Vector3& /*normal*/) const {
    return Vector3::Zero();
  }

  /// Before the first forces of each run: evaluates what the deck may have changed, advances nothing.
  virtual void begin_run() {}

  /// Accelerations for the current state under the given nodal contact forces (in the body frame) [force];
  /// advances nothing.
  virtual void initialise_forces(const NodalForces& forces) = 0;
  virtual void begin_step() = 0;
  virtual void end_step(const NodalForces& forces) = 0;

  /// dt [time]; throws std::invalid_argument unless it is positive and below the stable step.
  virtual void set_time_step(double dt) = 0;
  /// Whether it takes the steps that a deck asks for by itself, from the next set_time_step on; throws
  /// std::invalid_argument if these are not for it.
  virtual bool take_substeps(const SubstepOptions& /*options*/) { return false; }
  /// Largest stable dt [time]; infinity for a body that is not integrated.
  virtual double stable_time_step() const = 0;
  /// The same [time], as far as known now, of what happens in a step together with contacts; infinity for a
  /// body that has steps of its own.
  virtual double stable_time_step_with_contacts() const { return std::numeric_limits<double>::infinity(); }
  /// Contacts that last less than that [time] are felt otherwise than by the whole body.
  virtual double shortest_contact() const { return 0.0; }
  /// What is below a patch of the surface; nothing if contacts do not feel a mesh, or one that is not known.
  virtual std::optional<MeshedSolid> solid_below(int /*patch*/) const { return std::nullopt; }
  /// What its mesh gives way under contacts beyond what it does itself; null unless contact shall take that
  /// off.
  virtual LocalCompliance* local_compliance() const { return nullptr; }
  /// For the log, after set_time_step: how it takes the step, if not as one.
  virtual std::string describe_step() const { return ""; }
  /// For the log: how it takes steps from now on, if the last one has changed that; asked for once.
  virtual std::string take_change() { return ""; }
  /// For the user: what is doubtful about the last step, in one line; each asked for once.
  virtual std::string take_warning() { return ""; }

  virtual bool moves() const = 0;  ///< whether begin_step and end_step do anything
  /// Whether positions() change; if not, what moves is the frame.
  virtual bool deforms() const { return moves(); }
  /// Whether initialise_forces and end_step use the forces; if not, they may be called with forces of zero.
  virtual bool needs_forces() const { return moves(); }
  /// 1 / mass of each degree of freedom of the nodes held [1/mass], 3 x nodes, 0 where it is fixed: for nodes
  /// that are control points of the surface.  Where the mass is no diagonal matrix, what 1 / mass never
  /// exceeds.  Empty if nothing is known, or nothing is integrated.
  virtual NodalVectors inverse_node_mass() const { return {}; }
  virtual double kinetic_energy() const = 0;  ///< p . v / 2 of momenta p = M v [energy]
  virtual double strain_energy() const = 0;   ///< [energy]; may cost as much as a step
  virtual Work work() const { return {}; }    ///< zero for a body that is not integrated
  /// Internal work - the change of strain energy: the error of the time step, and what is dissipated
  /// by a memory of another kind than damping [energy].
  virtual double truncation() const { return 0.0; }
  virtual Vector3 linear_momentum() const = 0;                       ///< sum m_A v_A
  virtual Vector3 angular_momentum(const Vector3& about) const = 0;  ///< sum (x_A - about) x p_A
  /// Those of the surface that differ; none if they are not known.
  virtual std::vector<SurfaceMaterial> materials() const = 0;
  /// Whether its gravity shall be the deck's, which is then set before each run.
  virtual bool takes_gravity_of_deck() const { return false; }
  virtual void set_gravity(const Vector3& /*g*/) {}
  /// Gravity among its own loads [length/time^2]; nothing if they have none.
  virtual std::optional<Vector3> gravity() const { return std::nullopt; }
  virtual std::vector<Probe> probes() const = 0;
  /// At the time of the last forces; always the same supports.
  virtual std::vector<Reaction> reactions() const { return {}; }

  /// The state as numbers, for restart files: of the whole structure, in the order of ids, whatever the ranks
  /// hold, so that other ranks may load it; complete on every rank.  load takes what is of this rank, and
  /// throws std::invalid_argument if the size does not fit.  Both are collective, as energies and momenta
  /// are.
  virtual std::vector<double> save() const = 0;
  virtual void load(const std::vector<double>& state) = 0;
  /// How many numbers save() gives; collective.
  virtual std::size_t state_size() const { return save().size(); }
  /// What these numbers belong to: all that must be the same in the solver that loads them.  Collective.
  virtual Fingerprint fingerprint() const = 0;
};

}  // namespace coupling
