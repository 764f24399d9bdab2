// SPDX-License-Identifier: GPL-2.0-or-later
// B-splines with any knots, as CAD files have them, and what makes curves with open knots of them.
// Source: Piegl & Tiller (1997), chapters 3-5 and 7; Cohen, Lyche & Riesenfeld (1980) for the window.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "brep/cad_model.h"

namespace geometry_io {

/// A curve in homogeneous coordinates: columns are (w P, w), or whatever else may be combined linearly.
struct AnySpline {
  int degree = 1;
  std::vector<double> knots;  ///< rising; columns + degree + 1 of them
  Eigen::MatrixXd points;

  double begin() const { return knots[degree]; }
  double end() const { return knots[points.cols()]; }
  /// The column at t, by de Boor's algorithm.
  Eigen::VectorXd at(double t) const;
  /// The same, divided by its last coordinate and without it.
  Eigen::VectorXd point(double t) const;
};

/// The part on [from, to], from < to, with open knots; the same to the last bit if it is the whole of such a
/// one.  Outside its range the first and the last polynomial go on.
AnySpline window(const AnySpline& spline, double from, double to);
/// A closed curve, of which `breaks` (period + 1 of them) and `multiplicities` are one turn, as one that
/// covers [from, to]; its knots are not open.
AnySpline unrolled(int degree, const std::vector<double>& breaks, const std::vector<int>& multiplicities,
                   const Eigen::MatrixXd& points, double from, double to);
/// Knots inside that stand degree + 1 times, as some programs write them, once less: there the curve is
/// written in two, with one point twice.  Throws std::runtime_error if these are apart by more than 1e-9 of
/// the largest.
AnySpline joined(const AnySpline& spline);
/// The other way round: t becomes begin + end - t.
AnySpline reversed(const AnySpline& spline);
/// `matrix` times each column.
AnySpline transformed(AnySpline spline, const Eigen::MatrixXd& matrix);

/// Straight from a to b.
AnySpline segment(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double from, double to);
/// (w cos, w sin, w) between two angles: rational arcs of at most 90 degrees, whose ends are at the
/// parameters that are their angles.
AnySpline unit_arc(double from, double to);
/// Parameter of unit_arc(from, to) at an angle, which is not the angle itself inside an arc.
double arc_parameter(double from, double to, double angle);
/// (w cosh, w sinh, w) between two parameters.
AnySpline unit_hyperbola(double from, double to);
/// (t^2, t, 1).
AnySpline unit_parabola(double from, double to);

/// Polynomial pieces of degree 6 through points of `curve`, cut until `error(t, point)` is at most 1 in
/// between.  Throws std::runtime_error if 4096 pieces are too few.
AnySpline fitted(const std::function<Eigen::VectorXd(double)>& curve, double from, double to,
                 const std::function<double(double, const Eigen::VectorXd&)>& error);

/// With weights, if they are not all alike.
template <int Dim>
brep::Spline<Dim> finished(const AnySpline& spline);
template <int Dim>
AnySpline homogeneous(const brep::Spline<Dim>& spline);

}  // namespace geometry_io
