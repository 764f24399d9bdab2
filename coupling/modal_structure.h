// SPDX-License-Identifier: GPL-2.0-or-later
// A solid that keeps its lowest modes alone, behind the port: its stiff waves no longer dictate the time
// step. It goes on exactly between contacts (structure/time/modal_motion.h).  Its nodes are placed where
// particles may see them; all others only when somebody asks, in the solver that it was made from. The modes
// left out have no flexibility here, either: what they would add to a contact is the dent around it, most of
// which the contact law already holds (Hertz' half-space); a mesh counts it twice.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupling/iga_structure.h"
#include "structure/analysis/modal_basis.h"
#include "structure/time/modal_motion.h"
#include "structure/time/modal_rows.h"

namespace coupling {

/// Beside the damping of its solver's model.
struct ModalDamping {
  std::vector<double> ratio = {};  ///< of critical damping, of the first modes; the last of all others
  double mass = 0.0;               ///< rate [1/time]
  double stiffness = 0.0;          ///< [time]
};

class ModalStructure final : public StructureSolver {
 public:
  /// From where the body's solver stands, with what the modes have of it.  The basis is of its own part.
  /// Collective.
  ModalStructure(std::unique_ptr<IgaStructure> body, const structure::ModalBasis& basis,
                 const ModalDamping& damping);

  const ContactSurface& surface() const override { return body_->surface(); }
  const std::vector<NodeId>& nodes() const override { return body_->nodes(); }
  bool is_in_parts() const override { return body_->is_in_parts(); }
  Eigen::Index owned_node_count() const override { return body_->owned_node_count(); }
  /// Of nodes that the surface does not hang on they are those of an earlier time.
  const NodalVectors& positions() const override { return x_; }
  const NodalVectors& velocities() const override { return v_; }

  void begin_run() override { place_surface(motion_.rates()); }
  void initialise_forces(const NodalForces& forces) override;
  void begin_step() override;
  void end_step(const NodalForces& forces) override;

  void set_time_step(double dt) override;
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double shortest_contact() const override;
  std::string describe_step() const override;
  /// All elements are looked at once in so many steps.
  std::string take_warning() override { return solver_.take_warning(); }

  bool moves() const override { return true; }
  /// Of each node alone.
  NodalVectors inverse_node_mass() const override { return rows_.squares(motion_.mode_count()); }
  double kinetic_energy() const override { return motion_.kinetic_energy(); }
  double strain_energy() const override { return motion_.strain_energy(); }
  Work work() const override;
  Vector3 linear_momentum() const override { return momentum_ * motion_.rates(); }
  Vector3 angular_momentum(const Vector3& about) const override;
  std::vector<SurfaceMaterial> materials() const override { return body_->materials(); }
  bool takes_gravity_of_deck() const override { return body_->takes_gravity_of_deck(); }
  void set_gravity(const Vector3& g) override { body_->set_gravity(g); }
  std::optional<Vector3> gravity() const override { return body_->gravity(); }
  std::vector<Probe> probes() const override;
  std::vector<Reaction> reactions() const override;

  /// The body's own, then the modes', and by what these are told from the same modes found elsewhere, which
  /// may have other signs, or be others of one frequency: then the nodes count.
  std::vector<double> save() const override;
  void load(const std::vector<double>& state) override;
  std::size_t state_size() const override;
  Fingerprint fingerprint() const override;

 private:
  using Row3 = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // a vector of each shape
  /// What a support feels, per shape: K shape of the body and of springs; and of a psi M psi, too.
  struct SupportForces {
    Row3 body, springs, inertia;
  };
  structure::ModalSystem system_of(const structure::ModalBasis& basis, const ModalDamping& damping) const;
  /// Forces of the springs to the ground at displacements u, 3 x n.
  NodalVectors of_springs(const NodalVectors& u) const;
  void measure_shapes(const structure::ModalBasis& basis);
  /// What the modes have of the solver's displacements and velocities.
  void take_state();
  void expect_supports_in_place(NodalVectors displacements) const;
  /// ds/dt [1/time] of the supports' motions, of the solver's velocities where they act.  Collective.
  Eigen::VectorXd support_rates() const;
  structure::ModalForces loads_at(double time) const;
  void place_surface(const Eigen::VectorXd& rates);
  /// Everywhere, in the solver.
  void place_all() const;
  /// Sum of nodal forces f where it holds.
  Vector3 force_at(const structure::NamedSupport& support, const NodalVectors& f) const;
  Vector3 spring_force(const structure::NamedSupport& support, const NodalVectors& u) const;
  void take_forces(const NodalForces& forces);
  void write_output();

  std::unique_ptr<IgaStructure> body_;
  structure::ExplicitSolver& solver_;
  structure::ModalRows rows_;                // modes, then psi
  std::vector<Eigen::Index> surface_nodes_;  // columns of nodal arrays
  double viscosity_, lowest_, highest_;      // damping by stiffness [time]; frequencies [1/time]
  structure::ModalMotion motion_;
  Row3 momentum_;                        // sum m_A shape_A
  std::vector<Row3> probes_;             // shape there
  std::vector<SupportForces> supports_;  // that have names
  Eigen::VectorXd signature_;            // of the shapes
  structure::ModalForces dead_loads_;
  NodalForces F_;
  NodalVectors x_, v_;
  int steps_since_look_ = 0;  // at elements
};

}  // namespace coupling
