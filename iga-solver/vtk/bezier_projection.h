// SPDX-License-Identifier: GPL-2.0-or-later
// Fields that are not on a patch's own basis, such as stresses, as coefficients at its Bezier points.
// Element by element the field is interpolated at the p + 1 Gauss points of each direction, which is the L2
// projection by these points and reproduces what lies in the element's (rational) Bezier space; Bezier points
// that elements share get the mean of theirs.  So a field that is continuous and of degree p stays what it
// is, one that jumps between elements is smoothed there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nurbs/patch.h"

namespace vtk {

class BezierProjection {
 public:
  /// Of fields with so many components.
  BezierProjection(const nurbs::Space<3>& space, int components);

  /// Of one element: components x points, its Gauss points with the first direction fastest.
  void add(int element, const Eigen::MatrixXd& values);
  /// Components x Bezier points; 0 where no element was added.
  Eigen::MatrixXd coefficients() const;

 private:
  /// Applies one matrix per direction to the points of an element.
  Eigen::MatrixXd along_each_direction(const Eigen::MatrixXd (&matrices)[3], Eigen::MatrixXd values) const;

  nurbs::Space<3> space_, bezier_;
  Eigen::MatrixXd at_gauss_points_[3];  // Bernstein polynomials: [point, function]
  Eigen::MatrixXd to_coefficients_[3];  // the inverse
  Eigen::MatrixXd sums_;
  Eigen::VectorXd elements_;  // added so far, per Bezier point
};

}  // namespace vtk
