// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry_io/cad_measures.h"

namespace geometry_io {
namespace {

using brep::CadEdge;
using brep::Vector3;

// Where a function that rises from below 0 to above it is 0; an end if it is not on both sides.
template <class Function>
double zero_of(const Function& f, double low, double high) {
  constexpr int kHalvings = 54;
  if (!(f(low) < 0.0)) return low;
  if (!(f(high) > 0.0)) return high;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

EdgeCurve::EdgeCurve(const CadEdge& edge) : edge_(edge), begin_(0.0), end_(edge.length) {
  if (edge.kind != CadEdge::Kind::spline) return;
  curves_ = brep::beziers(edge.curve);
  begin_ = curves_.front().begin;
  end_ = curves_.back().end;
  for (const auto& curve : curves_) {
    const int count = 8 * std::max(1, curve.degree() - 1);
    for (int k = 0; k < count; ++k) places_.push_back(curve.begin + (curve.end - curve.begin) * k / count);
  }
  places_.push_back(end_);
  for (const double t : places_) samples_.push_back(at(t).point);
}

brep::BezierCurve<3>::Derivatives EdgeCurve::at(double t) const {
  const auto behind = std::upper_bound(curves_.begin(), curves_.end(), t,
                                       [](double a, const auto& c) { return a < c.begin; });
  const auto& curve = behind == curves_.begin() ? curves_.front() : *(behind - 1);
  return curve.derivatives(std::clamp((t - curve.begin) / (curve.end - curve.begin), 0.0, 1.0));
}

Vector3 EdgeCurve::point(double t) const {
  if (edge_.kind == CadEdge::Kind::line) return edge_.origin + t * edge_.axis;
  if (edge_.kind == CadEdge::Kind::spline) return at(t).point;
  return edge_.origin + edge_.R * (std::cos(t) * edge_.radial + std::sin(t) * edge_.axis.cross(edge_.radial));
}

Vector3 EdgeCurve::tangent(double t) const {
  if (edge_.kind == CadEdge::Kind::line) return edge_.axis;
  if (edge_.kind == CadEdge::Kind::spline) return at(t).first.stableNormalized();
  return std::cos(t) * edge_.axis.cross(edge_.radial) - std::sin(t) * edge_.radial;
}

double EdgeCurve::nearest_on_circle(const Vector3& point, double from, double to) const {
  const Vector3 d = point - edge_.origin;
  double t = std::atan2(d.dot(edge_.axis.cross(edge_.radial)), d.dot(edge_.radial));
  while (t < from) t += nurbs::kTwoPi;
  if (t <= to) return t;
  return t - to < from + nurbs::kTwoPi - t ? to : from;
}

double EdgeCurve::nearest_on_spline(const Vector3& point, double from, double to) const {
  double best = (this->point(from) - point).squaredNorm(), at_best = from;
  const auto look = [&](double t, const Vector3& sample) {
    const double away = (sample - point).squaredNorm();
    if (away < best) best = away, at_best = t;
  };
  look(to, this->point(to));
  for (size_t k = 0; k < places_.size(); ++k)
    if (from < places_[k] && places_[k] < to) look(places_[k], samples_[k]);
  const auto above = std::upper_bound(places_.begin(), places_.end(), at_best);
  const auto below = std::lower_bound(places_.begin(), places_.end(), at_best);
  const double low = below == places_.begin() ? from : std::max(from, *(below - 1)),
               high = above == places_.end() ? to : std::min(to, *above);
  return zero_of(
      [&](double t) {
        const auto here = at(t);
        return here.first.dot(here.point - point);
      },
      low, high);
}

CurvePlace EdgeCurve::nearest(const Vector3& point, double from, double to) const {
  const double t = edge_.kind == CadEdge::Kind::line
                       ? std::clamp(edge_.axis.dot(point - edge_.origin), from, to)
                   : edge_.kind == CadEdge::Kind::circle ? nearest_on_circle(point, from, to)
                                                         : nearest_on_spline(point, from, to);
  return {t, (this->point(t) - point).norm()};
}

CadEdge part_of(const CadEdge& edge, double from, double to) {
  CadEdge part = edge;
  if (edge.kind == CadEdge::Kind::spline) {
    part.curve = finished<3>(window(homogeneous(edge.curve), from, to));
    return part;
  }
  if (edge.kind == CadEdge::Kind::line) part.origin = edge.origin + from * edge.axis;
  if (edge.kind == CadEdge::Kind::circle)
    part.radial = std::cos(from) * edge.radial + std::sin(from) * edge.axis.cross(edge.radial);
  part.length = to - from;
  return part;
}

BorderCurve::BorderCurve(const brep::CadModel& model, const brep::CadFace& face, const brep::Trim& trim)
    : model_(model), face_(face), forward_(trim.forward), curve_(homogeneous(trim.curve)) {}

nurbs::Parameter<2> BorderCurve::parameters(double t) const {
  const Eigen::VectorXd p = curve_.point(t);
  return {p(0), p(1)};
}

Vector3 BorderCurve::point(double t) const { return point_of(model_, face_, parameters(t)); }

double BorderCurve::beside(const Vector3& point, const Vector3& tangent) const {
  if (face_.shape.kind == brep::Kind::plane && curve_.points.cols() == 2 &&
      curve_.points(2, 0) == curve_.points(2, 1)) {  // a straight line
    const Vector3 from = this->point(curve_.begin()), way = this->point(curve_.end()) - from;
    return at_part(std::clamp(way.dot(point - from) / way.squaredNorm(), 0.0, 1.0));
  }
  const int places = std::clamp<int>(8 * static_cast<int>(curve_.points.cols()), 24, 400);
  int best = 0;
  double least = 1e300;
  for (int k = 0; k <= places; ++k) {
    const double away = (this->point(at_part(static_cast<double>(k) / places)) - point).squaredNorm();
    if (away < least) least = away, best = k;
  }
  const Vector3 along = forward_ ? tangent : Vector3(-tangent);
  return zero_of([&](double t) { return along.dot(this->point(t) - point); },
                 at_part(std::max(best - 1.0, 0.0) / places),
                 at_part(std::min<double>(best + 1.0, places) / places));
}

Vector3 BorderCurve::conormal(double t, const Vector3& tangent) const {
  const Vector3 along = forward_ ? tangent : Vector3(-tangent);
  return normal_of(model_, face_, parameters(t)).cross(along).stableNormalized();
}

brep::Spline<2> part_of(const brep::Spline<2>& curve, double from, double to) {
  brep::Spline<2> part = finished<2>(window(homogeneous(curve), from, to));
  for (int d = 0; d < 2; ++d)
    if ((curve.points.row(d).array() == curve.points(d, 0)).all())
      part.points.row(d).setConstant(curve.points(d, 0));
  return part;
}

}  // namespace geometry_io
