// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/second_foot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/assert.h"
#include "nurbs/curvature.h"

namespace search {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr int kSamples = 4;  // per direction of an element

// Of the control points of a derivative.
struct Hull {
  Vector4 low = Vector4::Constant(kUnbounded), high = Vector4::Constant(-kUnbounded);
  void add(const Vector4& x) {
    low = low.min(x);
    high = high.max(x);
  }
};

// All X = A' - g W' with (A', W') in a hull and |g| <= size: within a radius of the centre.
struct Ball {
  Vector3 centre = Vector3::Zero();
  double radius = 0.0, flat_radius = 0.0;  // the latter of the first two coordinates
  Ball(const Hull& hull, double size) {
    if (!(hull.low[0] <= hull.high[0])) return;  // a derivative that vanishes
    const Vector4 middle = 0.5 * (hull.low + hull.high), half = 0.5 * (hull.high - hull.low);
    const double of_W = size * (std::abs(middle[3]) + half[3]);
    centre = middle.head<3>();
    radius = half.head<3>().matrix().norm() + of_W;
    flat_radius = half.head<2>().matrix().norm() + of_W;
  }
};

// What is known of the derivatives in a window, in its frame.
struct Derivatives {
  Hull first[2], second[3];  // by 0, 1; 00, 01, 11
  double size2 = 0.0, W_max = 0.0;
};

double reach_of(const Derivatives& x) {
  const double size = std::sqrt(x.size2);
  const Ball X_0(x.first[0], size), X_1(x.first[1], size);
  const Ball X_00(x.second[0], size), X_01(x.second[1], size), X_11(x.second[2], size);
  // v = R u with [X_0 X_1] = Q R at the centres, in the plane; the inverse of R is [alpha beta; 0 gamma].
  const Eigen::Vector2d J_0 = X_0.centre.head<2>(), J_1 = X_1.centre.head<2>();
  const double r_00 = J_0.norm(), r_01 = J_0.dot(J_1) / r_00;
  const double r_11 = std::abs(J_0[0] * J_1[1] - J_0[1] * J_1[0]) / r_00;
  const double alpha = 1.0 / r_00, gamma = 1.0 / r_11, beta = -r_01 * alpha * gamma;
  const double e =
      std::hypot(alpha * X_0.flat_radius, std::abs(beta) * X_0.flat_radius + gamma * X_1.flat_radius);
  if (!(e < 1.0)) return 0.0;

  const auto norm = [&](double a, double b, double c) {
    return (a * X_00.centre + b * X_01.centre + c * X_11.centre).norm() + std::abs(a) * X_00.radius +
           std::abs(b) * X_01.radius + std::abs(c) * X_11.radius;
  };
  const double M_00 = norm(alpha * alpha, 0.0, 0.0), M_01 = norm(alpha * beta, alpha * gamma, 0.0),
               M_11 = norm(beta * beta, 2.0 * beta * gamma, gamma * gamma);
  const double M = 0.5 * (M_00 + M_11) + std::hypot(0.5 * (M_00 - M_11), M_01);
  return (1.0 - e) * (1.0 - e) / (x.W_max * M);
}

// Rows: two tangents of length 1 and their normal.
Eigen::Matrix3d frame(const Vector3& along_0, const Vector3& along_1) {
  const Vector3 normal = along_0.cross(along_1).normalized(), tangent = along_0.normalized();
  Eigen::Matrix3d rows;
  rows << tangent.transpose(), normal.cross(tangent).transpose(), normal.transpose();
  return rows;
}

// The k-th of kSamples from one end of an element to the other.
double sample_of(const KnotVector& knots, int element, int k) {
  const double* knot = &knots.breaks()[element];
  return knot[0] + (knot[1] - knot[0]) * k / (kSamples - 1.0);
}

}  // namespace

/* ---------------------------------------------------------------------- now */

SecondFoot::SecondFoot(const Space<2>& space, const PatchPoints& control_points)
    : space_(space), control_points_(control_points) {
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    const std::vector<double>&t = knots.knots(), &breaks = knots.breaks(), &creases = knots.creases();
    const int p = knots.degree(), count = knots.element_count();
    Axis& axis = axes_[i];
    for (int e = 0; e < count; ++e) axis.first.push_back(knots.span_of_element(e) - p);
    axis.begin.assign(count, 0);
    axis.end.assign(count, count);
    for (int e = 1; e < count; ++e) {
      const bool crease = std::binary_search(creases.begin(), creases.end(), breaks[e]);
      axis.begin[e] = crease ? e : axis.begin[e - 1];
      if (crease) std::fill(axis.end.begin() + axis.begin[e - 1], axis.end.begin() + e, e);
    }
    for (int c = 0; c + 1 < knots.control_point_count(); ++c)
      axis.first_factor.push_back(p / (t[c + p + 1] - t[c + 1]));
    for (int c = 0; c + 2 < knots.control_point_count();
         ++c)  // infinite across a crease, where none is taken
      axis.second_factor.push_back((p - 1) / (t[c + p + 1] - t[c + 2]));
  }
  for (int level = 0; level < kLevels; ++level) {
    int count[2];
    for (int i = 0; i < 2; ++i) count[i] = ((space.knots(i).element_count() - 1) >> level) + 1;
    blocks_[level] = count[0];
    stored_[level].resize(static_cast<size_t>(count[0]) * count[1]);
  }
}

ElementWindow SecondFoot::window(int level, const int (&e)[2]) const {
  ElementWindow window;
  const int width = 1 << level;
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axes_[i];
    const int first = e[i] & -width, count = static_cast<int>(axis.end.size());
    if (axis.end[first] < std::min(first + width, count)) return {{0, 0}, {0, 0}};
    window.begin[i] = std::max(axis.begin[first], first - width);
    window.end[i] = std::min(axis.end[first], first + 2 * width);
  }
  return window;
}

float SecondFoot::rounded_reach(const ElementWindow& window) const {
  return std::nextafter(static_cast<float>(reach(window)), 0.0f);
}

double SecondFoot::reach(const ElementWindow& window) const {
  if (window.begin[0] == window.end[0]) return 0.0;
  constexpr int kMaxColumns = (3 << (kLevels - 1)) * kMaxDegree + 1;
  int begin[2], count[2];  // control points
  for (int i = 0; i < 2; ++i) {
    begin[i] = axes_[i].first[window.begin[i]];
    count[i] = axes_[i].first[window.end[i] - 1] + space_.degree(i) + 1 - begin[i];
  }
  const double *factor_0 = &axes_[0].first_factor[begin[0]],
               *factor_00 = axes_[0].second_factor.data() + begin[0];
  const double *factor_1 = &axes_[1].first_factor[begin[1]],
               *factor_11 = axes_[1].second_factor.data() + begin[1];
  const Eigen::Map<const NodalVectors> points = control_points_.matrix();
  const auto index = [&](int k, int l) {
    return begin[0] + k + space_.control_point_count(0) * (begin[1] + l);
  };
  const int middle[2] = {count[0] / 2, count[1] / 2};  // not the first: there are two or more
  const Vector3 origin = points.col(index(middle[0], middle[1]));
  const Eigen::Matrix3d to_frame = frame(origin - points.col(index(middle[0] - 1, middle[1])),
                                         origin - points.col(index(middle[0], middle[1] - 1)));
  if (!to_frame.allFinite() || !(to_frame.row(2).squaredNorm() > 0.0)) return 0.0;

  Derivatives x;
  Vector4 row[kMaxColumns], X_1[kMaxColumns];  // of the row before, until overwritten
  for (int l = 0; l < count[1]; ++l) {
    Vector4 before = Vector4::Zero(), X_0_before = before, X_1_before = before;  // at k - 1
    for (int k = 0; k < count[0]; ++k) {
      const int a = index(k, l);
      const Vector3 g = to_frame * (points.col(a) - origin);
      const double w = space_.weight(a);
      x.size2 = std::max(x.size2, g.squaredNorm());
      x.W_max = std::max(x.W_max, w);
      const Vector4 here(w * g[0], w * g[1], w * g[2], w);
      if (k > 0) {
        const Vector4 X_0 = factor_0[k - 1] * (here - before);
        x.first[0].add(X_0);
        if (k > 1) x.second[0].add(factor_00[k - 2] * (X_0 - X_0_before));
        X_0_before = X_0;
      }
      if (l > 0) {
        const Vector4 X_1_here = factor_1[l - 1] * (here - row[k]);
        x.first[1].add(X_1_here);
        if (k > 0) x.second[1].add(factor_0[k - 1] * (X_1_here - X_1_before));
        if (l > 1) x.second[2].add(factor_11[l - 2] * (X_1_here - X_1[k]));
        X_1[k] = X_1_before = X_1_here;
      }
      row[k] = before = here;
    }
  }
  return reach_of(x);
}

/* ---------------------------------------------------------------------- until the next list */

void SecondFoot::begin_list(const std::array<bool, nurbs::kSideCount>& goes_on, double edge_angle) {
  goes_on_ = goes_on;
  sine_of_edge_ = std::max(kFlush, std::sin(std::min(edge_angle, 0.5 * nurbs::kPi)));
  shapes_.resize(space_.element_count());
  ++list_;
  kinks_.clear();
}

bool SecondFoot::excluded_until_next_list(const Vector3& d, double reach, int element) const {
  constexpr double kMargin = 2.0;
  NURBS_ASSERT(0 <= element && element < static_cast<int>(shapes_.size()), element, shapes_.size());
  Shape& shape = shapes_[element];
  if (shape.list != list_) measure(element, shape);
  const double needed = kMargin * reach;
  if (!(needed < shape.proved)) {
    if (!shape.sampled) sample(element, shape);
    if (!(needed * curvature_towards(d, shape) < 1.0)) return false;
  }
  for (int k = 0; k < shape.kink_count; ++k)
    if (kinks_[shape.first_kink + k].squared_distance(d) <= reach * reach) return false;
  return true;
}

// 0 if it bends away.
double SecondFoot::curvature_towards(const Vector3& d, const Shape& shape) const {
  constexpr double kClearly = 0.2;
  const Vector3 to_d = d - shape.centre;
  const double height = shape.normal.dot(to_d), clearly = kClearly * to_d.norm();
  if (height > clearly) return std::max(shape.greatest, 0.0);
  if (height < -clearly) return std::max(-shape.least, 0.0);
  return std::max(shape.greatest, -shape.least);
}

// All but curvatures, which take ten times as long as the rest.
void SecondFoot::measure(int element, Shape& shape) const {
  const Indices<2> e = space_.element_indices(element);
  shape.list = list_;
  shape.sampled = false;
  shape.proved = excluded_below(0, {e[0], e[1]});
  shape.first_kink = static_cast<int>(kinks_.size());
  for (int side = 0; side < nurbs::kSideCount; ++side)
    if (!smooth_side(e, side)) kinks_.push_back(side_box(e, side));
  shape.kink_count = static_cast<int>(kinks_.size()) - shape.first_kink;
}

void SecondFoot::sample(int element, Shape& shape) const {
  const nurbs::SurfaceShape centre =
      nurbs::shape_on_element(space_, control_points_.matrix(), element, space_.element_centre(element));
  const Indices<2> e = space_.element_indices(element);
  shape.sampled = true;
  shape.centre = centre.point;
  shape.normal = centre.normal;
  shape.least = kUnbounded, shape.greatest = -kUnbounded;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      const Parameter<2> xi{sample_of(space_.knots(0), e[0], i), sample_of(space_.knots(1), e[1], j)};
      const nurbs::SurfaceShape sample =
          nurbs::shape_on_element(space_, control_points_.matrix(), element, xi);
      if (!std::isfinite(sample.curvature[0])) continue;  // a pole: a kink, see measure
      shape.least = std::min(shape.least, sample.curvature[0]);
      shape.greatest = std::max(shape.greatest, sample.curvature[1]);
    }
}

// A side that is a border or a C0 knot line has the first or last row of the element's control points.
Box SecondFoot::side_box(const Indices<2>& element, int side) const {
  int indices[power(kMaxDegree + 1, 2)];
  space_.element_control_points(space_.element_index(element), indices);
  const int rows[2] = {space_.degree(0) + 1, space_.degree(1) + 1};
  const int i = side / 2, fixed = side % 2 == 1 ? rows[i] - 1 : 0;
  Box box{Vector3::Constant(kUnbounded), Vector3::Constant(-kUnbounded)};
  for (int along = 0; along < rows[1 - i]; ++along) {
    const int a = i == 0 ? fixed + rows[0] * along : along + rows[0] * fixed;
    const Vector3 point = control_points_.col(indices[a]);
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

// Whether the tangent plane goes on beyond a side of an element.
bool SecondFoot::smooth_side(const Indices<2>& element, int side) const {
  const int i = side / 2;
  const bool upper = side % 2 == 1;
  const KnotVector& knots = space_.knots(i);
  if (element[i] == (upper ? knots.element_count() - 1 : 0)) return goes_on_[side];
  const double knot = knots.breaks()[element[i] + (upper ? 1 : 0)];
  if (!std::binary_search(knots.creases().begin(), knots.creases().end(), knot)) return true;

  Indices<2> beyond = element;
  beyond[i] += upper ? 1 : -1;
  for (int k = 0; k < kSamples; ++k) {
    Parameter<2> xi;
    xi[i] = knot;
    xi[1 - i] = sample_of(space_.knots(1 - i), element[1 - i], k);
    const auto normal = [&](const Indices<2>& e) {
      return nurbs::shape_on_element(space_, control_points_.matrix(), space_.element_index(e), xi).normal;
    };
    const Vector3 here = normal(element), there = normal(beyond);
    if (!(here.dot(there) > 0.0 && here.cross(there).norm() <= sine_of_edge_)) return false;
  }
  return true;
}

}  // namespace search
