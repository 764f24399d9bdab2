// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/local_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace search {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of the control points of a derivative.
struct Hull {
  Vector4 low = Vector4::Constant(kInfinity), high = Vector4::Constant(-kInfinity);
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

}  // namespace

LocalReach::LocalReach(const Space<2>& space) : space_(space) {
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

float LocalReach::rounded_reach(const ElementWindow& window, const NodalVectors& control_points) const {
  return std::nextafter(static_cast<float>(reach(window, control_points)), 0.0f);
}

double LocalReach::reach(const ElementWindow& window, const NodalVectors& control_points) const {
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
  const auto index = [&](int k, int l) {
    return begin[0] + k + space_.control_point_count(0) * (begin[1] + l);
  };
  const int middle[2] = {count[0] / 2, count[1] / 2};  // not the first: there are two or more
  const Vector3 origin = control_points.col(index(middle[0], middle[1]));
  const Eigen::Matrix3d to_frame = frame(origin - control_points.col(index(middle[0] - 1, middle[1])),
                                         origin - control_points.col(index(middle[0], middle[1] - 1)));
  if (!to_frame.allFinite() || !(to_frame.row(2).squaredNorm() > 0.0)) return 0.0;

  Derivatives x;
  Vector4 row[kMaxColumns], X_1[kMaxColumns];  // of the row before, until overwritten
  for (int l = 0; l < count[1]; ++l) {
    Vector4 before = Vector4::Zero(), X_0_before = before, X_1_before = before;  // at k - 1
    for (int k = 0; k < count[0]; ++k) {
      const int a = index(k, l);
      const Vector3 g = to_frame * (control_points.col(a) - origin);
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

}  // namespace search
