// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts do to NURBS patches, as fields on them: pressure, shear, number of contacts, wear.
//
// A contact force F at xi is spread to the control points as the structure's is, f_A = R_A(xi) F (Gao & Feng
// 2019, eq. 34), and the field's coefficient is the mean of f_A over the sampled steps divided by
// area_A = integral of R_A.  So sum_A area_A p_A, which is the integral of the field over the surface, is the
// total force exactly.  Control points that stand at one place on the rims of patches (seams, poles, welded
// borders) share force and area, so that fields are continuous there.
#pragma once

#include <vector>

#include "coupling/contact_fields.h"

namespace coupling {

/// Places are control points, cells are elements.
class SurfaceFields final : public ContactFields {
 public:
  /// Every rank builds the same, from the undeformed surface (3 x n).
  SurfaceFields(MPI_Comm comm, const nurbs::MultiPatch& surface, const NodalVectors& control_points);

  void add(const SurfaceContact& contact) override;
  State state(const NodalVectors& control_points, const RigidFrame& frame,
              const Selection& selection) override {
    return fields(control_points, frame, selection);
  }
  std::vector<vtk::PatchFields<2>> fields(const NodalVectors& control_points, const RigidFrame& frame,
                                          const Selection& selection);

 private:
  Eigen::MatrixXd per_area(const Eigen::MatrixXd& sums) const;
  void measure(const NodalVectors& control_points);

  nurbs::MultiPatch surface_;
  std::vector<int> shared_;  // per control point: the one that keeps the sums of its place
  NodalVectors measured_;    // the control points of area_: a rigid surface is measured once
  Eigen::VectorXd area_;  // of the control points, those of one place together at the one that keeps its sums
};

}  // namespace coupling
