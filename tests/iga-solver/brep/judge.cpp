// SPDX-License-Identifier: GPL-2.0-or-later
#include "judge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace brep::trials {
namespace {

constexpr int kDirections = 24;  // looked into, of every triangle

// Labels that spread over pairs until nothing changes.
struct Labels {
  explicit Labels(int count) : label(count) { std::iota(label.begin(), label.end(), 0); }
  void same(int i, int j) {
    const int from = std::max(label[i], label[j]), to = std::min(label[i], label[j]);
    if (from != to) std::replace(label.begin(), label.end(), from, to);
  }
  std::vector<int> label;
};

}  // namespace

Judge::Judge(const Wall& wall, double edge_angle) : wall_(wall), edge_angle_(edge_angle) {
  const int count = static_cast<int>(wall.triangles.size());
  std::map<std::array<int, 2>, std::vector<int>> found;
  of_point_.resize(wall.points.size());
  edges_of_point_.resize(wall.points.size());
  for (int t = 0; t < count; ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = wall.triangles[t][i], b = wall.triangles[t][(i + 1) % 3];
      found[{std::min(a, b), std::max(a, b)}].push_back(t);
      of_point_[a].push_back(t);
    }
  Labels sheets(2 * count), planes(count);
  for (const auto& [ends, triangles] : found) {
    edges_of_point_[ends[0]].push_back(static_cast<int>(edges_.size()));
    edges_of_point_[ends[1]].push_back(static_cast<int>(edges_.size()));
    edges_.push_back(ends);
    of_edge_.push_back(triangles);
    wedges_.push_back(wedges(ends[0], ends[1], triangles));
    for (const Wedge& w : wedges_.back()) {
      if (w.angle > nurbs::kPi - edge_angle) sheets.same(w.from, w.to);
      if (triangles.size() == 2 && std::abs(w.angle - nurbs::kPi) < 1e-7) planes.same(w.from / 2, w.to / 2);
    }
  }
  sheets_ = sheets.label;
  planes_ = planes.label;
}

std::vector<Judge::Wedge> Judge::wedges(int a, int b, const std::vector<int>& triangles) const {
  const Vector3 axis = (wall_.points[b] - wall_.points[a]).normalized();
  struct At {
    double angle;
    int ahead, behind;  // sides
  };
  std::vector<At> at;
  Vector3 u = Vector3::Zero();
  for (const int t : triangles) {
    Vector3 m = Vector3::Zero();
    for (const int p : wall_.triangles[t])
      if (p != a && p != b) m = wall_.points[p] - wall_.points[a];
    m = (m - m.dot(axis) * axis).normalized();
    if (at.empty()) u = m;
    const Vector3 n = (point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 0));
    const bool up = n.dot(axis.cross(m)) > 0.0;
    double angle = std::atan2(m.dot(axis.cross(u)), m.dot(u));
    if (angle < 0.0) angle += 2.0 * nurbs::kPi;
    at.push_back({angle, 2 * t + (up ? 0 : 1), 2 * t + (up ? 1 : 0)});
  }
  std::sort(at.begin(), at.end(), [](const At& x, const At& y) { return x.angle < y.angle; });
  std::vector<Wedge> found;
  for (size_t k = 0; k < at.size(); ++k) {
    const At& next = at[(k + 1) % at.size()];
    found.push_back(
        {at[k].ahead, next.behind, next.angle - at[k].angle + (k + 1 == at.size() ? 2.0 * nurbs::kPi : 0.0)});
  }
  return found;
}

namespace {

// Directions into a triangle from a point of it, and a test whether one leads into it.
struct Into {
  std::vector<Vector3> directions;
  Vector3 normal, first, second;
  bool half = false;  // of all directions in the plane: p is on a side

  Into(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    normal = (b - a).cross(c - a).normalized();
    const Vector3 corner[3] = {a, b, c};
    std::vector<int> here;  // sides on which p is
    for (int i = 0; i < 3; ++i) {
      const Vector3 way = (corner[(i + 1) % 3] - corner[i]).normalized();
      if (std::abs(normal.cross(way).dot(p - corner[i])) < 1e-11) here.push_back(i);
    }
    if (here.size() == 1) {
      half = true;
      first = (corner[(here[0] + 1) % 3] - corner[here[0]]).normalized();
      second = normal.cross(first);
    }
    for (int i = 0; i < 3; ++i)
      if ((corner[i] - p).norm() < 1e-10) {
        half = false;
        first = (corner[(i + 1) % 3] - p).normalized();
        second = (corner[(i + 2) % 3] - p).normalized();
      }
    for (int k = 0; k <= kDirections; ++k) {
      const double s = static_cast<double>(k) / kDirections, angle = nurbs::kPi * s;
      if (half && (k == 0 || k == kDirections)) continue;  // along the side p is the nearest, never by more
      if (half)
        directions.emplace_back(std::cos(angle) * first + std::sin(angle) * second);
      else
        directions.emplace_back(((1.0 - s) * first + s * second).normalized());
    }
  }
  double width() const { return half ? 1.0 : first.cross(second).norm(); }
  // x is in the plane.
  bool leads_in(const Vector3& x) const {
    if (half) return x.dot(second) >= -1e-9;
    return normal.dot(first.cross(x)) >= -1e-9 && normal.dot(x.cross(second)) >= -1e-9;
  }
};

}  // namespace

std::vector<int> Judge::edges_through(const Vector3& p, const std::vector<int>& triangles) const {
  const std::set<int> given(triangles.begin(), triangles.end());
  const auto is_given = [&](int t) { return given.count(t) != 0; };
  std::set<int> through;
  for (const int t : triangles)
    for (const int corner : wall_.triangles[t])
      for (const int e : edges_of_point_[corner]) {
        const Vector3 &a = wall_.points[edges_[e][0]], &b = wall_.points[edges_[e][1]];
        if ((b - a).normalized().cross(p - a).norm() < 1e-11 &&
            (p - a).norm() + (p - b).norm() < (b - a).norm() + 1e-10 &&
            // Next to a corner other edges of it are as near; p is on the one whose triangles are given.
            std::all_of(of_edge_[e].begin(), of_edge_[e].end(), is_given))
          through.insert(e);
      }
  return {through.begin(), through.end()};
}

std::vector<Judge::Wedge> Judge::wedges_at(const Vector3& p) const {
  std::vector<int> all(wall_.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Wedge> found;
  for (const int e : edges_through(p, all)) found.insert(found.end(), wedges_[e].begin(), wedges_[e].end());
  return found;
}

void Judge::add_at(const Vector3& p, const std::vector<int>& triangles, const Vector3& d, double reach,
                   double tolerance, std::vector<Minimum>& found) const {
  const double distance = (d - p).norm();
  if (distance >= reach) return;
  for (const std::vector<int>& sides : minima_at(p, triangles, d, tolerance)) {
    found.push_back({sheets_[sides.front()], p, distance, {}});
    for (const int side : sides) found.back().triangles.push_back(side / 2);
  }
}

std::vector<std::vector<int>> Judge::minima_at(const Vector3& p, const std::vector<int>& triangles,
                                               const Vector3& d, double tolerance) const {
  const Vector3 w = d - p;
  std::vector<std::vector<int>> found;
  const int count = static_cast<int>(triangles.size());
  const auto place = [&](int t) {
    return static_cast<int>(std::find(triangles.begin(), triangles.end(), t) - triangles.begin());
  };
  std::vector<Into> into;
  for (const int t : triangles) into.emplace_back(p, point(t, 0), point(t, 1), point(t, 2));

  // What hangs together round p.
  Labels fans(count), regions(2 * count), groups(2 * count);
  for (const int e : edges_through(p, triangles))
    for (const Wedge& wedge : wedges_[e]) {
      const int from = place(wedge.from / 2), to = place(wedge.to / 2);
      fans.same(from, to);
      regions.same(2 * from + wedge.from % 2, 2 * to + wedge.to % 2);
      if (wedge.angle > nurbs::kPi - edge_angle_)
        groups.same(2 * from + wedge.from % 2, 2 * to + wedge.to % 2);
    }

  for (int fan = 0; fan < count; ++fan) {
    if (fans.label[fan] != fan) continue;
    // In which region is w: what is met first on the way to a direction inside a triangle of the fan.
    int widest = fan;  // of which a direction is told inside for certain
    for (int k = fan; k < count; ++k)
      if (fans.label[k] == fan && into[k].width() > into[widest].width()) widest = k;
    const std::vector<Vector3>& directions = into[widest].directions;
    const Vector3 target = directions[directions.size() / 2], start = w.normalized();
    Vector3 onward = target - target.dot(start) * start;
    if (onward.norm() < 1e-12) onward = start.unitOrthogonal();
    onward.normalize();
    double first = 1e9;
    int node = -1;
    for (int k = 0; k < count; ++k) {
      if (fans.label[k] != fan) continue;
      double angle = std::atan2(-into[k].normal.dot(start), into[k].normal.dot(onward));
      for (const double turn : {0.0, nurbs::kPi, 2.0 * nurbs::kPi}) {
        const double at = angle + turn;
        if (at < 0.0 || at >= first) continue;
        if (!into[k].leads_in(std::cos(at) * start + std::sin(at) * onward)) continue;
        first = at;
        node = 2 * k + (into[k].normal.dot(start) >= 0.0 ? 0 : 1);
      }
    }
    if (node < 0) continue;
    for (int g = 0; g < 2 * count; ++g) {
      if (groups.label[g] != g || regions.label[g] != regions.label[node]) continue;
      double steepest = -1e9;
      for (int k = 0; k < 2 * count; ++k)
        if (groups.label[k] == g)
          for (const Vector3& direction : into[k / 2].directions)
            steepest = std::max(steepest, w.dot(direction));
      if (steepest > tolerance) continue;
      found.emplace_back();
      for (int k = g; k < 2 * count; ++k)
        if (groups.label[k] == g) found.back().push_back(2 * triangles[k / 2] + k % 2);
    }
  }
  return found;
}

std::vector<Minimum> Judge::minima(const Vector3& d, double reach, double tolerance,
                                   const std::vector<Vector3>& /*also*/) const {
  std::vector<Minimum> all;
  for (size_t t = 0; t < wall_.triangles.size(); ++t) {
    const Vector3 a = point(t, 0), b = point(t, 1), c = point(t, 2), n = (b - a).cross(c - a).normalized();
    const Vector3 p = d - n.dot(d - a) * n;
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      const Vector3 way = (point(t, i + 1) - point(t, i)).normalized();
      least = std::min(least, n.cross(way).dot(p - point(t, i)));
    }
    const int side = n.dot(d - a) >= 0.0 ? 0 : 1;
    if (least > -tolerance && (d - p).norm() < reach)
      all.push_back({sheet(static_cast<int>(t), side), p, (d - p).norm(), {static_cast<int>(t)}});
  }
  for (size_t e = 0; e < edges_.size(); ++e) {
    const Vector3 &a = wall_.points[edges_[e][0]], &b = wall_.points[edges_[e][1]];
    const double s = (d - a).dot(b - a) / (b - a).squaredNorm();
    if (s > 1e-10 && s < 1.0 - 1e-10) add_at(a + s * (b - a), of_edge_[e], d, reach, tolerance, all);
  }
  for (size_t v = 0; v < wall_.points.size(); ++v)
    add_at(wall_.points[v], of_point_[v], d, reach, tolerance, all);

  std::sort(all.begin(), all.end(),
            [](const Minimum& x, const Minimum& y) { return x.distance < y.distance; });
  std::vector<Minimum> once, kept;
  for (const Minimum& m : all)
    if (std::none_of(once.begin(), once.end(), [&](const Minimum& o) {
          return o.sheet == m.sheet && (o.point - m.point).norm() < 1e-7;
        }))
      once.push_back(m);
  for (size_t i = 0; i < once.size(); ++i) {
    bool alone = true;
    for (size_t j = 0; j < i; ++j) {
      const Vector3 x = (d - once[i].point).normalized(), y = (d - once[j].point).normalized();
      const double apart = std::asin(std::min(1.0, x.cross(y).norm()));
      if (once[i].sheet == once[j].sheet && x.dot(y) > 0.0 && apart < edge_angle_)
        alone = alone && !over_smooth_edges(once[i], once[j], apart);
    }
    if (alone) kept.push_back(once[i]);
  }
  return kept;
}

// By a way with a slightly concave edge in it, by 0.01 of the angle between the two at least; two feet on
// parts of one plane are two.
bool Judge::over_smooth_edges(const Minimum& a, const Minimum& b, double apart) const {
  const double bend = std::max(1e-7, 0.01 * apart);
  std::set<int> seen[2], goal;  // without and with such an edge behind
  for (const int t : a.triangles) seen[0].insert(planes_[t]);
  for (const int t : b.triangles) goal.insert(planes_[t]);
  for (const int plane : goal)
    if (seen[0].count(plane) > 0) return false;
  for (size_t before = 0; before != seen[0].size() + seen[1].size();) {
    before = seen[0].size() + seen[1].size();
    for (const auto& wedges : wedges_)
      for (const Wedge& w : wedges)
        for (int behind = 0; behind < 2 && std::abs(w.angle - nurbs::kPi) <= edge_angle_; ++behind) {
          const int x = planes_[w.from / 2], y = planes_[w.to / 2],
                    after = w.angle < nurbs::kPi - bend ? 1 : behind;
          if (seen[behind].count(x) > 0) seen[after].insert(y);
          if (seen[behind].count(y) > 0) seen[after].insert(x);
        }
  }
  return std::any_of(goal.begin(), goal.end(), [&](int plane) { return seen[1].count(plane) > 0; });
}

bool AnyJudge::lasts(const Vector3& d, double reach, const Minimum& minimum, double by) const {
  std::mt19937 random(1);
  for (int k = 0; k < 10; ++k) {
    const auto moved = minima(d + by * random_direction(random), reach - 2.0 * by, -1e-9);
    if (std::none_of(moved.begin(), moved.end(), [&](const Minimum& m) {
          return m.sheet == minimum.sheet && (m.point - minimum.point).norm() < 3.0 * by;
        }))
      return false;
  }
  return true;
}

}  // namespace brep::trials
