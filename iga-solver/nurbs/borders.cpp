// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/borders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "nurbs/point_grid.h"

namespace nurbs {
namespace {

constexpr double kSameKnot = 1e-9;  // relative parameters closer than this are one knot
constexpr double kNoNormal = 1e-9;  // a normal this much shorter than the longest one is none

struct EdgePoint {
  Vector3 S;
  Vector3 outward;  // derivative across the edge, out of the patch [length / parameter]
  Vector3 normal;   // dS/dxi x dS/deta
};

// An edge as a curve of the relative parameter t, 0 to 1 along the patch's own direction.
class Edge {
 public:
  Edge(const Surface& surface, int side)
      : surface_(&surface),
        across_(side / 2),
        upper_(side % 2 == 1),
        knots_(&surface.space.knots(1 - across_)) {}

  int degree() const { return knots_->degree(); }

  std::vector<double> breaks() const {
    std::vector<double> relative = knots_->breaks();
    for (double& t : relative) t = (t - knots_->front()) / (knots_->back() - knots_->front());
    return relative;
  }

  /// The point at t; `within` lies inside the knot span from which derivatives are taken.
  EdgePoint at(double t, double within) const {
    const int along = 1 - across_;
    const KnotVector& cross = surface_->space.knots(across_);
    Parameter<2> xi;
    xi[along] = absolute(t);
    xi[across_] = upper_ ? cross.back() : cross.front();
    Parameter<2> in_element = xi;
    in_element[along] = absolute(within);
    RationalBasis<2> basis;
    evaluate_on_element(surface_->space, surface_->space.element_at(in_element), xi, 1, basis);
    EdgePoint point{interpolate(basis, surface_->control_points), {}, {}};
    Vector3 S_d[2] = {Vector3::Zero(), Vector3::Zero()};
    for (int d = 0; d < 2; ++d)
      for (int a = 0; a < basis.count; ++a)
        S_d[d] += basis.dR[d][a] * surface_->control_points.col(basis.control_point[a]);
    point.outward = upper_ ? S_d[across_] : Vector3(-S_d[across_]);
    point.normal = S_d[0].cross(S_d[1]);
    return point;
  }

  Vector3 control_point(int i) const {
    const int n_xi = surface_->space.control_point_count(0), n_eta = surface_->space.control_point_count(1);
    return surface_->control_points.col(across_ == 0 ? (upper_ ? n_xi - 1 : 0) + n_xi * i
                                                     : i + n_xi * (upper_ ? n_eta - 1 : 0));
  }
  Vector3 end(bool last) const { return control_point(last ? knots_->control_point_count() - 1 : 0); }

  // A curve with positive weights is one point only if its control points are.
  bool is_pole(double tolerance) const {
    for (int i = 1; i < knots_->control_point_count(); ++i)
      if ((control_point(i) - control_point(0)).norm() > tolerance) return false;
    return true;
  }

 private:
  double absolute(double t) const { return knots_->front() + t * (knots_->back() - knots_->front()); }

  const Surface* surface_;
  int across_;
  bool upper_;
  const KnotVector* knots_;
};

bool ends_meet(const Edge& a, const Edge& b, const Vector3& translation, bool reversed, double tolerance) {
  return (a.end(false) - b.end(reversed) - translation).norm() <= tolerance &&
         (a.end(true) - b.end(!reversed) - translation).norm() <= tolerance;
}

// Breaks of both edges in the parameter of the first.
std::vector<double> common_breaks(const Edge& a, const Edge& b, bool reversed) {
  std::vector<double> breaks = a.breaks();
  for (double t : b.breaks()) breaks.push_back(reversed ? 1.0 - t : t);
  std::sort(breaks.begin(), breaks.end());
  const auto same = [](double t, double u) { return u - t < kSameKnot; };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
  return breaks;
}

struct PointPair {
  EdgePoint a, b;
};

// Points of both edges, or nothing where the edges part.  Between two knots, rational curves of degrees p and
// q are the same if they meet in p + q + 1 points: their difference times the denominators has degree p + q.
std::optional<std::vector<PointPair>> common_points(const Edge& a, const Edge& b, const Vector3& translation,
                                                    bool reversed, double tolerance) {
  if (!ends_meet(a, b, translation, reversed, tolerance)) return std::nullopt;
  const auto mirrored = [reversed](double t) { return reversed ? 1.0 - t : t; };
  const std::vector<double> breaks = common_breaks(a, b, reversed);
  const int intervals = a.degree() + b.degree();
  std::vector<PointPair> points;
  for (size_t e = 0; e + 1 < breaks.size(); ++e) {
    const double middle = 0.5 * (breaks[e] + breaks[e + 1]);
    for (int i = 0; i <= intervals; ++i) {
      const double t = breaks[e] + (breaks[e + 1] - breaks[e]) * i / intervals;
      points.push_back({a.at(t, middle), b.at(mirrored(t), mirrored(middle))});
      if ((points.back().a.S - points.back().b.S - translation).norm() > tolerance) return std::nullopt;
    }
  }
  return points;
}

double largest_angle(const std::vector<PointPair>& points, bool same_side) {
  double longest[2] = {0.0, 0.0};
  for (const PointPair& p : points) {
    longest[0] = std::max(longest[0], p.a.normal.norm());
    longest[1] = std::max(longest[1], p.b.normal.norm());
  }
  double largest = 0.0;
  for (const PointPair& p : points) {
    if (p.a.normal.norm() <= kNoNormal * longest[0] || p.b.normal.norm() <= kNoNormal * longest[1]) continue;
    const Vector3 n = p.a.normal.normalized(), m = (same_side ? 1.0 : -1.0) * p.b.normal.normalized();
    largest = std::max(largest, std::atan2(n.cross(m).norm(), n.dot(m)));
  }
  return largest;
}

// Of -outward of b against c * outward of a, c >= 0 by least squares.
double largest_jump(const std::vector<PointPair>& points) {
  double product = 0.0, square = 0.0, largest = 0.0, jump = 0.0;
  for (const PointPair& p : points) {
    product -= p.a.outward.dot(p.b.outward);
    square += p.a.outward.squaredNorm();
  }
  const double c = square > 0.0 ? std::max(product / square, 0.0) : 0.0;
  for (const PointPair& p : points) {
    jump = std::max(jump, (p.b.outward + c * p.a.outward).norm());
    largest = std::max(largest, p.b.outward.norm());
  }
  return largest > 0.0 ? jump / largest : 0.0;
}

struct Match {
  int patch, side;
  Border border;  // of that edge
};

double diagonal(const std::vector<Surface>& patches) {
  Eigen::AlignedBox3d box;
  for (const Surface& patch : patches)
    for (Eigen::Index a = 0; a < patch.control_points.cols(); ++a) box.extend(patch.control_points.col(a));
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<Border> weld(const Edge& a, int side, const Edge& b, int other_patch, int other_side,
                           const Vector3& translation, double tolerance) {
  for (const bool reversed : {false, true}) {
    const auto points = common_points(a, b, translation, reversed, tolerance);
    if (!points) continue;
    Border border{Border::welded, other_patch, other_side, reversed};
    border.translation = translation;
    border.max_angle = largest_angle(*points, same_orientation(side, border));
    border.max_jump = largest_jump(*points);
    return border;
  }
  return std::nullopt;
}

/// Two edges that may be one curve, the second moved.
struct Candidate {
  int edge, other, translation;
  bool operator<(const Candidate& c) const {
    return std::tie(edge, other, translation) < std::tie(c.edge, c.other, c.translation);
  }
};

// Edges of one parametrisation have their middles in common, whatever their directions.
std::vector<Candidate> candidates(const std::vector<Edge>& edges, const Borders& borders,
                                  const std::vector<Vector3>& translations, double tolerance) {
  constexpr double kWide = 100.0;  // what coincides in some points may be apart by more in between
  std::vector<Candidate> found;
  if (!(tolerance > 0.0)) return found;
  PointGrid middles(kWide * tolerance, edges.size());
  const auto is_pole = [&](int edge) {
    return borders[edge / kSideCount][edge % kSideCount].kind == Border::pole;
  };
  for (int f = static_cast<int>(edges.size()) - 1; f >= 0; --f) {
    if (is_pole(f)) continue;
    const Vector3 middle = edges[f].at(0.5, 0.5).S;
    for (int t = 0; t < static_cast<int>(translations.size()); ++t)
      middles.for_each_near(middle - translations[t], [&](int later) { found.push_back({f, later, t}); });
    middles.add(f, middle);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

const char* side_name(int side) {
  constexpr const char* kNames[kSideCount] = {"xi-", "xi+", "eta-", "eta+"};
  return kNames[side];
}

std::vector<int> side_control_points(const Space<2>& patch, int side) {
  const int n_xi = patch.control_point_count(0), n_eta = patch.control_point_count(1);
  const bool upper = side % 2 == 1;
  std::vector<int> points;
  if (side < 2)
    for (int j = 0; j < n_eta; ++j) points.push_back((upper ? n_xi - 1 : 0) + n_xi * j);
  else
    for (int i = 0; i < n_xi; ++i) points.push_back(i + (upper ? n_xi * (n_eta - 1) : 0));
  return points;
}

bool same_orientation(int side, const Border& border) {
  // Along eta- and xi+ the patch lies to the left, seen from its normal.
  const auto on_the_left = [](int s) { return s == 1 || s == 2; };
  return (on_the_left(side) == on_the_left(border.side)) == border.reversed;
}

double kink_at(const Surface& surface, int direction, double knot) {
  const KnotVector &across = surface.space.knots(direction), &along = surface.space.knots(1 - direction);
  double largest = 0.0;
  const auto look_at = [&](int element, double at) {
    Vector3 normal[2];
    for (const int after : {0, 1}) {
      Parameter<2> xi;
      Indices<2> e;
      xi[direction] = knot, xi[1 - direction] = at;
      e[direction] = across.element_at(knot) - 1 + after, e[1 - direction] = element;
      RationalBasis<2> basis;
      evaluate_on_element(surface.space, surface.space.element_index(e), xi, 1, basis);
      Vector3 S_d[2] = {Vector3::Zero(), Vector3::Zero()};
      for (int d = 0; d < 2; ++d)
        for (int a = 0; a < basis.count; ++a)
          S_d[d] += basis.dR[d][a] * surface.control_points.col(basis.control_point[a]);
      normal[after] = S_d[0].cross(S_d[1]);
      if (!(normal[after].norm() > kNoNormal * S_d[0].norm() * S_d[1].norm())) return;
    }
    largest = std::max(largest, std::atan2(normal[0].cross(normal[1]).norm(), normal[0].dot(normal[1])));
  };
  for (int e = 0; e < along.element_count(); ++e)
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      look_at(e, along.breaks()[e] + t * (along.breaks()[e + 1] - along.breaks()[e]));
  return largest;
}

double largest_kink(const Surface& surface, int direction) {
  const std::vector<double>& creases = surface.space.knots(direction).creases();
  double largest = 0.0;
  for (size_t c = 1; c + 1 < creases.size(); ++c)
    largest = std::max(largest, kink_at(surface, direction, creases[c]));
  return largest;
}

std::vector<std::array<SideCurve, kSideCount>> curves_of_sides(const std::vector<Surface>& patches,
                                                               double relative_tolerance) {
  const double tolerance = relative_tolerance * diagonal(patches);
  std::vector<Edge> edges;
  for (const Surface& patch : patches)
    for (int side = 0; side < kSideCount; ++side) edges.emplace_back(patch, side);
  Borders poles(patches.size());
  std::vector<std::array<SideCurve, kSideCount>> curves(patches.size());
  const auto curve_of = [&](int edge) -> SideCurve& { return curves[edge / kSideCount][edge % kSideCount]; };
  for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
    curve_of(e).first = e;
    if (edges[e].is_pole(tolerance)) poles[e / kSideCount][e % kSideCount].kind = Border::pole;
  }
  const Vector3 in_place = Vector3::Zero();
  for (const Candidate& c : candidates(edges, poles, {in_place}, tolerance)) {
    SideCurve& other = curve_of(c.other);
    if (other.first != c.other) continue;
    for (const bool reversed : {false, true})
      if (common_points(edges[c.edge], edges[c.other], in_place, reversed, tolerance)) {
        other = {curve_of(c.edge).first, curve_of(c.edge).reversed != reversed};
        break;
      }
  }
  return curves;
}

Borders find_borders(const std::vector<Surface>& patches, double relative_tolerance,
                     const std::vector<Vector3>& periods, const MayWeld& may_weld) {
  std::vector<Vector3> translations = {Vector3::Zero()};
  for (const Vector3& period : periods) translations.insert(translations.end(), {period, -period});
  const double tolerance = relative_tolerance * diagonal(patches);
  const int edge_count = kSideCount * static_cast<int>(patches.size());
  std::vector<Edge> edges;
  for (const Surface& patch : patches)
    for (int side = 0; side < kSideCount; ++side) edges.emplace_back(patch, side);

  Borders borders(patches.size());
  const auto border_of = [&](int edge) -> Border& { return borders[edge / kSideCount][edge % kSideCount]; };
  for (int e = 0; e < edge_count; ++e)
    if (edges[e].is_pole(tolerance)) border_of(e).kind = Border::pole;

  std::vector<Match> matches;
  for (const Candidate& c : candidates(edges, borders, translations, tolerance)) {
    const int p = c.edge / kSideCount, side = c.edge % kSideCount;
    const int q = c.other / kSideCount, other_side = c.other % kSideCount;
    if (may_weld && !may_weld(p, side, q, other_side)) continue;
    const auto border =
        weld(edges[c.edge], side, edges[c.other], q, other_side, translations[c.translation], tolerance);
    if (border) matches.push_back({p, side, *border});
  }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.border.max_angle < b.border.max_angle; });
  for (const Match& match : matches) {
    Border& here = borders[match.patch][match.side];
    Border& there = borders[match.border.patch][match.border.side];
    if (here.kind != Border::free || there.kind != Border::free) continue;
    here = there = match.border;
    there.patch = match.patch;
    there.side = match.side;
    there.translation = -there.translation;
  }
  return borders;
}

}  // namespace nurbs
