// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/distance_polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace search {
namespace {

// Calls f(first coefficient, stride) for every line of an (n[0]+1) x (n[1]+1) net along a direction.
template <class Function>
void for_lines(const int (&n)[2], int direction, Function f) {
  const int lines = n[1 - direction] + 1;
  const int stride = direction == 0 ? 1 : n[0] + 1, next = direction == 0 ? n[0] + 1 : 1;
  for (int line = 0; line < lines; ++line) f(line * next, stride);
}

// De Casteljau at the middle of one line; `values` holds the upper half afterwards.
void halve_line(int n, int stride, double* values, double* lower) {
  for (int k = 0; k <= n; ++k) {
    lower[k * stride] = values[0];
    for (int j = 0; j < n - k; ++j)
      values[j * stride] = 0.5 * (values[j * stride] + values[(j + 1) * stride]);
  }
}

}  // namespace

std::vector<ProductTerm> product_terms(int p, int q) {
  std::vector<ProductTerm> terms;
  const int count = (p + 1) * (q + 1);
  for (int a = 0; a < count; ++a)
    for (int b = a; b < count; ++b) {
      const int k = a % (p + 1) + b % (p + 1), l = a / (p + 1) + b / (p + 1);
      const double factor = (a == b ? 1.0 : 2.0) / (nurbs::binomial(2 * p, k) * nurbs::binomial(2 * q, l));
      terms.push_back({a, b, k + (2 * p + 1) * l, factor});
    }
  return terms;
}

DistancePolynomial::DistancePolynomial(const ElementStore& elements, const int (&e)[2],
                                       const std::vector<ProductTerm>& terms, const Vector4* net,
                                       const Vector4& d)
    : e_{e[0], e[1]},
      n_{2 * elements.kernel().p, 2 * elements.kernel().q},
      rational_(elements.rational()),
      part_{{-1.0, -1.0}, {1.0, 1.0}} {
  const int p = elements.kernel().p, q = elements.kernel().q;
  double x[power(kMaxDegree + 1, 2)][4];
  for (int a = 0; a < (p + 1) * (q + 1); ++a) {
    for (int k = 0; k < 3; ++k) x[a][k] = net[a][k] - net[a][3] * d[k];
    x[a][3] = net[a][3];
  }
  std::fill_n(G_, size(), 0.0);
  for (const ProductTerm& t : terms)
    G_[t.k] += t.factor * (x[t.a][0] * x[t.b][0] + x[t.a][1] * x[t.b][1] + x[t.a][2] * x[t.b][2]);
  if (rational_) {
    std::fill_n(V_, size(), 0.0);
    for (const ProductTerm& t : terms) V_[t.k] += t.factor * x[t.a][3] * x[t.b][3];
  }
  double largest = 0.0;
  for (int k = 0; k < size(); ++k) largest = std::max(largest, std::abs(G_[k]));
  round_off_ = 16.0 * std::numeric_limits<double>::epsilon() * largest;
}

double DistancePolynomial::lower_bound(double c) const {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < size(); ++k) least = std::min(least, G_[k] - c * (rational_ ? V_[k] : 1.0));
  return least;
}

DistancePolynomial::Range DistancePolynomial::distance2() const {
  // D is a mean of the quotients, with weights B_k V_k > 0.
  Range range{std::numeric_limits<double>::infinity(), 0.0};
  for (int k = 0; k < size(); ++k) {
    const double D = rational_ ? G_[k] / V_[k] : G_[k];
    range.low = std::min(range.low, D);
    range.high = std::max(range.high, D);
  }
  return {std::max(range.low, 0.0), range.high};
}

DistancePolynomial::Range DistancePolynomial::derivative(int order_0, int order_1, const Range& c) const {
  const int step[2] = {1, n_[0] + 1};
  const int u = order_0 > 0 ? step[0] : step[1], v = order_1 > 0 ? step[1] : step[0];
  const bool second = order_0 + order_1 == 2;
  const auto difference = [&](const double* F) {
    return second ? (F[u + v] - F[v]) - (F[u] - F[0]) : F[u] - F[0];
  };
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int l = 0; l <= n_[1] - order_1; ++l)
    for (int k = l * step[1]; k <= l * step[1] + n_[0] - order_0; ++k) {
      const double dG = difference(G_ + k), dV = rational_ ? difference(V_ + k) : 0.0;
      const double at_low = dG - c.low * dV, at_high = dG - c.high * dV;
      range.low = std::min(range.low, std::min(at_low, at_high));
      range.high = std::max(range.high, std::max(at_low, at_high));
    }
  double factor = 1.0;
  for (int order = 0; order < order_0; ++order) factor *= n_[0] - order;
  for (int order = 0; order < order_1; ++order) factor *= n_[1] - order;
  return {factor * range.low, factor * range.high};
}

DistancePolynomial::Shape DistancePolynomial::shape(const Range& c) const {
  bool convex = true;
  Range bend[2];
  for (int i = 0; i < 2; ++i) {
    if (collapsed(i)) continue;
    bend[i] = derivative(i == 0 ? 2 : 0, i == 1 ? 2 : 0, c);
    if (bend[i].high < -round_off_) return Shape::no_minimum;
    convex = convex && bend[i].low > round_off_;
  }
  if (collapsed(0) || collapsed(1)) return convex ? Shape::convex : Shape::unknown;
  const Range twist = derivative(1, 1, c);
  const double most = std::max(std::abs(twist.low), std::abs(twist.high)) + round_off_;
  const double least = std::max(twist.low, -twist.high) - round_off_;  // negative if the sign changes
  if (convex && bend[0].low * bend[1].low > most * most) return Shape::convex;
  if (least > 0.0 && std::max(bend[0].high, 0.0) * std::max(bend[1].high, 0.0) < least * least)
    return Shape::no_minimum;
  return Shape::unknown;
}

void DistancePolynomial::halve(int direction, DistancePolynomial& lower, DistancePolynomial& upper) const {
  lower = upper = *this;
  for_lines(n_, direction, [&](int first, int stride) {
    halve_line(n_[direction], stride, upper.G_ + first, lower.G_ + first);
    if (rational_) halve_line(n_[direction], stride, upper.V_ + first, lower.V_ + first);
  });
  const double middle = 0.5 * (part_.low[direction] + part_.high[direction]);
  lower.part_.high[direction] = upper.part_.low[direction] = middle;
}

void DistancePolynomial::collapse(int direction, bool upper) {
  const int n = n_[direction];
  for_lines(n_, direction, [&](int first, int stride) {
    const int border = first + (upper ? n * stride : 0);
    const double G = G_[border], V = rational_ ? V_[border] : 0.0;
    for (int k = 0; k <= n; ++k) G_[first + k * stride] = G;
    for (int k = 0; k <= n && rational_; ++k) V_[first + k * stride] = V;
  });
  (upper ? part_.low : part_.high)[direction] = (upper ? part_.high : part_.low)[direction];
}

int DistancePolynomial::widest(const Range& c) const {
  if (collapsed(0)) return 1;
  if (collapsed(1)) return 0;
  const Range bend[2] = {derivative(2, 0, c), derivative(0, 2, c)};
  return std::max(bend[1].high, -bend[1].low) > std::max(bend[0].high, -bend[0].low) ? 1 : 0;
}

LocalPoint DistancePolynomial::centre() const {
  return {{e_[0], e_[1]}, {0.5 * (part_.low[0] + part_.high[0]), 0.5 * (part_.low[1] + part_.high[1])}};
}

double DistancePolynomial::corner_distance2(int corner) const {
  const int k = corner_index(corner);
  return rational_ ? G_[k] / V_[k] : G_[k];
}

LocalPoint DistancePolynomial::corner(int corner) const {
  return {{e_[0], e_[1]},
          {(corner & 1 ? part_.high : part_.low)[0], (corner & 2 ? part_.high : part_.low)[1]}};
}

}  // namespace search
