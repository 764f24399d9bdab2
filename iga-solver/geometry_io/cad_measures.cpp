// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry_io/any_spline.h"
#include "geometry_io/golden_section.h"
#include "nurbs/gauss_legendre.h"

namespace geometry_io {
namespace {

using brep::CadEdge;
using brep::CadFace;
using brep::CadModel;
using FaceKind = brep::Kind;
using brep::Vector3;
using nurbs::Parameter;

struct Tangents {
  Vector3 point, along[2];
};

Tangents of_patch(const nurbs::Surface& patch, const Parameter<2>& xi, int derivatives) {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(patch.space, xi, derivatives, basis);
  Tangents t{Vector3::Zero(), {Vector3::Zero(), Vector3::Zero()}};
  for (int a = 0; a < basis.count; ++a) {
    const Vector3 P = patch.control_points.col(basis.control_point[a]);
    t.point += basis.R[a] * P;
    for (int d = 0; d < 2 && derivatives > 0; ++d) t.along[d] += basis.dR[d][a] * P;
  }
  return t;
}

// The lowest of f on [a, b]: the best of some places, then golden sections around it.
template <class F>
double lowest_place(const F& f, double a, double b, int places) {
  int best = 0;
  double lowest = f(a);
  for (int i = 1; i <= places; ++i) {
    const double value = f(a + (b - a) * i / places);
    if (value < lowest) best = i, lowest = value;
  }
  const double low = a + (b - a) * std::max(best - 1, 0) / places,
               high = a + (b - a) * std::min(best + 1, places) / places;
  return golden_section(f, low, high);
}

Parameter<2> parameter_at(const AnySpline& curve, double t) {
  const Eigen::VectorXd p = curve.point(t);
  return {p(0), p(1)};
}

constexpr int kRule = nurbs::kMaxGaussPoints;  // points of Gauss's rule

// Into how many an element is cut for the rule.
int pieces_for(int degree) { return (degree + 2) / 3; }

// Area between xi0 = low and this, for each unit of xi1: the antiderivative of |S_0 x S_1|.
double strip(const CadModel& model, const CadFace& face, const Parameter<2>& xi) {
  const brep::Face& s = face.shape;
  const double width = xi[0] - s.low[0];
  switch (s.kind) {
    case FaceKind::plane:
      return width;
    case FaceKind::cylinder:
      return s.R * width;
    case FaceKind::cone:
      return std::sin(s.r) * xi[1] * width;
    case FaceKind::sphere:
      return s.R * s.R * std::cos(xi[1]) * width;
    case FaceKind::torus:
      return s.r * (s.R + s.r * std::cos(xi[1])) * width;
    default:
      break;
  }
  const nurbs::Surface& patch = model.patches[s.patch];
  const std::vector<double>& breaks = patch.space.knots(0).breaks();
  const auto rule = nurbs::gauss_legendre(kRule);
  double sum = 0.0;
  const int pieces = pieces_for(patch.space.degree(0));
  for (size_t e = 0; e + 1 < breaks.size(); ++e) {
    const double begin = std::max(breaks[e], s.low[0]), end = std::min(breaks[e + 1], xi[0]);
    for (int k = 0; k < pieces && begin < end; ++k) {
      const double half = 0.5 * (end - begin) / pieces, middle = begin + (2 * k + 1) * half;
      for (int i = 0; i < kRule; ++i) {
        const Tangents t = of_patch(patch, {middle + half * rule.points[i], xi[1]}, 1);
        sum += half * rule.weights[i] * t.along[0].cross(t.along[1]).norm();
      }
    }
  }
  return sum;
}

// Parameters of a trim between which it, and the face under it, are smooth.
std::vector<double> smooth_parts(const AnySpline& curve, int pieces) {
  std::vector<double> breaks;
  for (const double t : curve.knots)
    if (breaks.empty() || t > breaks.back()) breaks.push_back(t);
  std::vector<double> parts;
  for (size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < pieces; ++k) parts.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / pieces);
  parts.push_back(breaks.back());
  return parts;
}

// The integral of strip() dxi1 along a trim.
double swept(const CadModel& model, const CadFace& face, const brep::Trim& trim) {
  const auto heights = trim.curve.points.row(1);
  if ((heights.array() == heights(0)).all()) return 0.0;
  const AnySpline curve = homogeneous(trim.curve);
  const auto rule = nurbs::gauss_legendre(kRule);
  const bool patch = face.shape.kind == FaceKind::nurbs;
  int elements = 2;
  if (patch) {
    const nurbs::KnotVector& knots = model.patches[face.shape.patch].space.knots(1);
    elements = knots.element_count() * pieces_for(knots.degree());
  }
  const int spans = std::max<int>(1, static_cast<int>(curve.points.cols()) - curve.degree);
  const int pieces = std::clamp(2 * elements / spans, patch ? 1 : 4, 64);
  const std::vector<double> parts = smooth_parts(curve, pieces);
  double sum = 0.0;
  for (size_t i = 0; i + 1 < parts.size(); ++i) {
    const double middle = 0.5 * (parts[i] + parts[i + 1]), half = 0.5 * (parts[i + 1] - parts[i]);
    for (int k = 0; k < kRule; ++k) {
      const double t = middle + half * rule.points[k], h = 1e-4 * half;
      // dxi1/dt from both sides: of the curve as it is, to h^4.
      const double slope = (8.0 * (parameter_at(curve, t + h)[1] - parameter_at(curve, t - h)[1]) -
                            (parameter_at(curve, t + 2 * h)[1] - parameter_at(curve, t - 2 * h)[1])) /
                           (12.0 * h);
      sum += half * rule.weights[k] * slope * strip(model, face, parameter_at(curve, t));
    }
  }
  return sum;
}

// A trim that runs along an edge.
struct Use {
  const CadFace* face;
  const brep::Trim* trim;
};

class EdgeMeter {
 public:
  EdgeMeter(const CadModel& model, const CadEdge& edge, const std::vector<Use>& uses)
      : model_(model), edge_(edge), uses_(uses) {
    for (const Use& use : uses) curves_.push_back(homogeneous(use.trim->curve));
  }

  EdgeMeasure measure() const {
    constexpr int kPlaces = 7;
    EdgeMeasure worst;
    for (size_t u = 0; u < uses_.size(); ++u)
      for (int i = 0; i < kPlaces; ++i) {
        const double t = place(u, (i + 0.5) / kPlaces);
        const Vector3 p = point(u, t);
        worst.gap = std::max(worst.gap, distance_to(edge_, p));
        if (u > 0 || uses_.size() != 2) continue;
        const auto away = [&](double s) { return (point(1, s) - p).squaredNorm(); };
        const double other = lowest_place(away, curves_[1].begin(), curves_[1].end(), 24);
        const Vector3 a = conormal(0, t), b = conormal(1, other);
        worst.angle = std::max(worst.angle, std::atan2(a.cross(b).norm(), -a.dot(b)));
      }
    worst.kind = uses_.size() < 2                   ? EdgeMeasure::Kind::free
                 : uses_.size() > 2                 ? EdgeMeasure::Kind::many
                 : worst.angle <= kSmoothAngle      ? EdgeMeasure::Kind::smooth
                 : worst.angle <= kNearTangentAngle ? EdgeMeasure::Kind::near_tangent
                                                    : EdgeMeasure::Kind::sharp;
    return worst;
  }

 private:
  double place(size_t use, double part) const {
    return curves_[use].begin() + part * (curves_[use].end() - curves_[use].begin());
  }
  Vector3 point(size_t use, double t) const {
    return point_of(model_, *uses_[use].face, parameter_at(curves_[use], t));
  }
  // In the face, across its border.
  Vector3 conormal(size_t use, double t) const {
    const double begin = curves_[use].begin(), end = curves_[use].end(), h = 1e-5 * (end - begin);
    const Vector3 tangent = point(use, std::min(t + h, end)) - point(use, std::max(t - h, begin));
    return normal_of(model_, *uses_[use].face, parameter_at(curves_[use], t)).cross(tangent).normalized();
  }

  const CadModel& model_;
  const CadEdge& edge_;
  const std::vector<Use>& uses_;
  std::vector<AnySpline> curves_;
};

}  // namespace

Vector3 point_of(const CadModel& model, const CadFace& face, const Parameter<2>& xi) {
  if (face.shape.kind != FaceKind::nurbs) return face.shape.point(xi);
  return of_patch(model.patches[face.shape.patch], xi, 0).point;
}

Vector3 normal_of(const CadModel& model, const CadFace& face, const Parameter<2>& xi) {
  if (face.shape.kind != FaceKind::nurbs) return face.shape.normal(xi);
  const Tangents t = of_patch(model.patches[face.shape.patch], xi, 1);
  return t.along[0].cross(t.along[1]).stableNormalized();
}

double distance_to(const CadEdge& edge, const Vector3& point) {
  const Vector3 d = point - edge.origin;
  if (edge.kind == CadEdge::Kind::line) return (d - edge.axis * edge.axis.dot(d)).norm();
  if (edge.kind == CadEdge::Kind::circle) {
    const double height = edge.axis.dot(d);
    return std::hypot(height, (d - height * edge.axis).norm() - edge.R);
  }
  const AnySpline curve = homogeneous(edge.curve);
  const auto away = [&](double t) { return (curve.point(t) - point).squaredNorm(); };
  const int places = std::clamp<int>(12 * static_cast<int>(curve.points.cols()), 64, 800);
  return std::sqrt(away(lowest_place(away, curve.begin(), curve.end(), places)));
}

double area_of(const CadModel& model, const CadFace& face) {
  double sum = 0.0;
  for (const brep::Loop& loop : face.loops)
    for (const brep::Trim& trim : loop) sum += swept(model, face, trim);
  return sum;
}

std::vector<EdgeMeasure> measured_edges(const CadModel& model) {
  std::vector<std::vector<Use>> uses(model.edges.size());
  for (const CadFace& face : model.faces)
    for (const brep::Loop& loop : face.loops)
      for (const brep::Trim& trim : loop)
        if (trim.edge >= 0) uses[trim.edge].push_back({&face, &trim});
  std::vector<EdgeMeasure> all;
  for (size_t e = 0; e < model.edges.size(); ++e)
    all.push_back(EdgeMeter(model, model.edges[e], uses[e]).measure());
  return all;
}

}  // namespace geometry_io
