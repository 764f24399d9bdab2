// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/closed_form.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace brep {
namespace {

constexpr double kAgreement = 1e-13;  // of the size: round-off of some operations
constexpr int kMostSamples = 33;      // of the points of a patch that are compared, along each direction
constexpr double kQuarterTurn = 0.25 * nurbs::kTwoPi, kAngleRoundOff = 1e-9;

// Parts of a turn from the start that are seen one after the other by less than half a turn.
constexpr int kLooks = 16;

using Plane2 = Eigen::Vector2d;

/// A circle, or a part of one, that a curve runs along from its start.
struct Turn {
  Vector3 centre, axis;  ///< counterclockwise about it
  double radius, angle;
};

// Centre of the circle through three points of a plane.
Vector3 circumcentre(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a, n = u.cross(v);
  return a + (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
}

// Of points along a curve, the first of them its start, the last its end; nothing if they are on a line.
std::optional<Turn> turn_of(const std::vector<Vector3>& points) {
  const size_t last = points.size() - 1;
  const Vector3 &a = points[0], &b = points[last / 3], &c = points[2 * last / 3];
  const Vector3 across = (b - a).cross(c - a);
  if (across.norm() <= 1e-9 * (b - a).norm() * (c - a).norm()) return std::nullopt;
  Turn turn{circumcentre(a, b, c), across.normalized(), 0.0, 0.0};
  turn.radius = (a - turn.centre).norm();
  for (size_t i = 0; i < last; ++i) {
    const Vector3 from = points[i] - turn.centre, to = points[i + 1] - turn.centre;
    turn.angle += std::atan2(turn.axis.dot(from.cross(to)), from.dot(to));
  }
  return turn;
}

int arcs_of(double angle) { return static_cast<int>(std::ceil(angle / kQuarterTurn - kAngleRoundOff)); }

double whole_if_nearly(double angle) {
  return std::abs(angle - nurbs::kTwoPi) <= kAngleRoundOff ? nurbs::kTwoPi : angle;
}

class Recognition {
 public:
  explicit Recognition(const nurbs::Surface& patch) : patch_(patch) {
    for (int k = 0; k < 2; ++k) {
      first_[k] = patch.space.knots(k).front();
      last_[k] = patch.space.knots(k).back();
    }
    const auto& points = patch.control_points;
    size_ = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  }

  std::optional<ClosedForm> result() const {
    for (const std::optional<ClosedForm>& form : {plane(), round()})
      if (form && is_it(*form)) return form;
    return std::nullopt;
  }

 private:
  // S at parts of the two ranges.
  Vector3 at(double s, double t) const {
    return nurbs::interpolate(
        patch_.space, patch_.control_points,
        {first_[0] + s * (last_[0] - first_[0]), first_[1] + t * (last_[1] - first_[1])});
  }
  ChartLine line(int k, double begin, double end, int arcs) const {
    return ChartLine({begin, end}, {first_[k], last_[k]}, arcs);
  }

  std::optional<ClosedForm> plane() const {
    const Vector3 origin = at(0.0, 0.0), u = at(1.0, 0.0) - origin, v = at(0.0, 1.0) - origin;
    const double length = u.norm(), width = v.norm();
    if (!(std::abs(u.dot(v)) <= 1e-12 * length * width) || !(length * width > 0.0)) return std::nullopt;
    Face face;
    face.frame = frame_at(origin, u.cross(v), u);
    face.high = {length, width};
    return ClosedForm{face, {{line(0, 0.0, length, 0), line(1, 0.0, width, 0)}, 1}};
  }

  std::optional<ClosedForm> round() const {
    const auto part = [](int i) { return static_cast<double>(i) / kLooks; };
    std::vector<Vector3> parallel;  // half way along the second direction: away from tips and poles
    for (int i = 0; i <= kLooks; ++i) parallel.push_back(at(part(i), 0.5));
    const std::optional<Turn> turn = turn_of(parallel);
    if (!turn) return std::nullopt;
    const Frame frame = frame_at(turn->centre, turn->axis, parallel[0] - turn->centre);
    const auto meridian = [&](double t) {  // distance from the axis, height along it
      const Vector3 from = at(0.0, t) - frame.origin;
      return Plane2(from.dot(frame.x), from.dot(frame.z));
    };
    const Plane2 start = meridian(0.0), middle = meridian(0.5), end = meridian(1.0);
    const Plane2 way = end - start, half = middle - start;
    const double angle = whole_if_nearly(turn->angle);
    const bool closed = way.norm() <= 1e-9 * half.norm();
    if (!closed && std::abs(way[0] * half[1] - way[1] * half[0]) <= 1e-12 * way.squaredNorm())
      return straight(frame, angle, start, end);
    std::vector<Vector3> points;
    for (int i = 0; i <= kLooks; ++i) {
      const Plane2 point = meridian(part(i));
      points.emplace_back(point[0], 0.0, point[1]);
    }
    const std::optional<Turn> second = turn_of(points);
    // counterclockwise from outside over the top is clockwise about y
    if (!second || second->axis[1] > 0.0) return std::nullopt;
    return bent(frame, angle, *second,
                std::atan2(start[1] - second->centre[2], start[0] - second->centre[0]));
  }

  // Cylinder or cone, from one end of the meridian to the other.
  std::optional<ClosedForm> straight(Frame frame, double angle, const Plane2& start,
                                     const Plane2& end) const {
    const double rise = end[0] - start[0], along = end[1] - start[1], length = std::hypot(rise, along);
    if (std::abs(along) <= 1e-9 * length) return std::nullopt;  // a flat ring
    Face face;
    double azimuth[2] = {0.0, angle}, second[2] = {start[1], end[1]};
    if (std::abs(rise) <= kAgreement * size_) {
      face.kind = Kind::cylinder;
      face.R = 0.5 * (start[0] + end[0]);
      if (face.R <= 0.0) return std::nullopt;
    } else {
      face.kind = Kind::cone;
      face.r = std::atan(std::abs(rise / along));
      frame.origin += (start[1] - along * start[0] / rise) * frame.z;
      const double sine = std::abs(rise) / length;
      second[0] = start[0] / sine, second[1] = end[0] / sine;
      if (rise * along < 0.0) {  // its axis leads from the tip inwards
        frame.z = -frame.z, frame.y = -frame.y;
        azimuth[1] = -angle;
      }
    }
    face.frame = frame;
    for (int k = 0; k < 2; ++k) {
      const double* range = k == 0 ? azimuth : second;
      face.low[k] = std::min(range[0], range[1]);
      face.high[k] = std::max(range[0], range[1]);
    }
    if (face.kind == Kind::cone) face.low[1] = std::max(face.low[1], 0.0);
    // Away from the axis, as the face's, if the meridian rises along the axis that the azimuth turns about.
    const int side = along > 0.0 ? 1 : -1;
    return ClosedForm{
        face, {{line(0, azimuth[0], azimuth[1], arcs_of(angle)), line(1, second[0], second[1], 0)}, side}};
  }

  // Sphere or torus.
  std::optional<ClosedForm> bent(Frame frame, double angle, const Turn& turn, double from) const {
    const double ring = turn.centre[0];
    Face face;
    frame.origin += turn.centre[2] * frame.z;
    face.frame = frame;
    face.kind = std::abs(ring) <= kAgreement * size_ ? Kind::sphere : Kind::torus;
    (face.kind == Kind::sphere ? face.R : face.r) = turn.radius;
    if (face.kind == Kind::torus) face.R = ring;
    if (face.kind == Kind::torus && !(ring > turn.radius)) return std::nullopt;
    const double round = whole_if_nearly(turn.angle);
    face.low = {0.0, from};
    face.high = {angle, from + round};
    return ClosedForm{
        face, {{line(0, 0.0, angle, arcs_of(angle)), line(1, from, from + round, arcs_of(round))}, 1}};
  }

  bool is_it(const ClosedForm& form) const {
    int samples[2];
    for (int k = 0; k < 2; ++k)
      samples[k] = std::min(3 * patch_.space.knots(k).element_count() + 1, kMostSamples);
    for (int i = 0; i < samples[0]; ++i)
      for (int j = 0; j < samples[1]; ++j) {
        const nurbs::Parameter<2> xi = {first_[0] + (last_[0] - first_[0]) * i / (samples[0] - 1),
                                        first_[1] + (last_[1] - first_[1]) * j / (samples[1] - 1)};
        const Vector3 on_patch = nurbs::interpolate(patch_.space, patch_.control_points, xi);
        if (!((on_patch - form.face.point(form.chart.to_face(xi))).norm() <= kAgreement * scale()))
          return false;
      }
    return true;
  }
  // Coordinates have the round-off of the largest of them.
  double scale() const { return std::max(size_, patch_.control_points.cwiseAbs().maxCoeff()); }

  const nurbs::Surface& patch_;
  double first_[2], last_[2], size_;
};

}  // namespace

std::optional<ClosedForm> closed_form(const nurbs::Surface& patch) { return Recognition(patch).result(); }

}  // namespace brep
