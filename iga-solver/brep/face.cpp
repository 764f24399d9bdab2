// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/face.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "brep/angle.h"

namespace brep {
namespace {

// A point in cylindrical coordinates of a frame.
struct Cylindrical {
  double x, y, z, rho;
  Cylindrical(const Frame& frame, const Vector3& d) {
    const Vector3 from = d - frame.origin;
    x = from.dot(frame.x), y = from.dot(frame.y), z = from.dot(frame.z);
    rho = std::sqrt(x * x + y * y);
  }
};

// The turn of an angle that is in the range, or nearest to it; and how far it is outside.
double into_range(double& angle, double low, double high) {
  angle += nurbs::kTwoPi * std::ceil((low - angle) / nurbs::kTwoPi);
  if (angle <= high) return 0.0;
  const double above = angle - high, below = low + nurbs::kTwoPi - angle;
  if (below < above) angle -= nurbs::kTwoPi;
  return std::min(above, below);
}

double out_of(double x, double low, double high) { return std::max({0.0, low - x, x - high}); }

}  // namespace

Frame frame_at(const Vector3& origin, const Vector3& z, const Vector3& x) {
  Frame frame;
  frame.origin = origin;
  frame.z = z.normalized();
  const Vector3 across = x - x.dot(frame.z) * frame.z;
  if (!(z.norm() > 0.0) || !(across.norm() > 1e-12 * x.norm()))
    throw std::invalid_argument("frame: axes z and x that are not zero and not parallel are needed");
  frame.x = across.normalized();
  frame.y = frame.z.cross(frame.x);
  return frame;
}

Vector3 Face::point(const Parameter<2>& xi) const {
  switch (kind) {
    case Kind::plane:
      return frame.origin + xi[0] * frame.x + xi[1] * frame.y;
    case Kind::cylinder:
      return frame.origin + R * radial(xi[0]) + xi[1] * frame.z;
    case Kind::cone:
      return frame.origin + xi[1] * (std::cos(r) * frame.z + std::sin(r) * radial(xi[0]));
    case Kind::sphere:
      return frame.origin + R * (std::cos(xi[1]) * radial(xi[0]) + std::sin(xi[1]) * frame.z);
    case Kind::torus:
      return frame.origin + (R + r * std::cos(xi[1])) * radial(xi[0]) + r * std::sin(xi[1]) * frame.z;
    case Kind::nurbs:
      break;
  }
  return frame.origin;
}

Vector3 Face::normal(const Parameter<2>& xi) const {
  switch (kind) {
    case Kind::plane:
      return frame.z;
    case Kind::cylinder:
      return radial(xi[0]);
    case Kind::cone:
      return std::cos(r) * radial(xi[0]) - std::sin(r) * frame.z;
    case Kind::sphere:
    case Kind::torus:
      return std::cos(xi[1]) * radial(xi[0]) + std::sin(xi[1]) * frame.z;
    case Kind::nurbs:
      break;
  }
  return frame.z;
}

Parameter<2> Face::curvatures(const Parameter<2>& xi) const {
  switch (kind) {
    case Kind::plane:
      return {0.0, 0.0};
    case Kind::cylinder:
      return {-1.0 / R, 0.0};
    case Kind::cone:
      return {-1.0 / (xi[1] * std::tan(r)), 0.0};
    case Kind::sphere:
      return {-1.0 / R, -1.0 / R};
    case Kind::torus:
      return {-std::cos(xi[1]) / (R + r * std::cos(xi[1])), -1.0 / r};
    case Kind::nurbs:
      break;
  }
  return {0.0, 0.0};
}

Projection Face::project(const Vector3& d) const {
  if (kind == Kind::plane) {
    const Vector3 from = d - frame.origin;
    const double height = from.dot(frame.z);
    return {{from.dot(frame.x), from.dot(frame.y)}, d - height * frame.z, frame.z, height, 0.0, false};
  }
  const PolarFoot at = polar_foot(d);
  Projection foot{{angle_of(at.cos[0], at.sin[0]), at.length}, at.point, at.normal, at.height, 0.0, at.many};
  const double turned = into_range(foot.xi[0], low[0], high[0]);
  if (kind == Kind::cylinder || kind == Kind::cone) {
    const double radius = kind == Kind::cylinder ? R : at.length * std::sin(r);
    foot.outside = std::max(radius * turned, out_of(at.length, low[1], high[1]));
    return foot;
  }
  foot.xi[1] = angle_of(at.cos[1], at.sin[1]);
  const double second_turned = into_range(foot.xi[1], low[1], high[1]);
  foot.outside = std::max((ring() + tube() * at.cos[1]) * turned, tube() * second_turned);
  return foot;
}

PolarFoot Face::polar_foot(const Vector3& d) const {
  const Cylindrical at(frame, d);
  PolarFoot foot{};
  foot.many = at.rho <= kOnAxis * (kind == Kind::cone ? std::abs(at.z) : R);
  const double inverse = 1.0 / at.rho;
  foot.cos[0] = foot.many ? std::cos(middle(0)) : inverse * at.x;
  foot.sin[0] = foot.many ? std::sin(middle(0)) : inverse * at.y;
  const Vector3 e = foot.cos[0] * frame.x + foot.sin[0] * frame.y;
  if (kind == Kind::cylinder) {
    foot.length = at.z;
    foot.point = frame.origin + R * e + at.z * frame.z;
    foot.normal = e;
    foot.height = at.rho - R;
    return foot;
  }
  if (kind == Kind::cone) {
    const double cos = std::cos(r), sin = std::sin(r);
    foot.length = at.z * cos + at.rho * sin;
    foot.point = frame.origin + foot.length * (cos * frame.z + sin * e);
    foot.normal = cos * e - sin * frame.z;
    foot.height = at.rho * cos - at.z * sin;
    return foot;
  }
  const double off = at.rho - ring(), from = std::sqrt(off * off + at.z * at.z);
  const bool in_centre = from <= kOnAxis * tube();
  foot.many = foot.many || in_centre;
  foot.cos[1] = in_centre ? std::cos(middle(1)) : off / from;
  foot.sin[1] = in_centre ? std::sin(middle(1)) : at.z / from;
  foot.normal = foot.cos[1] * e + foot.sin[1] * frame.z;
  foot.point = frame.origin + ring() * e + tube() * foot.normal;
  foot.height = from - tube();
  return foot;
}

double Face::distance_of_whole(const Vector3& d) const {
  if (kind == Kind::plane) return std::abs((d - frame.origin).dot(frame.z));
  const Cylindrical at(frame, d);
  switch (kind) {
    case Kind::cylinder:
      return std::abs(at.rho - R);
    case Kind::cone:
      return std::abs(at.rho * std::cos(r) - at.z * std::sin(r));
    case Kind::sphere:
      return std::abs(std::sqrt(at.rho * at.rho + at.z * at.z) - R);
    default:
      return std::abs(std::sqrt((at.rho - R) * (at.rho - R) + at.z * at.z) - r);
  }
}

bool Face::stays(const Vector3& shift, double within) const {
  if (kind == Kind::plane) return std::abs(shift.dot(frame.z)) <= within;
  return kind == Kind::cylinder && shift.cross(frame.z).squaredNorm() <= within * within;
}

// Of a cone, its tip is on the axis.
double Face::distance_of_focus(const Vector3& d) const {
  if (kind == Kind::plane) return std::numeric_limits<double>::infinity();
  const Cylindrical at(frame, d);
  switch (kind) {
    case Kind::cylinder:
    case Kind::cone:
      return at.rho;
    case Kind::sphere:
      return std::sqrt(at.rho * at.rho + at.z * at.z);
    default:
      return std::min(at.rho, std::sqrt((at.rho - R) * (at.rho - R) + at.z * at.z));
  }
}

bool Face::whole_turn(int direction) const {
  const bool angle = kind == Kind::torus || (kind != Kind::plane && direction == 0);
  return angle && high[direction] - low[direction] >= nurbs::kTwoPi * (1.0 - 1e-9);
}

}  // namespace brep
