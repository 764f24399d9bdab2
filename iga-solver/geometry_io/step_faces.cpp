// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_faces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <cmath>
#include <stdexcept>

#include "geometry_io/step_curves.h"
#include "nurbs/max_degree.h"
#include "nurbs/usable_number.h"

namespace geometry_io {
namespace {

using brep::Kind;
using brep::Vector3;
using Eigen::MatrixXd;

// Right-handed with this axis; the angle runs on by `sense`, as the surface's own or against it.
struct Axes {
  brep::Frame frame;
  double sense;
};
Axes axes_of(const gp_Ax3& position, double along) {
  Axes axes;
  axes.frame = brep::frame_at(vector(position.Location()), along * vector(position.Direction()),
                              vector(position.XDirection()));
  axes.sense = axes.frame.y.dot(vector(position.YDirection())) > 0.0 ? 1.0 : -1.0;
  return axes;
}

ReadSurface closed_form(Kind kind, const Axes& axes) {
  ReadSurface read;
  read.shape.kind = kind;
  read.shape.frame = axes.frame;
  read.map[0].scale = axes.sense;
  return read;
}

ReadSurface plane(const gp_Pln& plane) {
  const Vector3 x = vector(plane.Position().XDirection()), y = vector(plane.Position().YDirection());
  return closed_form(Kind::plane, {brep::frame_at(vector(plane.Location()), x.cross(y), x), 1.0});
}

// Lengths along a cone count from its tip, upwards in the half that the face is in.
ReadSurface cone(const gp_Cone& cone, const ParameterBox& box) {
  const double angle = cone.SemiAngle(), tip = -cone.RefRadius() / std::sin(angle);
  const double up = 0.5 * (box.low[1] + box.high[1]) < tip ? -1.0 : 1.0;
  const double reach = std::max(box.high[1] - tip, tip - box.low[1]);
  if (std::min(up * (box.low[1] - tip), up * (box.high[1] - tip)) < -1e-7 * reach)
    throw std::runtime_error("a cone on both sides of its tip, expected one side");
  ReadSurface read = closed_form(Kind::cone, axes_of(cone.Position(), up));
  const Vector3 z = vector(cone.Position().Direction());
  read.shape.frame.origin = vector(cone.Location()) + tip * std::cos(angle) * z;
  read.shape.r = std::abs(angle);
  if (up * std::sin(angle) < 0.0) read.map[0].shift = nurbs::kPi;  // beyond the tip, on the other side
  read.map[1].scale = up;
  read.map[1].shift = -up * tip;
  return read;
}

std::string too_high(int u, int v) {
  return fmt::format("a patch of degrees {} and {}, expected {} at most", u, v, nurbs::kMaxDegree);
}

// Columns of direction 0, each with 4 rows for every control point of direction 1, the other way round.
MatrixXd turned(const MatrixXd& columns) {
  const int other = static_cast<int>(columns.rows()) / 4, own = static_cast<int>(columns.cols());
  MatrixXd rows(4 * own, other);
  for (int i = 0; i < own; ++i)
    for (int j = 0; j < other; ++j) rows.block<4, 1>(4 * i, j) = columns.block<4, 1>(4 * j, i);
  return rows;
}

nurbs::Surface patch_of(const AnySpline& u,
                        const AnySpline& v) {  // v: the last made, of 4 rows per column of u
  const int n_u = static_cast<int>(u.points.cols()), n_v = static_cast<int>(v.points.cols());
  if (u.degree > nurbs::kMaxDegree || v.degree > nurbs::kMaxDegree)
    throw std::runtime_error(too_high(u.degree, v.degree));
  nurbs::NodalVectors points(3, n_u * n_v);
  std::vector<double> weights(n_u * n_v);
  bool rational = false;
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i) {
      const Eigen::Vector4d p = v.points.block<4, 1>(4 * i, j);
      weights[i + n_u * j] = p(3);
      points.col(i + n_u * j) = p(3) == 1.0 ? p.head<3>() : Eigen::Vector3d(p.head<3>() / p(3));
      rational = rational || p(3) != 1.0;
    }
  if (!rational) weights.clear();
  nurbs::Surface patch{
      nurbs::Space<2>({nurbs::KnotVector(u.degree, u.knots), nurbs::KnotVector(v.degree, v.knots)},
                      std::move(weights)),
      std::move(points)};
  nurbs::check_patch(patch);
  return patch;
}

ReadSurface with_patch(nurbs::Surface patch) {
  ReadSurface read;
  read.shape.kind = Kind::nurbs;
  read.patch = std::move(patch);
  return read;
}

// One direction of a B-spline surface: open as it is, or the part that the face is in.
AnySpline opened(int degree, bool periodic, int count, const std::function<double(int)>& knot,
                 const std::function<int(int)>& multiplicity, const MatrixXd& points, double low,
                 double high) {
  std::vector<double> breaks, knots;
  std::vector<int> multiplicities;
  for (int i = 1; i <= count; ++i) {
    breaks.push_back(knot(i));
    multiplicities.push_back(multiplicity(i));
    knots.insert(knots.end(), multiplicities.back(), breaks.back());
  }
  if (periodic) return joined(window(unrolled(degree, breaks, multiplicities, points, low, high), low, high));
  const AnySpline all{degree, knots, points};
  return joined(window(all, all.begin(), all.end()));
}

ReadSurface b_spline(const Geom_BSplineSurface& s, const ParameterBox& box) {
  if (s.UDegree() > nurbs::kMaxDegree || s.VDegree() > nurbs::kMaxDegree)
    throw std::runtime_error(too_high(s.UDegree(), s.VDegree()));
  const int n_u = s.NbUPoles(), n_v = s.NbVPoles();
  MatrixXd columns(4 * n_v, n_u);
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j) {
      const double w = s.Weight(i + 1, j + 1);
      columns.block<4, 1>(4 * j, i) << w * vector(s.Pole(i + 1, j + 1)), w;
    }
  const AnySpline u = opened(
      s.UDegree(), s.IsUPeriodic(), s.NbUKnots(), [&](int i) { return s.UKnot(i); },
      [&](int i) { return s.UMultiplicity(i); }, columns, box.low[0], box.high[0]);
  const AnySpline v = opened(
      s.VDegree(), s.IsVPeriodic(), s.NbVKnots(), [&](int i) { return s.VKnot(i); },
      [&](int i) { return s.VMultiplicity(i); }, turned(u.points), box.low[1], box.high[1]);
  return with_patch(patch_of(u, v));
}

bool is_conic_of_angle(GeomAbs_CurveType type) { return type == GeomAbs_Circle || type == GeomAbs_Ellipse; }

// The curve that is swept, and what becomes of its parameter.
AnySpline swept_curve(const Adaptor3d_Curve& curve, double low, double high, double tolerance,
                      ParameterMap& map, bool& fitted_anew) {
  bool fitted_curve = false;
  AnySpline spline = joined(spline_of<Adaptor3d_Curve>(curve, low, high, tolerance, fitted_curve));
  fitted_anew = fitted_anew || fitted_curve;
  if (is_conic_of_angle(curve.GetType())) map.arc[0] = low, map.arc[1] = high;
  return spline;
}

ReadSurface extrusion(const GeomAdaptor_Surface& s, const ParameterBox& box, double tolerance,
                      bool& fitted_anew) {
  ReadSurface read;
  const Handle(Adaptor3d_Curve) basis = s.BasisCurve();
  if (basis->GetType() == GeomAbs_Hyperbola)
    throw std::runtime_error("an extrusion of a hyperbola, expected lines, circles, ellipses or splines");
  const AnySpline u = swept_curve(*basis, box.low[0], box.high[0], tolerance, read.map[0], fitted_anew);
  const Vector3 along = vector(s.Direction());
  const int n = static_cast<int>(u.points.cols());
  AnySpline v = segment(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), box.low[1], box.high[1]);
  v.points.resize(4 * n, 2);
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < n; ++i) {
      v.points.block<4, 1>(4 * i, end) = u.points.col(i);
      v.points.block<3, 1>(4 * i, end) += (end == 0 ? box.low[1] : box.high[1]) * u.points(3, i) * along;
    }
  read.shape.kind = Kind::nurbs;
  read.patch = patch_of(u, v);
  return read;
}

ReadSurface revolution(const GeomAdaptor_Surface& s, const ParameterBox& box, double tolerance,
                       bool& fitted_anew) {
  ReadSurface read;
  const Handle(Adaptor3d_Curve) basis = s.BasisCurve();
  if (basis->GetType() == GeomAbs_Hyperbola)
    throw std::runtime_error("a revolved hyperbola, expected lines, circles, ellipses or splines");
  AnySpline v = swept_curve(*basis, box.low[1], box.high[1], tolerance, read.map[1], fitted_anew);
  const AnySpline u = unit_arc(box.low[0], box.high[0]);
  read.map[0].arc[0] = box.low[0];
  read.map[0].arc[1] = box.high[0];
  const Vector3 origin = vector(s.AxeOfRevolution().Location()), z = vector(s.AxeOfRevolution().Direction());
  const MatrixXd meridian = v.points;
  const int n_u = static_cast<int>(u.points.cols());
  v.points.resize(4 * n_u, meridian.cols());
  for (int j = 0; j < meridian.cols(); ++j) {
    const double w = meridian(3, j);
    const Vector3 from_origin = meridian.col(j).head<3>() - w * origin;  // times w
    const Vector3 on_axis = z * z.dot(from_origin), x = from_origin - on_axis, y = z.cross(x);
    for (int i = 0; i < n_u; ++i) {
      const Eigen::Vector3d c = u.points.col(i);
      v.points.block<4, 1>(4 * i, j) << c(2) * (w * origin + on_axis) + c(0) * x + c(1) * y, c(2) * w;
    }
  }
  read.shape.kind = Kind::nurbs;
  read.patch = patch_of(u, v);
  return read;
}

ReadSurface approximated(const GeomAdaptor_Surface& s, const ParameterBox& box, double tolerance,
                         bool& fitted_anew) {
  const auto offset = Handle(Geom_OffsetSurface)::DownCast(s.Surface());
  if (!offset.IsNull() && !offset->Surface().IsNull())  // of a plane, a cylinder ...
    return surface_of(GeomAdaptor_Surface(offset->Surface()), box, tolerance, fitted_anew);
  if (!(tolerance > 0.0))
    throw std::runtime_error(
        "a surface at an offset from another, which no NURBS patch is; expected other surfaces, or "
        "a tolerance within which it is fitted");
  fitted_anew = true;
  const Handle(Geom_Surface) part =
      new Geom_RectangularTrimmedSurface(s.Surface(), box.low[0], box.high[0], box.low[1], box.high[1]);
  const GeomConvert_ApproxSurface fit(part, tolerance, GeomAbs_C1, GeomAbs_C1, 8, 8, 200, 1);
  if (!fit.HasResult() || fit.MaxError() > tolerance)
    throw std::runtime_error(
        fmt::format("a surface at an offset from another, and no patch within {} mm", tolerance));
  return b_spline(*fit.Surface(), box);
}

}  // namespace

namespace {
double positive(double radius, const char* what) {
  if (!(radius > 0.0 && nurbs::is_usable(radius)))
    throw std::runtime_error(fmt::format("a {} of radius {}, expected a number > 0", what, radius));
  return radius;
}
}  // namespace

ReadSurface surface_of(const GeomAdaptor_Surface& surface, const ParameterBox& box, double tolerance,
                       bool& fitted_anew) {
  constexpr double kFitted = 1e-9;  // of curves that are swept [mm]
  switch (surface.GetType()) {
    case GeomAbs_Plane:
      return plane(surface.Plane());
    case GeomAbs_Cylinder: {
      ReadSurface read = closed_form(Kind::cylinder, axes_of(surface.Cylinder().Position(), 1.0));
      read.shape.R = positive(surface.Cylinder().Radius(), "cylinder");
      return read;
    }
    case GeomAbs_Cone:
      return cone(surface.Cone(), box);
    case GeomAbs_Sphere: {
      ReadSurface read = closed_form(Kind::sphere, axes_of(surface.Sphere().Position(), 1.0));
      read.shape.R = positive(surface.Sphere().Radius(), "sphere");
      return read;
    }
    case GeomAbs_Torus: {
      ReadSurface read = closed_form(Kind::torus, axes_of(surface.Torus().Position(), 1.0));
      read.shape.R = positive(surface.Torus().MajorRadius(), "torus");
      read.shape.r = positive(surface.Torus().MinorRadius(), "tube");
      if (!(read.shape.R > read.shape.r))
        throw std::runtime_error(
            fmt::format("a torus of radii {} and {} that meets itself, expected a tube that is thinner",
                        read.shape.R, read.shape.r));
      return read;
    }
    case GeomAbs_BSplineSurface:
      return b_spline(*surface.BSpline(), box);
    case GeomAbs_BezierSurface:
      return b_spline(*GeomConvert::SurfaceToBSplineSurface(surface.Bezier()), box);
    case GeomAbs_SurfaceOfExtrusion:
      return extrusion(surface, box, kFitted, fitted_anew);
    case GeomAbs_SurfaceOfRevolution:
      return revolution(surface, box, kFitted, fitted_anew);
    default:
      return approximated(surface, box, tolerance, fitted_anew);
  }
}

}  // namespace geometry_io
