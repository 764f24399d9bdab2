// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces of B-spline curves as rational Bezier curves.  Source: Piegl & Tiller (1997),
// sections 1.3, 1.4, 5.3.
#pragma once

#include <utility>
#include <vector>

#include "brep/cad_model.h"

namespace brep {

template <int Dim>
struct BezierCurve {
  using Point = Eigen::Matrix<double, Dim, 1>;
  using Homogeneous = Eigen::Matrix<double, Dim + 1, 1>;

  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> points;  ///< (w P, w), degree + 1 of them
  double begin, end;                                      ///< of the spline's parameter

  int degree() const { return static_cast<int>(points.cols()) - 1; }
  Point point(int k) const { return points.col(k).template head<Dim>() / points(Dim, k); }

  struct Derivatives {
    Point point, first, second;  ///< by s
  };
  /// At s in [0, 1].
  Point at(double s) const { return derivatives(s).point; }
  Derivatives derivatives(double s) const;
  /// Before and behind s; they meet in one point to the last bit.
  std::pair<BezierCurve, BezierCurve> parts(double s) const;
};

/// Of each knot span one; a knot may stand degree + 1 times, where the curve stands still.  Throws
/// std::invalid_argument as nurbs::KnotVector does, and if there is not one point, and one weight if any, for
/// each function.
template <int Dim>
std::vector<BezierCurve<Dim>> beziers(const Spline<Dim>& spline);

}  // namespace brep
