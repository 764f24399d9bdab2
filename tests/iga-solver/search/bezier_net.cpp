// SPDX-License-Identifier: GPL-2.0-or-later
#include "bezier_net.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace nurbs::judge {
namespace {

// Row k: the Bezier point k of knot span `span` as a combination of the p + 1 control points there: the
// blossom at p - k times the left and k times the right end, by repeated linear interpolation.
Eigen::MatrixXd bezier_rows(const KnotVector& knots, int span) {
  const int p = knots.degree();
  const double* t = &knots.knots()[span];
  Eigen::MatrixXd rows(p + 1, p + 1);
  for (int k = 0; k <= p; ++k) {
    Eigen::MatrixXd combination = Eigen::MatrixXd::Identity(p + 1, p + 1);
    for (int r = 1; r <= p; ++r) {
      const double x = r <= p - k ? t[0] : t[1];
      for (int j = p; j >= r; --j) {
        const double left = t[j - p], right = t[j + 1 - r], s = (x - left) / (right - left);
        combination.row(j) = (1.0 - s) * combination.row(j - 1) + s * combination.row(j);
      }
    }
    rows.row(k) = combination.row(p);
  }
  return rows;
}

}  // namespace

double choose(int n, int k) {
  static const auto table = [] {
    std::array<std::array<double, kMostCoefficients>, kMostCoefficients> n_over{};
    for (int m = 0; m < kMostCoefficients; ++m)
      for (int j = 0; j <= m; ++j)
        n_over[m][j] = j == 0 || j == m ? 1.0 : n_over[m - 1][j - 1] + n_over[m - 1][j];
    return n_over;
  }();
  return table[n][k];
}

Net element_net(const Surface& surface, const Indices<2>& element, const Vector3& origin) {
  const Space<2>& space = surface.space;
  Net net{space.degree(0), space.degree(1), {}, {}, {}};
  Eigen::MatrixXd rows[2];
  int first[2];
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    const int span = knots.span_of_element(element[i]);
    rows[i] = bezier_rows(knots, span);
    first[i] = span - knots.degree();
    net.low[i] = knots.knots()[span];
    net.high[i] = knots.knots()[span + 1];
  }
  for (int l = 0; l <= net.q; ++l)
    for (int k = 0; k <= net.p; ++k) {
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      for (int j = 0; j <= net.q; ++j)
        for (int i = 0; i <= net.p; ++i) {
          const int a = first[0] + i + space.control_point_count(0) * (first[1] + j);
          const double w = space.weight(a) * rows[0](k, i) * rows[1](l, j);
          sum.head<3>() += w * (surface.control_points.col(a) - origin);
          sum[3] += w;
        }
      net.Q[l][k] = sum;
    }
  return net;
}

Vector2 lengths(const Net& net) {
  Vector2 longest = Vector2::Zero();
  for (int j = 0; j <= net.q; ++j) {
    double length = 0.0;
    for (int i = 0; i < net.p; ++i)
      length += (net.Q[j][i + 1].hnormalized() - net.Q[j][i].hnormalized()).norm();
    longest[0] = std::max(longest[0], length);
  }
  for (int i = 0; i <= net.p; ++i) {
    double length = 0.0;
    for (int j = 0; j < net.q; ++j)
      length += (net.Q[j + 1][i].hnormalized() - net.Q[j][i].hnormalized()).norm();
    longest[1] = std::max(longest[1], length);
  }
  return longest;
}

void halve(const Net& net, int direction, Net& left, Net& right) {
  left = right = net;
  left.high[direction] = right.low[direction] = 0.5 * (net.low[direction] + net.high[direction]);
  const int n = direction == 0 ? net.p : net.q, lines = direction == 0 ? net.q : net.p;
  for (int line = 0; line <= lines; ++line) {
    const auto at = [&](Net& of, int k) -> Eigen::Vector4d& {
      return direction == 0 ? of.Q[line][k] : of.Q[k][line];
    };
    for (int r = 1; r <= n; ++r) {
      for (int k = 0; k <= n - r; ++k) at(right, k) = 0.5 * (at(right, k) + at(right, k + 1));
      at(left, r) = at(right, 0);
    }
  }
}

bool holds(const Net& net, const Vector2& xi) {
  return (net.low.array() <= xi.array()).all() && (xi.array() <= net.high.array()).all();
}

Vector2 local(const Net& net, const Vector2& xi) {
  return (xi - net.low).cwiseQuotient(net.high - net.low).cwiseMax(0.0).cwiseMin(1.0);
}

int pole_direction(const Net& net, const Vector2& xi) {
  const Vector2 length = lengths(net);
  const auto one_point = [&](int direction, int side) {
    const int n = direction == 0 ? net.p : net.q;
    for (int k = 1; k <= n; ++k) {
      const Eigen::Vector4d &a = direction == 0 ? net.Q[side][0] : net.Q[0][side],
                            &b = direction == 0 ? net.Q[side][k] : net.Q[k][side];
      if ((a.hnormalized() - b.hnormalized()).norm() > 1e-12 * length.maxCoeff()) return false;
    }
    return true;
  };
  for (int direction = 0; direction < 2; ++direction) {
    const int other = 1 - direction, last = other == 0 ? net.p : net.q;
    if (xi[other] == net.low[other] && one_point(direction, 0)) return direction;
    if (xi[other] == net.high[other] && one_point(direction, last)) return direction;
  }
  return -1;
}

BernsteinValues bernstein(int n, double t) {
  BernsteinValues B = BernsteinValues::Zero(n + 1, 3);
  B(0, 0) = 1.0;
  for (int m = 1; m <= n; ++m)  // derivatives are differences of one degree less
    for (int k = m; k >= 0; --k) {
      using Row = Eigen::Array<double, 1, 3>;
      const Row low = k == 0 ? Row(Row::Zero()) : Row(B.row(k - 1)), high = B.row(k);
      B.row(k) = t * low + (1.0 - t) * high;
      B(k, 1) = m * (low[0] - high[0]);
      B(k, 2) = m * (low[1] - high[1]);
    }
  return B;
}

Derivatives::Derivatives(const Net& net, const Vector2& t) {
  const auto B = bernstein(net.p, t[0]), C = bernstein(net.q, t[1]);
  for (int di = 0; di < 3; ++di)
    for (int dj = 0; di + dj < 3; ++dj) {
      of[di][dj].setZero();
      for (int j = 0; j <= net.q; ++j)
        for (int i = 0; i <= net.p; ++i) of[di][dj] += B(i, di) * C(j, dj) * net.Q[j][i];
    }
}

}  // namespace nurbs::judge
