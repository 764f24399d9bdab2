// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid/rigid_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "brep/facets.h"
#include "coupling/force_distribution.h"
#include "nurbs/assert.h"

namespace coupling {

RigidSurface::RigidSurface(const std::vector<nurbs::Surface>& patches, std::vector<int> outward_sign,
                           std::shared_ptr<const brep::FacedPatches> faced)
    : RigidSurface(nurbs::join(patches), std::move(outward_sign)) {
  surface_.faced = std::move(faced);
}

RigidSurface::RigidSurface(nurbs::PatchedSurface surface, std::vector<int> outward_sign)
    : surface_{std::move(surface.topology), SurfaceMap::identity(surface.control_points.cols()),
               std::move(outward_sign)},
      positions_(std::move(surface.control_points)),
      velocities_(NodalVectors::Zero(3, positions_.cols())) {
  surface_.outward_sign.resize(surface_.topology.patch_count(), 0);
  nodes_.resize(positions_.cols());
  std::iota(nodes_.begin(), nodes_.end(), NodeId(0));
}

RigidSurface::RigidSurface(std::shared_ptr<const brep::Surface> faces)
    : surface_{{}, SurfaceMap::identity(4), {}, std::move(faces)},
      nodes_{0, 1, 2, 3},
      positions_(BoxBasis::nodes(*surface_.faces)),
      velocities_(NodalVectors::Zero(3, 4)) {}

// Largest distance from the axis of a control point or vertex [length].
double RigidSurface::lever(const Vector3& centre, const Vector3& axis) const {
  double largest = 0.0;
  const auto look_at = [&](const Vector3& x) { largest = std::max(largest, axis.cross(x - centre).norm()); };
  if (surface_.faces) {
    const NodalVectors points =
        brep::triangles_of(*surface_.faces, brep::kFacetChord * surface_.faces->size).vertices;
    for (const auto x : points.colwise()) look_at(x);
  } else
    for (const auto x : positions_.colwise()) look_at(x);
  return largest;
}

void RigidSurface::drive(RigidDrive drive) {
  motion_ = RigidMotion(std::move(drive.motions));
  sliding_ = std::move(drive.sliding);
  if (!drive.servo) return;
  const double reach = lever(drive.servo->com, drive.servo->axis);
  if (drive.servo->controls == ServoSettings::Controls::torque && reach == 0.0)
    throw std::invalid_argument("the servo cannot turn the wall: all of it lies on the axis");
  servo_.emplace(std::move(*drive.servo), reach);
}

void RigidSurface::set_motions(std::vector<Motion> motions) {
  if (servo_ || sliding_)
    throw std::invalid_argument("the wall has a servo or slides, expected one that may take a motion");
  motion_ = RigidMotion(std::move(motions));
  body_.stop();
}

bool RigidSurface::moves() const { return !motion_.empty() || servo_ || (sliding_ && sliding_->varies()); }

double RigidSurface::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

Vector3 RigidSurface::surface_velocity(const Vector3& x, const Vector3& normal) const {
  return sliding_ ? sliding_->velocity(x, normal) : Vector3::Zero();
}

void RigidSurface::begin_run() {
  if (servo_) servo_->begin_run(dt_);
  if (sliding_) sliding_->update();
}

void RigidSurface::begin_step() {
  if (!motion_.empty()) motion_.advance(body_, dt_);
  if (servo_) servo_->advance(body_, dt_);
  if (sliding_) sliding_->update();
}

// The nodal forces stand in the order of (tag, branch) summed over all ranks, so the sums here do not depend
// on the number of ranks.
void RigidSurface::end_step(const NodalForces& forces) {
  if (!servo_) return;
  NURBS_ASSERT(forces.values.cols() == positions_.cols(), forces.values.cols(), positions_.cols());
  const RigidFrame& frame = body_.frame();
  const Vector3 com = frame.to_body(servo_->com());
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (const Eigen::Index a : forces.touched) {
    const Vector3 f = forces.values.col(a), X = positions_.col(a);
    force += f;
    torque += (X - com).cross(f);
  }
  servo_->control(frame.rotation * force, frame.rotation * torque, dt_);
}

std::vector<Probe> RigidSurface::probes() const {
  if (!servo_) return {};
  return {{"com", servo_->com() - servo_->settings().com}};
}

std::vector<double> RigidSurface::save() const {
  std::vector<double> state;
  if (!moves() && body_.frame().rotation.isIdentity(0.0) && body_.frame().origin.isZero(0.0)) return state;
  body_.save(state);
  motion_.save(state);
  if (servo_) servo_->save(state);
  return state;
}

void RigidSurface::load(const std::vector<double>& state) {
  if (state.empty()) return;  // saved by a wall that had never moved
  const double* const end = state.data() + state.size();
  if (state.size() < MovingFrame::kStateSize)
    throw std::invalid_argument("the restart file holds a state that is not that of a rigid wall");
  body_.load(state.data());
  const double* next = motion_.load(state.data() + MovingFrame::kStateSize, end);
  if (next != end && end - next != Servo::kStateSize)
    throw std::invalid_argument("the restart file holds a state that is not that of a rigid wall");
  if (next != end && servo_) servo_->load(next);
}

Fingerprint RigidSurface::fingerprint() const {
  if (surface_.faces) return {geometry_part(*surface_.faces)};
  std::vector<nurbs::Space<2>> patches;
  for (int p = 0; p < surface_.topology.patch_count(); ++p) patches.push_back(surface_.topology.patch(p));
  return {geometry_part(patches, digest(positions_))};
}

}  // namespace coupling
