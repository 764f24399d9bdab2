// SPDX-License-Identifier: GPL-2.0-or-later
#include "distance_bound.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace nurbs::judge {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Coefficients =
    Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostCoefficients, kMostCoefficients>;

double distance(const Eigen::Vector4d& Q) { return Q.head<3>().norm() / Q[3]; }

// All control points beyond the plane at distance b from d whose normal is the net's mean direction.
bool beyond_plane(const Net& net, double b) {
  Vector3 normal = Vector3::Zero();
  for (const int j : {0, net.q})
    for (const int i : {0, net.p}) normal += net.Q[j][i].hnormalized();
  normal.normalize();
  for (int j = 0; j <= net.q; ++j)
    for (int i = 0; i <= net.p; ++i)
      if (!(normal.dot(net.Q[j][i].head<3>()) >= b * net.Q[j][i][3])) return false;
  return true;
}

// Bernstein coefficients of g = Q.Q - b^2 w^2, of degrees 2p x 2q.
Coefficients excess(const Net& net, double b) {
  Eigen::Vector4d scaled[kMaxDegree + 1][kMaxDegree + 1];
  for (int j = 0; j <= net.q; ++j)
    for (int i = 0; i <= net.p; ++i) {
      scaled[j][i] = choose(net.p, i) * choose(net.q, j) * net.Q[j][i];
      scaled[j][i][3] *= b;
    }
  Coefficients g = Coefficients::Zero(2 * net.p + 1, 2 * net.q + 1);
  for (int j = 0; j <= net.q; ++j)
    for (int i = 0; i <= net.p; ++i) {
      const Eigen::Vector4d dual = scaled[j][i].cwiseProduct(Eigen::Vector4d(1.0, 1.0, 1.0, -1.0));
      for (int l = 0; l <= net.q; ++l)
        for (int k = 0; k <= net.p; ++k) g(i + k, j + l) += dual.dot(scaled[l][k]);
    }
  for (int l = 0; l <= 2 * net.q; ++l)
    for (int k = 0; k <= 2 * net.p; ++k) g(k, l) /= choose(2 * net.p, k) * choose(2 * net.q, l);
  return g;
}

// g is convex, and its tangent plane at t is nowhere below `margin` on the unit square.
bool convex_above(const Coefficients& g, const Vector2& t, double margin) {
  const int n = static_cast<int>(g.rows()) - 1, m = static_cast<int>(g.cols()) - 1;
  const Coefficients g_u = n * (g.bottomRows(n) - g.topRows(n)), g_v = m * (g.rightCols(m) - g.leftCols(m));
  const double uu = (n - 1) * (g_u.bottomRows(n - 1) - g_u.topRows(n - 1)).minCoeff();
  const double vv = (m - 1) * (g_v.rightCols(m - 1) - g_v.leftCols(m - 1)).minCoeff();
  const double uv = m * (g_u.rightCols(m) - g_u.leftCols(m)).abs().maxCoeff();
  if (!(uu > 0.0 && vv > 0.0 && uu * vv >= uv * uv)) return false;

  const auto B = bernstein(n, t[0]), C = bernstein(m, t[1]);
  const auto at = [&](int i, int j) {
    return (B.col(i).matrix().transpose() * g.matrix() * C.col(j).matrix()).value();
  };
  double least = at(0, 0);
  const Vector2 slope(at(1, 0), at(0, 1));
  for (int i = 0; i < 2; ++i) least += std::min(-slope[i] * t[i], slope[i] * (1.0 - t[i]));
  return least >= margin;
}

// No point of the net (seen from d) is nearer than b.  The nearest point known makes a good tangent point.
bool all_beyond(const Net& net, double b, const Vector2& known) {
  if (b <= 0.0 || beyond_plane(net, b)) return true;
  const Coefficients g = excess(net, b);
  const double margin = 16.0 * kEpsilon * g.abs().maxCoeff();  // round-off of g
  return g.minCoeff() >= margin || convex_above(g, local(net, known), margin);
}

void take_corners(const Net& net, Nearest& nearest) {
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const double r = distance(net.Q[j * net.q][i * net.p]);
      if (r >= nearest.distance) continue;
      nearest.distance = r;
      nearest.xi = {i == 0 ? net.low[0] : net.high[0], j == 0 ? net.low[1] : net.high[1]};
    }
}

double centre_distance(const Net& net) { return net.Q[net.q / 2][net.p / 2].hnormalized().norm(); }

}  // namespace

DistanceBound::DistanceBound(const Surface& surface) {
  origin_ = surface.control_points.rowwise().mean();
  round_off_ = 32.0 * kEpsilon * surface.control_points.cwiseAbs().maxCoeff();
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = surface.space.knots(i);
    parameter_round_off_[i] = 4.0 * kEpsilon * std::max(std::abs(knots.front()), std::abs(knots.back()));
  }
  for (int e = 0; e < surface.space.element_count(); ++e)
    nets_.push_back(element_net(surface, surface.space.element_indices(e), origin_));
  longest_ = 0.0;
  for (const Net& net : nets_) longest_ = std::max(longest_, lengths(net).maxCoeff());
}

Net DistanceBound::seen_from(const Vector3& d, const Net& net) const {
  Net seen = net;
  const Vector3 shift = d - origin_;
  for (int j = 0; j <= net.q; ++j)
    for (int i = 0; i <= net.p; ++i) seen.Q[j][i].head<3>() -= net.Q[j][i][3] * shift;
  return seen;
}

Nearest DistanceBound::nearest(const Vector3& d, const Nearest& known, double tolerance) const {
  constexpr int kMostNets = 1000000;
  Nearest best = known;
  best.nets = 0;
  thread_local std::vector<Net> open;
  open.clear();
  for (const Net& net : nets_) {
    open.push_back(seen_from(d, net));
    take_corners(open.back(), best);
  }
  std::sort(open.begin(), open.end(),
            [](const Net& a, const Net& b) { return centre_distance(a) > centre_distance(b); });
  Net net, halves[2];
  while (!open.empty()) {
    if (++best.nets > kMostNets) throw std::runtime_error("distance bound: more than a million nets");
    net = open.back();
    open.pop_back();
    const double b = (1.0 - tolerance) * best.distance - round_off_;
    if (all_beyond(net, b, {best.xi[0], best.xi[1]})) continue;
    const Vector2 length = lengths(net);
    halve(net, length[0] >= length[1] ? 0 : 1, halves[0], halves[1]);
    for (const Net& half : halves) take_corners(half, best);
    const int nearer = centre_distance(halves[0]) < centre_distance(halves[1]) ? 0 : 1;
    open.push_back(halves[1 - nearer]);
    open.push_back(halves[nearer]);
  }
  return best;
}

Nearest DistanceBound::nearest(const Vector3& d, double tolerance) const {
  return nearest(d, {{nets_[0].low[0], nets_[0].low[1]}, kInfinity, 0}, tolerance);
}

Vector3 DistanceBound::point(const Parameter<2>& parameter) const {
  const Vector2 xi(parameter[0], parameter[1]);
  for (const Net& net : nets_)
    if (holds(net, xi)) return origin_ + Derivatives(net, local(net, xi)).of[0][0].hnormalized();
  throw std::invalid_argument("parameters outside the surface, expected to be inside");
}

// With b = |S - d|, g = Q.Q - b^2 w^2 has the gradient 2 w^2 grad phi and, where that is 0, 2 w^2 its
// Hessian.
void DistanceBound::add_conditions(const Vector3& d, const Net& net, const Vector2& t,
                                   LocalConditions& worst) const {
  constexpr int kDirections = 32;
  const Derivatives Q(seen_from(d, net), t);
  const double w = Q.of[0][0][3], b = distance(Q.of[0][0]);
  const auto product = [&](const Eigen::Vector4d& x, const Eigen::Vector4d& y) {
    return (x.head<3>().dot(y.head<3>()) - b * b * x[3] * y[3]) / (w * w);
  };
  const Vector2 length = lengths(net).cwiseMax(1e-3 * longest_);  // slivers would amplify round-off
  const Eigen::Vector4d &q = Q.of[0][0], &q_u = Q.of[1][0], &q_v = Q.of[0][1];
  const Vector2 gradient(product(q, q_u) / length[0], product(q, q_v) / length[1]);
  Eigen::Matrix2d hessian;
  hessian(0, 0) = (product(q_u, q_u) + product(q, Q.of[2][0])) / (length[0] * length[0]);
  hessian(1, 1) = (product(q_v, q_v) + product(q, Q.of[0][2])) / (length[1] * length[1]);
  hessian(0, 1) = hessian(1, 0) = (product(q_u, q_v) + product(q, Q.of[1][1])) / (length[0] * length[1]);
  const double level = 1e-10 * b + round_off_;  // of a clear slope

  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * M_PI * k / kDirections;
    Vector2 s(std::cos(angle), std::sin(angle));
    for (double& component : s)
      if (std::abs(component) < 1e-12) component = 0.0;
    if (((t.array() == 0.0 && s.array() < 0.0) || (t.array() == 1.0 && s.array() > 0.0)).any()) continue;
    const double slope = gradient.dot(s);
    worst.slope = std::min(worst.slope, slope);
    if (slope < level) worst.curvature = std::min(worst.curvature, s.dot(hessian * s));
  }
}

LocalConditions DistanceBound::conditions(const Vector3& d, const Parameter<2>& parameter) const {
  constexpr int kAlongPole = 8;
  Vector2 xi(parameter[0], parameter[1]);
  for (const Net& net : nets_)
    for (int i = 0; i < 2; ++i)  // round-off beside a knot is on it
      for (const double knot : {net.low[i], net.high[i]})
        if (std::abs(xi[i] - knot) <= parameter_round_off_[i]) xi[i] = knot;
  LocalConditions worst{kInfinity, kInfinity};
  int pole = -1;
  for (const Net& net : nets_)
    if (holds(net, xi)) pole = std::max(pole, pole_direction(net, xi));
  for (const Net& net : nets_) {
    Vector2 touched = xi;
    if (pole >= 0) touched[pole] = net.low[pole];
    if (!holds(net, touched)) continue;
    Vector2 t = local(net, touched);
    for (int k = 0; k <= (pole >= 0 ? kAlongPole : 0); ++k) {
      if (pole >= 0) t[pole] = static_cast<double>(k) / kAlongPole;
      add_conditions(d, net, t, worst);
    }
  }
  return worst;
}

}  // namespace nurbs::judge
