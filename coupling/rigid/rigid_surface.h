// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid surface behind the port: at rest, moved in a prescribed way, pushed by a servo, or sliding within
// itself.  Its positions are those of its body frame and never change.
#pragma once

#include <optional>
#include <vector>

#include "coupling/rigid/rigid_motion.h"
#include "coupling/rigid/servo.h"
#include "coupling/rigid/sliding_surface.h"
#include "coupling/structure_solver.h"

namespace coupling {

/// What moves a rigid wall.  At most one of the three is given.
struct RigidDrive {
  std::vector<Motion> motions;  ///< in the order in which they act
  std::optional<ServoSettings> servo;
  std::optional<SlidingSurface> sliding;
};

class RigidSurface final : public StructureSolver {
 public:
  /// Patches whose edges coincide are welded.  `outward_sign` as in ContactSurface; empty: two-sided.
  /// `faced`: the same patches as faces, if feet are searched on these.
  explicit RigidSurface(const std::vector<nurbs::Surface>& patches, std::vector<int> outward_sign = {},
                        std::shared_ptr<const brep::FacedPatches> faced = nullptr);
  /// Of faces, edges and vertices, each with the side that is outside (brep::Face::outward).
  explicit RigidSurface(std::shared_ptr<const brep::Surface> faces);
  /// Before the first step.  Throws std::invalid_argument if a servo cannot turn the wall.
  void drive(RigidDrive drive);
  /// Between runs: other motions (or none) from where the wall is now, with a clock of their own.
  void set_motions(std::vector<Motion> motions);
  Servo* servo() { return servo_ ? &*servo_ : nullptr; }

  const ContactSurface& surface() const override { return surface_; }
  const std::vector<NodeId>& nodes() const override { return nodes_; }
  const NodalVectors& positions() const override { return positions_; }
  const NodalVectors& velocities() const override { return velocities_; }
  RigidFrame frame() const override { return body_.frame(); }
  bool slides() const override { return sliding_.has_value(); }
  Vector3 surface_velocity(const Vector3& x, const Vector3& normal) const override;

  void begin_run() override;
  void initialise_forces(const NodalForces&) override {}
  void begin_step() override;
  void end_step(const NodalForces& forces) override;
  void set_time_step(double dt) override { dt_ = dt; }
  double stable_time_step() const override;

  bool moves() const override;
  bool deforms() const override { return false; }
  bool needs_forces() const override { return servo_.has_value(); }
  double kinetic_energy() const override { return 0.0; }
  double strain_energy() const override { return 0.0; }
  Vector3 linear_momentum() const override { return Vector3::Zero(); }
  Vector3 angular_momentum(const Vector3&) const override { return Vector3::Zero(); }
  std::vector<SurfaceMaterial> materials() const override { return {}; }
  /// Of a wall with a servo: how far its `com` has moved.
  std::vector<Probe> probes() const override;

  /// Pose, clock and controller; nothing for a wall that has never moved.  A wall that is moved in another
  /// way than the saved one starts its motion anew, from the saved pose.
  std::vector<double> save() const override;
  void load(const std::vector<double>& state) override;
  Fingerprint fingerprint() const override;

 private:
  RigidSurface(nurbs::PatchedSurface surface, std::vector<int> outward_sign);
  double lever(const Vector3& centre, const Vector3& axis) const;

  ContactSurface surface_;
  std::vector<NodeId> nodes_;  // the control points
  NodalVectors positions_, velocities_;
  MovingFrame body_;
  RigidMotion motion_;
  std::optional<Servo> servo_;
  std::optional<SlidingSurface> sliding_;
  double dt_ = 0.0;
};

}  // namespace coupling
