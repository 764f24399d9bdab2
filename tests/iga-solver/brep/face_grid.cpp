// SPDX-License-Identifier: GPL-2.0-or-later
#include "face_grid.h"

#include <algorithm>
#include <cmath>

#include "nurbs/types.h"

namespace brep::trials {

Face face_of(Kind kind, const Frame& frame, double R, double r, Parameter<2> low, Parameter<2> high) {
  Face face;
  face.kind = kind;
  face.frame = frame;
  face.R = R, face.r = r;
  face.low = low, face.high = high;
  return face;
}

Vector3 point_on(const Face& face, double a, double b) {
  const Frame& f = face.frame;
  const Vector3 e = std::cos(a) * f.x + std::sin(a) * f.y;
  switch (face.kind) {
    case Kind::plane:
      return f.origin + a * f.x + b * f.y;
    case Kind::cylinder:
      return f.origin + face.R * e + b * f.z;
    case Kind::cone:
      return f.origin + b * (std::cos(face.r) * f.z + std::sin(face.r) * e);
    case Kind::sphere:
      return f.origin + face.R * (std::cos(b) * e + std::sin(b) * f.z);
    default:
      return f.origin + (face.R + face.r * std::cos(b)) * e + face.r * std::sin(b) * f.z;
  }
}

std::pair<Vector3, Vector3> tangents_on(const Face& face, const Parameter<2>& xi) {
  const Frame& f = face.frame;
  const Vector3 e = std::cos(xi[0]) * f.x + std::sin(xi[0]) * f.y,
                round = -std::sin(xi[0]) * f.x + std::cos(xi[0]) * f.y;
  switch (face.kind) {
    case Kind::plane:
      return {f.x, f.y};
    case Kind::cylinder:
      return {round, f.z};
    case Kind::cone:
      return {round, std::cos(face.r) * f.z + std::sin(face.r) * e};
    default:
      return {round, -std::sin(xi[1]) * e + std::cos(xi[1]) * f.z};
  }
}

Parameter<2> nearest_parameters(const Face& face, const Vector3& p) {
  const Vector3 from = p - face.frame.origin;
  const double x = from.dot(face.frame.x), y = from.dot(face.frame.y), z = from.dot(face.frame.z),
               rho = std::hypot(x, y);
  const auto angle = [&](int i, double value) {
    value -= 2.0 * nurbs::kPi * std::floor((value - face.low[i]) / (2.0 * nurbs::kPi));
    const double beyond = value - face.high[i];
    return beyond > face.low[i] + 2.0 * nurbs::kPi - value ? face.low[i] : std::min(value, face.high[i]);
  };
  const auto length = [&](int i, double value) { return std::clamp(value, face.low[i], face.high[i]); };
  if (face.kind == Kind::plane) return {length(0, x), length(1, y)};
  const double round = angle(0, std::atan2(y, x));
  switch (face.kind) {
    case Kind::cylinder:
      return {round, length(1, z)};
    case Kind::cone:
      return {round, length(1, std::cos(face.r) * z + std::sin(face.r) * rho)};
    case Kind::sphere:
      return {round, length(1, std::atan2(z, rho))};
    default:
      return {round, angle(1, std::atan2(z, rho - face.R))};
  }
}

Grid::Grid(const Face& face) : face_(face) {
  for (int i = 0; i < 2; ++i)
    turn_[i] = face.high[i] - face.low[i] > 2.0 * nurbs::kPi - 1e-6 && (i == 0 || face.kind == Kind::torus) &&
               face.kind != Kind::plane;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      points_.push_back(at({step(0, i), step(1, j)}));
      for (const int before : {i > 0 ? 1 : 0, j > 0 ? n + 1 : 0})
        cell_ = std::max(cell_, (points_.back() - points_[points_.size() - 1 - before]).norm());
    }
}

std::vector<Grid::Lowest> Grid::minima(const Vector3& d, double reach) const {
  std::vector<double> value;
  for (const Vector3& point : points_) value.push_back((point - d).norm());
  std::vector<Lowest> found;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      bool lowest = value[i + (n + 1) * j] < reach + 2.0 * cell_;
      for (int k = 0; k < 9 && lowest; ++k) {
        const int p = next(0, i + k % 3 - 1), q = next(1, j + k / 3 - 1);
        if (p >= 0 && q >= 0 && !(j == q && pole(j)))
          lowest = lowest && value[i + (n + 1) * j] <= value[p + (n + 1) * q];
      }
      int angle = i;  // at a pole the one at which it goes down if it does
      for (int p = 0; lowest && p <= n && pole(j); ++p) {
        const int row = (n + 1) * (j == 0 ? 1 : n - 1);
        lowest = lowest && value[i + (n + 1) * j] <= value[p + row];
        if (value[p + row] < value[angle + row]) angle = p;
      }
      if (!lowest) continue;
      const Lowest x = descend(d, {step(0, angle), step(1, j)}, 1.0 / n);
      if (is_stationary(d, x.xi) && (x.point - d).norm() < reach &&
          std::none_of(found.begin(), found.end(),
                       [&](const Lowest& y) { return (x.point - y.point).norm() < 1e-4; }))
        found.push_back(x);
    }
  return found;
}

// Where all of a side is one point.
bool Grid::pole(int j) const {
  return (j == 0 || j == n) && (at({step(0, 0), step(1, j)}) - at({step(0, 1), step(1, j)})).norm() < 1e-12;
}

int Grid::next(int i, int k) const {
  if (turn_[i]) return (k + n) % n;
  return k < 0 || k > n ? -1 : k;
}

Parameter<2> Grid::beside(const Parameter<2>& xi, int k, double share) const {
  Parameter<2> to = xi;
  for (int i = 0; i < 2; ++i) {
    to[i] += ((i == 0 ? k % 3 : k / 3) - 1) * share * (face_.high[i] - face_.low[i]);
    if (!turn_[i]) to[i] = std::clamp(to[i], face_.low[i], face_.high[i]);
  }
  return to;
}

bool Grid::is_lowest_around(const Vector3& d, const Parameter<2>& xi) const {
  constexpr double kBeside = 1e-4, kRoundOff = 1e-14;
  const double here = (at(xi) - d).norm();
  for (int k = 0; k < 9; ++k)
    if ((at(beside(xi, k, kBeside)) - d).norm() < here - kRoundOff) return false;
  return true;
}

// Near poles the way downhill may end too early.
bool Grid::is_stationary(const Vector3& d, const Parameter<2>& xi) const {
  const Vector3 w = (d - at(xi)).normalized();
  const auto [t0, t1] = tangents_on(face_, xi);
  const bool at_pole = face_.kind == Kind::sphere && std::cos(xi[1]) < 1e-9;
  for (int i = at_pole ? 1 : 0; i < 2; ++i) {
    const double slope = w.dot(i == 0 ? t0 : t1);
    const bool low = !turn_[i] && xi[i] == face_.low[i], high = !turn_[i] && xi[i] == face_.high[i];
    if ((slope > 1e-6 && !high) || (slope < -1e-6 && !low)) return false;
  }
  return true;
}

Grid::Lowest Grid::descend(const Vector3& d, Parameter<2> xi, double size) const {
  double best = (at(xi) - d).norm();
  for (int step = 0; size > 1e-10 && step < 5000; ++step) {
    bool lower = false;
    for (int k = 0; k < 9 && !lower; ++k) {
      const Parameter<2> to = beside(xi, k, size);
      const double value = (at(to) - d).norm();
      lower = value < best;
      if (lower) best = value, xi = to;
    }
    if (!lower) size *= 0.5;
  }
  return {at(xi), xi};
}

}  // namespace brep::trials
