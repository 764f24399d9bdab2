// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/gauss_legendre.h"

namespace nurbs {
namespace {

constexpr double kOnKnot = 1e-12;    // of the patch's range of parameters
constexpr double kOnPole = 1e-8;     // of an element
constexpr double kOnePoint = 1e-9;   // of the next row of control points: an edge shorter than that is a pole
constexpr double kNoArea = 1e-9;     // of the product of tangents: below it they span nothing
constexpr double kCancelled = 1e-9;  // of the sum of weights: a sum shorter than that has no direction

// The tangents times the element's widths, and their cross product with its derivatives.
struct Tangents {
  Vector3 S[2];  // [length]
  Vector3 N, N_i[2];
  double scale;  // of N
};

// The point as seen from a patch around it: `sense` is -1 where the patch's normal is on the other side.
struct View {
  SurfacePoint at;
  double sense;
};

class SurfaceNormal {
 public:
  SurfaceNormal(const MultiPatch& surface, const NodalVectors& control_points)
      : surface_(surface), control_points_(control_points) {}

  Vector3 operator()(const SurfacePoint& at) const {
    std::vector<View> views{{on_its_knots(at), 1.0}};
    for (size_t k = 0; k < views.size(); ++k) add_neighbours(views[k], views);
    Vector3 sum = Vector3::Zero();
    double weights = 0.0;
    for (const View& view : views) add_normals(view, sum, weights);
    if (sum.norm() > kCancelled * weights) return sum.normalized();
    const Vector3 mean = mean_normal(at.patch, elements_around(views[0].at));
    return mean.norm() > 0.0 ? mean : Vector3::UnitZ();
  }

 private:
  const KnotVector& knots(int patch, int direction) const { return surface_.patch(patch).knots(direction); }

  // The point moved to the knots and poles that it is beside.
  SurfacePoint on_its_knots(SurfacePoint at) const {
    for (int i = 0; i < 2; ++i) {
      const KnotVector& k = knots(at.patch, i);
      at.xi[i] = std::clamp(at.xi[i], k.front(), k.back());
      const int e = k.element_at(at.xi[i]);
      const double begin = k.breaks()[e], end = k.breaks()[e + 1];
      const double on_knot = kOnKnot * (k.back() - k.front()), on_pole = kOnPole * (end - begin);
      const bool pole_before = begin == k.front() && is_pole(at.patch, 2 * i);
      const bool pole_behind = end == k.back() && is_pole(at.patch, 2 * i + 1);
      if (at.xi[i] - begin <= (pole_before ? on_pole : on_knot)) at.xi[i] = begin;
      if (end - at.xi[i] <= (pole_behind ? on_pole : on_knot)) at.xi[i] = end;
    }
    return at;
  }

  bool is_pole(int patch, int side) const {
    const auto points = surface_.control_points_of(patch, control_points_);
    const int n[2] = {knots(patch, 0).control_point_count(), knots(patch, 1).control_point_count()};
    const int stride[2] = {1, n[0]}, across = side / 2, along = 1 - across;
    const int first = side % 2 == 1 ? (n[across] - 1) * stride[across] : 0;
    const int next = side % 2 == 1 ? -stride[across] : stride[across];
    double edge = 0.0, size = 0.0;
    for (int k = 0; k < n[along]; ++k) {
      const int a = first + k * stride[along];
      edge = std::max(edge, (points.col(a) - points.col(first)).norm());
      size = std::max(size, (points.col(a + next) - points.col(first)).norm());
    }
    return edge <= kOnePoint * size;
  }
  // The side that is a pole on which the point lies, or -1.
  int pole_of(const SurfacePoint& at) const {
    for (int side = 0; side < kSideCount; ++side)
      if (surface_.on_side(at, side) && is_pole(at.patch, side)) return side;
    return -1;
  }

  // All parameters of a pole are one point.
  bool same(const SurfacePoint& a, const SurfacePoint& b) const {
    if (a.patch != b.patch) return false;
    const int pole = pole_of(a);
    if (pole >= 0 && surface_.on_side(b, pole)) return true;
    for (int i = 0; i < 2; ++i) {
      const KnotVector& k = knots(a.patch, i);
      if (std::abs(a.xi[i] - b.xi[i]) > kOnKnot * (k.back() - k.front())) return false;
    }
    return true;
  }

  void add_neighbours(const View from, std::vector<View>& views) const {
    const auto cross = [&](const SurfacePoint& at, int side) {
      const Border& border = surface_.border(at.patch, side);
      if (border.kind != Border::welded) return;
      const SurfacePoint there = on_its_knots(surface_.across(at, side));
      if (std::any_of(views.begin(), views.end(), [&](const View& v) { return same(v.at, there); })) return;
      views.push_back({there, same_orientation(side, border) ? from.sense : -from.sense});
    };
    for (int side = 0; side < kSideCount; ++side)
      if (surface_.on_side(from.at, side)) cross(from.at, side);
    const int pole = pole_of(from.at);
    if (pole < 0) return;
    const int along = 1 - pole / 2;
    for (const int side : {2 * along, 2 * along + 1}) {
      SurfacePoint end = from.at;
      end.xi[along] = surface_.end_of_side(end.patch, side);
      cross(end, side);
    }
  }

  // Elements that touch the point.
  std::vector<Indices<2>> elements_around(const SurfacePoint& at) const {
    std::vector<Indices<2>> elements;
    const int last[2] = {knots(at.patch, 0).element_at(at.xi[0]), knots(at.patch, 1).element_at(at.xi[1])};
    int first[2];
    for (int i = 0; i < 2; ++i)
      first[i] = last[i] > 0 && knots(at.patch, i).breaks()[last[i]] == at.xi[i] ? last[i] - 1 : last[i];
    for (int e = first[0]; e <= last[0]; ++e)
      for (int f = first[1]; f <= last[1]; ++f) elements.push_back({e, f});
    return elements;
  }

  void add_normals(const View& view, Vector3& sum, double& weights) const {
    const auto add = [&](const Vector3& normal, double weight) {
      sum += view.sense * weight * normal;
      weights += weight;
    };
    const int pole = pole_of(view.at);
    if (pole >= 0) return add_pole(view.at, pole, add);
    for (const Indices<2>& e : elements_around(view.at)) {
      const Tangents t = tangents(view.at.patch, e, view.at.xi);
      int into[2];
      for (int i = 0; i < 2; ++i) into[i] = side_of(view.at, e, i);
      const Vector3 normal = element_normal(view.at.patch, e, view.at.xi, t);
      add(normal, angle(t, into));
    }
  }

  // The ways off a pole: their directions turn by |N_j| / |S_j|^2 per parameter, j leading off it.
  template <class Add>
  void add_pole(const SurfacePoint& at, int pole, const Add& add) const {
    const int j = pole / 2, i = 1 - j;
    const double inward = pole % 2 == 0 ? 1.0 : -1.0;
    Indices<2> e;
    e[j] = pole % 2 == 0 ? 0 : knots(at.patch, j).element_count() - 1;
    static const QuadratureRule rule = gauss_legendre(kMaxGaussPoints);
    for (e[i] = 0; e[i] < knots(at.patch, i).element_count(); ++e[i]) {
      const double begin = knots(at.patch, i).breaks()[e[i]], end = knots(at.patch, i).breaks()[e[i] + 1];
      for (size_t k = 0; k < rule.points.size(); ++k) {
        Parameter<2> xi = at.xi;
        xi[i] = begin + 0.5 * (1.0 + rule.points[k]) * (end - begin);
        const Tangents t = tangents(at.patch, e, xi);
        const Vector3 normal = inward * t.N_i[j];
        const double length2 = t.S[j].squaredNorm(), size = normal.norm();
        if (size > kNoArea * t.scale && length2 > 0.0)
          add(normal / size, rule.weights[k] * size / length2);
        else
          add(mean_normal(at.patch, {e}), rule.weights[k]);
      }
    }
  }

  // 1 or -1 where the element lies before or behind the point in direction i, 0 on both sides.
  int side_of(const SurfacePoint& at, const Indices<2>& e, int i) const {
    const std::vector<double>& breaks = knots(at.patch, i).breaks();
    return at.xi[i] == breaks[e[i]] ? 1 : at.xi[i] == breaks[e[i] + 1] ? -1 : 0;
  }

  // Under which an element is seen from its own point: all round, half, or that of a corner.
  static double angle(const Tangents& t, const int (&into)[2]) {
    if (into[0] == 0 && into[1] == 0) return 2.0 * M_PI;
    if (into[0] == 0 || into[1] == 0) return M_PI;
    return std::atan2(t.N.norm(), into[0] * into[1] * t.S[0].dot(t.S[1]));
  }

  Tangents tangents(int patch, const Indices<2>& e, const Parameter<2>& xi) const {
    const Space<2>& space = surface_.patch(patch);
    RationalBasis<2> basis;
    evaluate_on_element(space, space.element_index(e), xi, 2, basis);
    const auto points = surface_.control_points_of(patch, control_points_);
    double h[2];
    for (int i = 0; i < 2; ++i) h[i] = space.knots(i).breaks()[e[i] + 1] - space.knots(i).breaks()[e[i]];
    const Vector3 zero = Vector3::Zero(), origin = points.col(basis.control_point[0]);
    Vector3 S_i[2] = {zero, zero}, S_ij[3] = {zero, zero, zero};
    for (int a = 0; a < basis.count; ++a) {
      const Vector3 P = points.col(basis.control_point[a]) - origin;
      for (int i = 0; i < 2; ++i) S_i[i] += h[i] * basis.dR[i][a] * P;
      for (int k = 0, i = 0; i < 2; ++i)
        for (int j = i; j < 2; ++j, ++k) S_ij[k] += h[i] * h[j] * basis.d2R[k][a] * P;
    }
    double length[2];
    for (int i = 0; i < 2; ++i) length[i] = S_i[i].norm() + S_ij[2 * i].norm() + S_ij[1].norm();
    return {{S_i[0], S_i[1]},
            S_i[0].cross(S_i[1]),
            {S_ij[0].cross(S_i[1]) + S_i[0].cross(S_ij[1]), S_ij[1].cross(S_i[1]) + S_i[0].cross(S_ij[2])},
            length[0] * length[1]};
  }

  // Of one element at its point xi, or the limit from its middle; zero if it has no area.
  Vector3 element_normal(int patch, const Indices<2>& e, const Parameter<2>& xi, const Tangents& t) const {
    if (t.N.norm() > kNoArea * t.scale) return t.N.normalized();
    Vector3 inwards = Vector3::Zero();
    for (int i = 0; i < 2; ++i) {
      const std::vector<double>& breaks = knots(patch, i).breaks();
      const double begin = breaks[e[i]], end = breaks[e[i] + 1];
      inwards += (0.5 * (begin + end) - xi[i]) / (end - begin) * t.N_i[i];
    }
    if (inwards.norm() > kNoArea * t.scale) return inwards.normalized();
    return mean_normal(patch, {e});
  }

  Vector3 mean_normal(int patch, const std::vector<Indices<2>>& elements) const {
    Vector3 sum = Vector3::Zero();
    for (const Indices<2>& e : elements)
      for (const double u : {0.2, 0.8})
        for (const double v : {0.2, 0.8}) {
          const std::vector<double>&xi = knots(patch, 0).breaks(), &eta = knots(patch, 1).breaks();
          const Parameter<2> at{xi[e[0]] + u * (xi[e[0] + 1] - xi[e[0]]),
                                eta[e[1]] + v * (eta[e[1] + 1] - eta[e[1]])};
          const Tangents t = tangents(patch, e, at);
          if (t.N.norm() > kNoArea * t.scale) sum += t.N;
        }
    return sum.norm() > 0.0 ? sum.normalized() : sum;
  }

  const MultiPatch& surface_;
  const NodalVectors& control_points_;
};

}  // namespace

Vector3 normal_at(const MultiPatch& surface, const NodalVectors& control_points, const SurfacePoint& at) {
  return SurfaceNormal(surface, control_points)(at);
}

}  // namespace nurbs
