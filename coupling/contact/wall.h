// SPDX-License-Identifier: GPL-2.0-or-later
// The wall as it stands in this step: its surface, where that is and how it moves, and which side is which.
// Feet and control points are in the wall's frame; what is called delta, from a foot to a particle's centre,
// and all velocities are in space.
#pragma once

#include <vector>

#include "coupling/contact/wall_shape.h"
#include "coupling/surface_exchange.h"
#include "nurbs/assert.h"
#include "nurbs/multi_patch.h"

namespace contact {

using nurbs::Vector3;
using search::Foot;

class Wall {
 public:
  /// Keeps references to both.  `edge_angle`: edges between patches that turn by no more are smooth; a
  /// surface of faces has classed its own [rad].
  Wall(const coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange, double edge_angle);
  Wall(const Wall&) = delete;
  Wall& operator=(const Wall&) = delete;

  /// A rigid wall that spans a periodic box has no edge there: welds what meets after a shift by one of these
  /// periods, in space [length].
  void weld_across(const std::vector<Vector3>& periods);
  /// Takes place and shape from the structure, near the elements that are followed.  Collective, as are the
  /// next four.
  void import();
  /// Of a wall that deforms: all of its shape.
  void import_all();
  /// A list is new: from now on contacts are with these elements alone, and motion counts.
  void follow(const std::vector<int>& elements) { exchange_.follow(elements); }
  /// Largest distance of a control point of the whole wall, in its frame, from where it was then [length].
  double motion_of_shape() const { return exchange_.largest_motion(); }
  /// Whether it is so on any rank, as far as they must agree.
  bool any(bool here) const { return exchange_.any(here); }
  std::vector<double> all(const std::vector<double>& here) const { return exchange_.all(here); }
  /// A list of candidates is to be built of all of it, as it now is.
  void begin_list();
  /// The box of all elements then, in the wall's frame.
  const search::Box& bounds() const { return bounds_; }

  const nurbs::MultiPatch& surface() const { return surface_; }
  const nurbs::NodalVectors& control_points() const { return exchange_.positions(); }
  const nurbs::NodalVectors& velocities() const { return exchange_.velocities(); }
  const coupling::NetSpread* net_spread() const { return exchange_.net_spread(); }  ///< null: none
  const coupling::RigidFrame& frame() const { return frame_; }
  /// Whether those of the body's nodes are known; what a foot is accelerated by along n under a unit force,
  /// and no more than that anywhere [1/mass].
  bool knows_masses() const { return exchange_.inverse_masses().cols() > 0; }
  double inverse_mass_at(const nurbs::SurfacePoint& foot, const nurbs::Vector3& n) const {
    return exchange_.inverse_mass_at(foot, n);
  }
  double largest_inverse_mass() const { return largest_inverse_mass_; }
  bool is_at_seam(const nurbs::SurfacePoint& foot) const { return exchange_.is_at_seam(foot); }
  bool is_at_kink(const nurbs::SurfacePoint& foot) const { return exchange_.is_at_kink(foot); }
  /// Of the body's fastest vibration, at most, if it takes the same steps as the particles [1/time^2].
  double squared_frequency() const {
    const double stable = structure_.stable_time_step_with_contacts();
    return 4.0 / (stable * stable);
  }
  double shortest_contact() const { return structure_.shortest_contact(); }  ///< that it knows [time]
  const WallShape& shape() const { return *shape_; }

  bool deforms() const { return deforms_; }
  bool stands() const { return stands_; }  ///< nothing of it moves in this step
  bool is_turned() const { return is_turned_; }
  bool needs_forces() const { return needs_forces_; }

  Vector3 to_frame(const Vector3& x) const { return to_frame_direction(x - frame_.origin); }
  Vector3 to_frame_direction(const Vector3& x) const { return is_turned_ ? frame_.direction_to_body(x) : x; }
  Vector3 to_space_direction(const Vector3& X) const { return is_turned_ ? frame_.direction_to_space(X) : X; }
  /// At most, of any of its points [length/time].
  double max_speed() const;
  /// At a foot, which is at `point` in space, on the wall or an image of it.
  Vector3 velocity(const Foot& foot, const Vector3& point, const Vector3& delta) const {
    if (stands_) return Vector3::Zero();
    return deforms_ ? velocity_of_deforming(foot)
                    : velocity_of_rigid(point - to_space_direction(foot.image), delta);
  }

  /// The same with the place of the centre.
  Vector3 velocity_below(const Foot& foot, const Vector3& centre, const Vector3& delta) const {
    return stands_ ? Vector3(Vector3::Zero()) : velocity(foot, centre - delta, delta);
  }
  /// The same at a point of a wall itself that is rigid and does not stand.
  Vector3 velocity_of_rigid(const Vector3& point, const Vector3& delta) const {
    Vector3 v = turns_ ? frame_.velocity_at(point) : frame_.velocity;
    if (slides_) v += structure_.surface_velocity(point, delta.normalized());
    return v;
  }

  /// Of a wall that deforms, at a foot; all in its frame.
  search::SurfaceProjector::Slopes slopes(const nurbs::SurfacePoint& foot, const Vector3& delta) const {
    NURBS_ASSERT(patches_, foot.patch);
    return patches_->patch(foot.patch).slopes(foot.xi, delta);
  }
  /// +1 where dS/dxi x dS/deta points, -1 on the other side.
  int side_of(const Foot& foot, const Vector3& delta) const;
  /// Whether a centre on this side of a patch is inside the body; outside an edge or a corner neither side
  /// is.
  bool is_inside(const Foot& foot, int side) const {
    return has_inside_ && foot.status == search::FootStatus::interior &&
           shape_->outward_sign(foot.patch) * side < 0;
  }
  /// A centre nearer than this is on the surface [length].
  double resolution() const { return resolution_; }
  /// A centre on the surface has no direction of its own: takes it off along the normal, by so little that
  /// the overlap does not feel it.  It goes to the side where it is as far as round-off tells, else to
  /// `known_side` (of the patch; 0: not known), else out of a body, else against its velocity `v` at `x`.
  /// Changes foot.distance; the result is the new delta.
  Vector3 leave(Foot& foot, const Vector3& delta, int known_side, double radius, const Vector3& x,
                const Vector3& v) const;

  /// r* = (R' R'')^(1/2) with 1/R = 1/r - curvature of the wall towards the particle, in each principal
  /// direction: the equivalent radius of Johnson (1985), section 4.2; exact where both are equal, as on a
  /// sphere [length].
  double effective_radius(const Foot& foot, const Vector3& delta, double radius) const;

 private:
  Vector3 velocity_of_deforming(const Foot& foot) const;

  const coupling::StructureSolver& structure_;
  coupling::SurfaceExchange& exchange_;
  bool has_inside_;                     // where no particle may be; a rigid wall may be a container
  nurbs::MultiPatch surface_;           // of the structure; welded across periodic faces, too
  std::vector<Vector3> welded_across_;  // these periods, in its frame
  std::unique_ptr<WallShape> shape_;
  const PatchShape* patches_;  // the same; null: of faces, which do not deform
  search::Box bounds_;
  coupling::RigidFrame frame_;
  double resolution_ = 0.0, largest_inverse_mass_ = 0.0;
  bool imported_ = false, needs_forces_ = false, deforms_ = false, slides_ = false, stands_ = false,
       is_turned_ = false, turns_ = false;
};

}  // namespace contact
