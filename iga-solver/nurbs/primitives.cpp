// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/primitives.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "nurbs/refinement.h"

namespace nurbs {
namespace {

constexpr double kLeastSine = 1e-9;        // between two directions; below it round-off decides the normal
constexpr double kDegreeRoundOff = 1e-12;  // of a difference of two angles [degree]

std::string shown(const Vector3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

void expect_positive(const char* name, double length) {
  if (!(length > 0.0) || !std::isfinite(length))
    throw std::invalid_argument(fmt::format("{} is {}, expected a number > 0", name, length));
}

// Greville abscissae mapped to [0, 1]: control points placed there make the patch affine (linear precision).
std::vector<double> relative_greville(const KnotVector& knots) {
  std::vector<double> t = knots.greville();
  for (double& abscissa : t) abscissa = (abscissa - knots.front()) / (knots.back() - knots.front());
  return t;
}

Curve segment(const Vector3& from, const Vector3& to, const KnotVector& knots) {
  Curve line{Space<1>({knots}), NodalVectors(3, knots.control_point_count())};
  int a = 0;
  for (double t : relative_greville(knots)) line.control_points.col(a++) = (1.0 - t) * from + t * to;
  return line;
}

// (cos, sin, 0), exact at multiples of 90 degrees: circles close and poles are one point.
Vector3 on_unit_circle(double degrees) {
  const double quarters = std::round(degrees / 90.0);
  const double rest = (degrees - 90.0 * quarters) * (M_PI / 180.0);
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(std::fmod(quarters, 4.0) + 4.0) % 4) {
    case 0:
      return {c, s, 0.0};
    case 1:
      return {-s, c, 0.0};
    case 2:
      return {-c, -s, 0.0};
    default:
      return {s, -c, 0.0};
  }
}

// `arcs` quadratic rational Bezier arcs: joints on the circle, and between them the corners of its tangents.
Curve quadratic_arcs(double from, double to, int arcs) {
  const int last = 2 * arcs;  // control point
  const double w = on_unit_circle((to - from) / last).x();
  std::vector<double> knots{0.0}, weights;
  NodalVectors control_points(3, last + 1);
  for (int i = 0; i <= last; ++i) {
    const bool corner = i % 2 == 1;
    weights.push_back(corner ? w : 1.0);
    control_points.col(i) = on_unit_circle((from * (last - i) + to * i) / last) / weights.back();
    if (!corner) knots.insert(knots.end(), 2, static_cast<double>(i) / last);
  }
  knots.push_back(1.0);
  return {Space<1>({KnotVector(2, std::move(knots))}, std::move(weights)), std::move(control_points)};
}

// The circle of `angle` in the meridian plane about (centre, 0, 0).
Curve meridian_circle(double centre, double radius, const Curve& angle) {
  Curve circle = angle;
  circle.control_points.row(0) = centre + radius * angle.control_points.row(0).array();
  circle.control_points.row(1).setZero();
  circle.control_points.row(2) = radius * angle.control_points.row(1);
  return circle;
}

void check_strips(const std::vector<Strip>& strips, int degree_x) {
  if (strips.empty()) throw std::invalid_argument("no strips, expected one at least");
  if (degree_x < 2)
    throw std::invalid_argument(
        fmt::format("degree along x is {}, expected 2 at least: a ramp is quadratic", degree_x));
  for (size_t i = 0; i < strips.size(); ++i) {
    const auto& [length, thickness, elements] = strips[i];
    const std::string strip = fmt::format("strip {}: ", i + 1);
    expect_positive((strip + "length").c_str(), length);
    for (double t : thickness) expect_positive((strip + "thickness").c_str(), t);
    if (elements < 1)
      throw std::invalid_argument(strip + fmt::format("{} elements, expected 1 at least", elements));
    if (i > 0 && thickness[0] != strips[i - 1].thickness[1])
      throw std::invalid_argument(strip +
                                  fmt::format("begins with thickness {}, expected {}, where strip {} ends",
                                              thickness[0], strips[i - 1].thickness[1], i));
    if (thickness[0] != thickness[1] && elements % 2 == 1)
      throw std::invalid_argument(
          strip +
          fmt::format("{} elements in a ramp, expected an even number: its middle is a knot", elements));
  }
}

// Parameter x / length of the plate.
KnotVector scaled_to_one(int degree, std::vector<double> knots) {
  const double length = knots.back();
  for (double& knot : knots) knot /= length;
  return {degree, std::move(knots)};
}

// Thickness over x, as points (x, 0, t), from x = 0: a quadratic spline that has knots only where two of its
// parabolas meet.  The control point between two knots is where their tangents meet.
Curve thickness_law(const std::vector<Strip>& strips) {
  std::vector<double> knots(3, 0.0);
  std::vector<Vector3> points{{0.0, 0.0, strips.front().thickness[0]}};
  const auto add_parabola = [&](double to, double thickness, double slope) {  // at its beginning
    const double half = 0.5 * (to - knots.back());
    points.emplace_back(knots.back() + half, 0.0, thickness + half * slope);
    knots.push_back(to);
  };
  for (const auto& [length, thickness, elements] : strips) {
    const double begin = knots.back(), rise = thickness[1] - thickness[0];
    if (rise != 0.0) {
      add_parabola(begin + 0.5 * length, thickness[0], 0.0);
      add_parabola(begin + length, thickness[0] + 0.5 * rise, 2.0 * rise / length);
    } else {
      add_parabola(begin + length, thickness[0], 0.0);
    }
  }
  points.emplace_back(knots.back(), 0.0, strips.back().thickness[1]);
  knots.insert(knots.end(), 2, knots.back());
  Curve law{Space<1>({scaled_to_one(2, std::move(knots))}), NodalVectors(3, points.size())};
  for (size_t a = 0; a < points.size(); ++a) law.control_points.col(a) = points[a];
  return law;
}

// Knots between elements that the law does not have yet.
std::vector<double> inner_knots(const std::vector<Strip>& strips) {
  std::vector<double> knots;
  double begin = 0.0;
  for (const auto& [length, thickness, elements] : strips) {
    const bool ramp = thickness[0] != thickness[1];
    for (int i = 1; i < elements; ++i)
      if (!(ramp && 2 * i == elements)) knots.push_back(begin + length * i / elements);
    begin += length;
  }
  for (double& knot : knots) knot /= begin;
  return knots;
}

}  // namespace

Volume box(const Vector3& origin, const Vector3& size, const std::array<KnotVector, 3>& knots) {
  if (!(size.minCoeff() > 0.0))
    throw std::invalid_argument(fmt::format("size is {}, expected 3 numbers > 0", shown(size)));
  Volume volume{Space<3>(knots), {}};
  volume.control_points.resize(3, volume.space.control_point_count());
  const std::vector<double> x = relative_greville(knots[0]), y = relative_greville(knots[1]),
                            z = relative_greville(knots[2]);
  int a = 0;
  for (double tz : z)
    for (double ty : y)
      for (double tx : x) volume.control_points.col(a++) = origin + size.cwiseProduct(Vector3(tx, ty, tz));
  return volume;
}

Volume rolled_plate(const Vector3& origin, double width, const std::vector<Strip>& strips, int degree_x,
                    const std::array<KnotVector, 2>& across_and_through) {
  check_strips(strips, degree_x);
  expect_positive("width", width);
  Curve law = thickness_law(strips);
  if (degree_x > 2) law = elevate_degree(law, 0, degree_x - 2);
  law = insert_knots(law, 0, inner_knots(strips));
  Volume volume{Space<3>({law.space.knots(0), across_and_through[0], across_and_through[1]}), {}};
  volume.control_points.resize(3, volume.space.control_point_count());
  const std::vector<double> y = relative_greville(across_and_through[0]),
                            z = relative_greville(across_and_through[1]);
  int a = 0;
  for (double tz : z)
    for (double ty : y)
      for (const auto& at : law.control_points.colwise())
        volume.control_points.col(a++) = origin + Vector3(at.x(), ty * width, tz * at.z());
  return volume;
}

Surface plane(const Vector3& origin, const Vector3& edge_u, const Vector3& edge_v,
              const std::array<KnotVector, 2>& knots) {
  if (!(edge_u.cross(edge_v).norm() > kLeastSine * edge_u.norm() * edge_v.norm()))
    throw std::invalid_argument(
        fmt::format("edges {} and {} are zero or parallel, expected two different directions", shown(edge_u),
                    shown(edge_v)));
  Surface surface{Space<2>(knots), {}};
  surface.control_points.resize(3, surface.space.control_point_count());
  const std::vector<double> u = relative_greville(knots[0]), v = relative_greville(knots[1]);
  int a = 0;
  for (double tv : v)
    for (double tu : u) surface.control_points.col(a++) = origin + tu * edge_u + tv * edge_v;
  return surface;
}

Frame frame(const Vector3& origin, const Vector3& axis, const Vector3& reference) {
  if (!(axis.stableNorm() > 0.0))
    throw std::invalid_argument(fmt::format("axis is {}, expected a direction", shown(axis)));
  const Vector3 z = axis.stableNormalized();
  const Vector3 towards = reference.stableNormalized();
  const Vector3 y = z.cross(towards);
  if (!(y.norm() > kLeastSine))
    throw std::invalid_argument(fmt::format("reference is {}, expected a direction other than the axis {}",
                                            shown(reference), shown(axis)));
  Frame result{origin, {}};
  result.axes.col(2) = z;
  result.axes.col(1) = y.normalized();
  result.axes.col(0) = result.axes.col(1).cross(z).normalized();
  return result;
}

Frame frame(const Vector3& origin, const Vector3& axis) {
  Eigen::Index largest;
  axis.cwiseAbs().maxCoeff(&largest);
  return frame(origin, axis, Vector3::Unit((largest + 1) % 3));
}

Curve arc(double from, double to) {
  const double sweep = to - from;
  if (!(sweep > 0.0) || !(sweep <= 360.0 + kDegreeRoundOff))
    throw std::invalid_argument(fmt::format(
        "angles are [{}, {}], expected [from, to] in degrees with from < to <= from + 360", from, to));
  const double quarters = std::ceil((sweep - kDegreeRoundOff) / 90.0);
  Curve circle = quadratic_arcs(from, to, std::max(1, static_cast<int>(quarters)));
  const bool whole = sweep >= 360.0 - kDegreeRoundOff;
  if (whole) circle.control_points.rightCols<1>() = circle.control_points.leftCols<1>();
  return circle;
}

Curve refined(const Curve& curve, int elements, int degree) {
  const int own_degree = curve.space.degree(0), own_elements = curve.space.element_count();
  if (degree < own_degree || degree > kMaxDegree)
    throw std::invalid_argument(
        fmt::format("degree is {}, expected {} to {}", degree, own_degree, kMaxDegree));
  if (elements < 1 || elements % own_elements != 0)
    throw std::invalid_argument(fmt::format("{} elements on a curve of {} pieces, expected a multiple of {}",
                                            elements, own_elements, own_elements));
  const std::vector<double>& breaks = curve.space.knots(0).breaks();
  const int parts = elements / own_elements;
  std::vector<double> inner;
  for (int piece = 0; piece < own_elements; ++piece)
    for (int part = 1; part < parts; ++part)
      inner.push_back(breaks[piece] + (breaks[piece + 1] - breaks[piece]) * part / parts);
  return insert_knots(elevate_degree(curve, 0, degree - own_degree), 0, inner);
}

template <int Dim>
Patch<Dim + 1> revolve(const Patch<Dim>& meridian, const Curve& azimuth, const Frame& frame) {
  const auto knots = std::apply(
      [&](const auto&... own) {
        return std::array<KnotVector, Dim + 1>{azimuth.space.knots(0), own...};
      },
      meridian.space.knots());
  const int n = azimuth.space.control_point_count(), m = meridian.space.control_point_count();
  NodalVectors control_points(3, n * m);
  std::vector<double> weights(n * m);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const Vector3 circle = azimuth.control_points.col(i), profile = meridian.control_points.col(j);
      const Vector3 local(profile.x() * circle.x(), profile.x() * circle.y(), profile.z());
      control_points.col(i + n * j) = frame.origin + frame.axes * local;
      weights[i + n * j] = azimuth.space.weight(i) * meridian.space.weight(j);
    }
  return {Space<Dim + 1>(knots, std::move(weights)), std::move(control_points)};
}
template Surface revolve(const Curve&, const Curve&, const Frame&);
template Volume revolve(const Surface&, const Curve&, const Frame&);

Surface cone(const Frame& frame, const std::array<double, 2>& radii, double length, const Curve& azimuth,
             const KnotVector& along) {
  expect_positive("length", length);
  if (!(std::min(radii[0], radii[1]) >= 0.0) || !(std::max(radii[0], radii[1]) > 0.0))
    throw std::invalid_argument(
        fmt::format("radii are [{}, {}], expected numbers >= 0, not both 0", radii[0], radii[1]));
  return revolve(segment({radii[0], 0, 0}, {radii[1], 0, length}, along), azimuth, frame);
}

Surface cylinder(const Frame& frame, double radius, double length, const Curve& azimuth,
                 const KnotVector& along) {
  expect_positive("radius", radius);
  return cone(frame, {radius, radius}, length, azimuth, along);
}

Surface sphere(const Frame& frame, double radius, const Curve& longitude, const Curve& latitude) {
  expect_positive("radius", radius);
  if (latitude.control_points.row(0).minCoeff() < 0.0)
    throw std::invalid_argument("latitude goes over a pole, expected angles from -90 to 90");
  return revolve(meridian_circle(0.0, radius, latitude), longitude, frame);
}

Surface torus(const Frame& frame, double radius, double tube_radius, const Curve& azimuth,
              const Curve& tube_angle) {
  expect_positive("tube_radius", tube_radius);
  if (!(radius > tube_radius) || !std::isfinite(radius))
    throw std::invalid_argument(
        fmt::format("radius is {}, expected more than tube_radius {}", radius, tube_radius));
  return revolve(meridian_circle(radius, tube_radius, tube_angle), azimuth, frame);
}

Volume tube(const Frame& frame, double inner_radius, double outer_radius, double length, const Curve& azimuth,
            const std::array<KnotVector, 2>& along_and_through) {
  expect_positive("inner_radius", inner_radius);
  expect_positive("length", length);
  if (!(outer_radius > inner_radius) || !std::isfinite(outer_radius))
    throw std::invalid_argument(
        fmt::format("outer_radius is {}, expected more than inner_radius {}", outer_radius, inner_radius));
  const Surface section =
      plane({inner_radius, 0, 0}, {0, 0, length}, {outer_radius - inner_radius, 0, 0}, along_and_through);
  return revolve(section, azimuth, frame);
}

}  // namespace nurbs
