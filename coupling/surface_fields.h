// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts do to a surface, as fields on it: pressure, shear, number of contacts, wear.
//
// A contact force F at xi is spread to the control points as the structure's is, f_A = R_A(xi) F (Gao & Feng
// 2019, eq. 34), and the field's coefficient is the mean of f_A over the sampled steps divided by
// area_A = integral of R_A.  So sum_A area_A p_A, which is the integral of the field over the surface, is the
// total force exactly.  Control points that stand at one place on the rims of patches (seams, poles, welded
// borders) share force and area, so that fields are continuous there.
#pragma once

#include <mpi.h>

#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/rigid_frame.h"
#include "vtk/bezier_cells.h"

namespace coupling {

/// One contact as the surface feels it, in the body frame.
struct SurfaceContact {
  nurbs::SurfacePoint foot;
  Vector3 force;       ///< on the surface [force]
  Vector3 normal;      ///< unit, from the surface to the particle
  double worn_volume;  ///< in this step [length^3]
};

class SurfaceFields {
 public:
  struct Selection {
    bool pressure = true, shear = true, contact_count = true, wear = false;
  };

  /// Every rank builds the same, from the undeformed surface (3 x n).
  SurfaceFields(MPI_Comm comm, const nurbs::MultiPatch& surface, const NodalVectors& control_points);

  /// A new step whose contacts count; the same on every rank.
  void begin_sample() { ++samples_; }
  /// A contact of this rank's particles.
  void add(const SurfaceContact& contact);

  /// Collective; the result is complete on rank 0.  `control_points` (3 x n): the surface as it now is, in
  /// the body frame; the result is in space.  Per control point
  ///   pressure  normal force per area, pressing > 0 [pressure];  shear  tangential force per area, a vector
  ///   wear      depth worn off since the beginning [length],
  /// per element
  ///   contact_count;
  /// all but wear are means over the samples, 0 without samples.
  std::vector<vtk::PatchFields<2>> fields(const NodalVectors& control_points, const RigidFrame& frame,
                                          const Selection& selection);
  /// Forgets all samples, not the wear.
  void begin_interval();

  /// Samples and wear as numbers, for restart files.  save is collective, its result complete on rank 0; load
  /// throws std::invalid_argument if the size does not fit.
  std::vector<double> save() const;
  void load(const std::vector<double>& state);
  std::size_t state_size() const { return 1 + forces_.size() + contacts_.size(); }

 private:
  enum Row { kNormal, kShear, kWear = kShear + 3, kRows };

  void note_load(int control_point);
  Eigen::MatrixXd sum_over_ranks(const Eigen::MatrixXd& local) const;
  Eigen::MatrixXd per_area(const Eigen::MatrixXd& sums) const;
  void measure(const NodalVectors& control_points);

  MPI_Comm comm_;
  nurbs::MultiPatch surface_;
  std::vector<int> shared_;  // per control point: the one that keeps the sums of its place
  NodalVectors measured_;    // the control points of area_: a rigid surface is measured once
  Eigen::VectorXd area_;  // of the control points, those of one place together at the one that keeps its sums
  // of this rank; sums over samples (kNormal, kShear, contacts), over all time (kWear)
  Eigen::MatrixXd forces_;    // kRows x control points [force], kWear [length^3]
  Eigen::MatrixXd contacts_;  // 1 x elements
  double samples_ = 0.0;
  // where sums are not zero, so that a step without means need not look at all of the wall
  std::vector<int> loaded_, counted_;  // control points, elements
  std::vector<bool> is_loaded_;
};

}  // namespace coupling
