// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_curves.h"

#include <Eigen/Geometry>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <gp_Elips.hxx>
#include <gp_Elips2d.hxx>
#include <gp_Hypr.hxx>
#include <gp_Hypr2d.hxx>
#include <gp_Parab.hxx>
#include <gp_Parab2d.hxx>
#include <stdexcept>
#include <type_traits>

namespace geometry_io {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// (x, y, w) of a conic in its plane -> (w P, w), round the place of its axes.
template <class Axes>
MatrixXd placed(const Axes& axes, double along_x, double along_y) {
  const auto origin = vector(axes.Location());
  const int dim = static_cast<int>(origin.size());
  MatrixXd matrix = MatrixXd::Zero(dim + 1, 3);
  matrix.col(0).head(dim) = along_x * vector(axes.XDirection());
  matrix.col(1).head(dim) = along_y * vector(axes.YDirection());
  matrix.col(2).head(dim) = origin;
  matrix(dim, 2) = 1.0;
  return matrix;
}

template <class Adaptor, class Conic>
auto axes_of(const Conic& conic) {
  if constexpr (std::is_same_v<Adaptor, Geom2dAdaptor_Curve>)
    return conic.Axis();
  else
    return conic.Position();
}

template <class Curve>
MatrixXd control_points(const Curve& curve) {
  const int dim = static_cast<int>(vector(curve.Pole(1)).size());
  MatrixXd points(dim + 1, curve.NbPoles());
  for (int i = 0; i < curve.NbPoles(); ++i) {
    const double w = curve.Weight(i + 1);
    points.col(i).head(dim) = w * vector(curve.Pole(i + 1));
    points(dim, i) = w;
  }
  return points;
}

template <class Curve>
AnySpline b_spline(const Curve& curve, double from, double to) {
  std::vector<double> breaks, knots;
  std::vector<int> multiplicities;
  for (int i = 1; i <= curve.NbKnots(); ++i) {
    breaks.push_back(curve.Knot(i));
    multiplicities.push_back(curve.Multiplicity(i));
    knots.insert(knots.end(), multiplicities.back(), breaks.back());
  }
  const MatrixXd points = control_points(curve);
  return window(curve.IsPeriodic() ? unrolled(curve.Degree(), breaks, multiplicities, points, from, to)
                                   : AnySpline{curve.Degree(), knots, points},
                from, to);
}

template <class Curve>
AnySpline bezier(const Curve& curve, double from, double to) {
  std::vector<double> knots(curve.Degree() + 1, 0.0);
  knots.insert(knots.end(), curve.Degree() + 1, 1.0);
  return window({curve.Degree(), knots, control_points(curve)}, from, to);
}

}  // namespace

template <class Adaptor>
AnySpline spline_of(const Adaptor& curve, double from, double to, double tolerance, bool& fitted_anew) {
  const auto point = [&](double t) -> VectorXd { return vector(curve.Value(t)); };
  switch (curve.GetType()) {
    case GeomAbs_Line:
      return segment(point(from), point(to), from, to);
    case GeomAbs_Circle:
      return transformed(unit_arc(from, to), placed(axes_of<Adaptor>(curve.Circle()), curve.Circle().Radius(),
                                                    curve.Circle().Radius()));
    case GeomAbs_Ellipse:
      return transformed(unit_arc(from, to),
                         placed(axes_of<Adaptor>(curve.Ellipse()), curve.Ellipse().MajorRadius(),
                                curve.Ellipse().MinorRadius()));
    case GeomAbs_Hyperbola:
      return transformed(unit_hyperbola(from, to),
                         placed(axes_of<Adaptor>(curve.Hyperbola()), curve.Hyperbola().MajorRadius(),
                                curve.Hyperbola().MinorRadius()));
    case GeomAbs_Parabola:
      return transformed(unit_parabola(from, to),
                         placed(axes_of<Adaptor>(curve.Parabola()), 0.25 / curve.Parabola().Focal(), 1.0));
    case GeomAbs_BSplineCurve:
      return b_spline(*curve.BSpline(), from, to);
    case GeomAbs_BezierCurve:
      return bezier(*curve.Bezier(), from, to);
    default:
      break;
  }
  fitted_anew = true;
  AnySpline fit =
      fitted(point, from, to, [&](double t, const VectorXd& p) { return (p - point(t)).norm() / tolerance; });
  fit.points.conservativeResize(fit.points.rows() + 1, Eigen::NoChange);
  fit.points.bottomRows(1).setOnes();
  return fit;
}
template AnySpline spline_of(const Adaptor3d_Curve&, double, double, double, bool&);
template AnySpline spline_of(const Geom2dAdaptor_Curve&, double, double, double, bool&);

brep::CadEdge edge_of(const TopoDS_Edge& edge, double tolerance, bool& fitted_anew) {
  double from, to;
  const Handle(Geom_Curve) geometry = BRep_Tool::Curve(edge, from, to);
  if (geometry.IsNull()) throw std::runtime_error("an edge without a curve in space");
  const GeomAdaptor_Curve curve(geometry, from, to);
  brep::CadEdge out;
  out.origin = out.axis = out.radial = brep::Vector3::Zero();
  const brep::Vector3 begin = vector(curve.Value(from));
  if (curve.GetType() == GeomAbs_Line) {
    out.kind = brep::CadEdge::Kind::line;
    out.origin = begin;
    out.axis = vector(curve.Line().Direction());
    out.length = to - from;
  } else if (curve.GetType() == GeomAbs_Circle) {
    const gp_Circ circle = curve.Circle();
    const brep::Vector3 x = vector(circle.XAxis().Direction()), y = vector(circle.YAxis().Direction());
    out.kind = brep::CadEdge::Kind::circle;
    out.origin = vector(circle.Location());
    out.axis = x.cross(y).normalized();
    out.radial = (std::cos(from) * x + std::sin(from) * y).normalized();
    out.R = circle.Radius();
    out.length = to - from;
  } else {
    out.kind = brep::CadEdge::Kind::spline;
    out.curve = finished<3>(spline_of<Adaptor3d_Curve>(curve, from, to, tolerance, fitted_anew));
  }
  return out;
}

}  // namespace geometry_io
