// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/foot_search.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRoundOff = 0.25 * kEpsilon;  // relative error of S that evaluation cannot avoid
constexpr double kLeastCurvature = 1e-10;  // of phi, where a plane has 1; below it phi counts as not convex

// Minimum of g.s + s.H s / 2 over low <= s <= high, H positive definite on the directions with room.
Vector2 box_step(const Vector2& g, const Matrix2& H, const Vector2& low, const Vector2& high) {
  Vector2 best = Vector2(H(0, 1) * g[1] - H(1, 1) * g[0], H(0, 1) * g[0] - H(0, 0) * g[1]) / H.determinant();
  if ((low.array() <= best.array()).all() && (best.array() <= high.array()).all()) return best;

  double least = std::numeric_limits<double>::infinity();
  for (int fixed = 0; fixed < 2; ++fixed)
    for (const double bound : {low[fixed], high[fixed]}) {
      const int other = 1 - fixed;
      Vector2 s;
      s[fixed] = bound;
      s[other] = std::clamp(-(g[other] + H(0, 1) * bound) / H(other, other), low[other], high[other]);
      const double value = g.dot(s) + 0.5 * s.dot(H * s);
      if (value < least) least = value, best = s;
    }
  return best;
}

SmoothRegion region_from_crease(const Space<2>& space, const Indices<2>& crease) {
  SmoothRegion region{crease, {}, {}};
  for (int i = 0; i < 2; ++i) {
    region.low[i] = space.knots(i).creases()[crease[i]];
    region.high[i] = space.knots(i).creases()[crease[i] + 1];
  }
  return region;
}

}  // namespace

SmoothRegion region_between_creases(const Space<2>& space, const Vector2& u) {
  Indices<2> crease;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& creases = space.knots(i).creases();
    const auto first = creases.begin() + 1, last = creases.end() - 1;
    crease[i] = static_cast<int>(std::upper_bound(first, last, u[i]) - first);
  }
  return region_from_crease(space, crease);
}

SmoothRegion region_of_element(const Space<2>& space, int element) {
  const Indices<2> indices = space.element_indices(element);
  Vector2 low, high;
  for (int i = 0; i < 2; ++i) {
    low[i] = space.knots(i).breaks()[indices[i]];
    high[i] = space.knots(i).breaks()[indices[i] + 1];
  }
  return {region_between_creases(space, low).crease, low, high};
}

FootSearch::FootSearch(const Space<2>& space, const NodalVectors& control_points, const Vector3& d,
                       const Vector2& u, const SmoothRegion& region)
    : space_(space), control_points_(control_points), d_(d), region_(region) {
  Vector2 start;
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    range_[i] = knots.back() - knots.front();
    ulp_[i] = kEpsilon * std::max(std::abs(knots.front()), std::abs(knots.back()));
    start[i] = std::clamp(u[i], region.low[i], region.high[i]);
  }
  at_ = sample(start, region);
}

// The active set: a parameter on a border of the region is held there while the gradient pushes it outward.
bool FootSearch::held(const DistanceSample& s, int i) const {
  return (s.u[i] == region_.low[i] && s.gradient[i] > 0.0) ||
         (s.u[i] == region_.high[i] && s.gradient[i] < 0.0);
}

double FootSearch::phi_round_off() const {
  return kRoundOff * at_.scale * (32.0 * at_.r.norm() + kEpsilon * at_.scale);
}

DistanceSample FootSearch::sample(const Vector2& u, const SmoothRegion& region) const {
  Indices<2> element;
  for (int i = 0; i < 2; ++i) {
    element[i] = space_.knots(i).element_at(u[i]);
    if (u[i] == region.high[i] && u[i] == space_.knots(i).breaks()[element[i]]) --element[i];
  }
  RationalBasis<2> basis;
  evaluate_on_element(space_, space_.element_index(element), {u[0], u[1]}, 2, basis);

  Vector3 S = Vector3::Zero(), S_i[2] = {S, S}, S_ij[3] = {S, S, S};
  for (int a = 0; a < basis.count; ++a) {
    const auto P = control_points_.col(basis.control_point[a]);
    S += basis.R[a] * P;
    for (int i = 0; i < 2; ++i) S_i[i] += basis.dR[i][a] * P;
    for (int k = 0; k < 3; ++k) S_ij[k] += basis.d2R[k][a] * P;
  }

  DistanceSample s;
  s.u = u;
  s.S = S;
  s.r = S - d_;
  s.phi = 0.5 * s.r.squaredNorm();
  s.gradient << s.r.dot(S_i[0]), s.r.dot(S_i[1]);
  s.metric << S_i[0].squaredNorm(), S_i[0].dot(S_i[1]), S_i[0].dot(S_i[1]), S_i[1].squaredNorm();
  s.hessian << s.r.dot(S_ij[0]), s.r.dot(S_ij[1]), s.r.dot(S_ij[1]), s.r.dot(S_ij[2]);
  s.hessian += s.metric;
  s.speed = s.metric.diagonal().cwiseSqrt();
  s.scale =
      S.lpNorm<Eigen::Infinity>() + s.r.lpNorm<Eigen::Infinity>() + s.speed.cwiseProduct(range_).maxCoeff();
  return s;
}

// The current parameters plus a step: inside the region, and exactly on its border where the step ends there.
Vector2 FootSearch::moved(const Vector2& step) const {
  Vector2 u = at_.u + step;
  for (int i = 0; i < 2; ++i) {
    if (u[i] <= region_.low[i] + ulp_[i]) u[i] = region_.low[i];
    if (u[i] >= region_.high[i] - ulp_[i]) u[i] = region_.high[i];
  }
  return u;
}

// Minimum of the quadratic model within the region.
Vector2 FootSearch::newton_step() const {
  const bool room[2] = {!held(at_, 0), !held(at_, 1)};
  Vector2 low = Vector2::Zero(), high = Vector2::Zero();
  for (int i = 0; i < 2; ++i)
    if (room[i]) low[i] = region_.low[i] - at_.u[i], high[i] = region_.high[i] - at_.u[i];

  const Matrix2 &H = at_.hessian, &A = at_.metric;
  const bool convex = (!room[0] || H(0, 0) > kLeastCurvature * A(0, 0)) &&
                      (!room[1] || H(1, 1) > kLeastCurvature * A(1, 1)) &&
                      (!room[0] || !room[1] || H.determinant() > kLeastCurvature * H(0, 0) * H(1, 1));
  if (convex) return box_step(at_.gradient, H, low, high);

  // Otherwise a diagonal model with curvatures of the right size (at poles, where a |S_i| vanishes, too),
  // trusted no farther than a quarter of the patch.
  Vector2 step;
  const double largest = A.diagonal().cwiseProduct(range_.cwiseAbs2()).maxCoeff();
  for (int i = 0; i < 2; ++i) {
    const double trusted = 0.25 * range_[i], least = 1e-12 * largest / (range_[i] * range_[i]);
    const double curvature = std::max({std::abs(H(i, i)), 0.1 * A(i, i), least});
    step[i] =
        std::clamp(-at_.gradient[i] / curvature, std::max(low[i], -trusted), std::min(high[i], trusted));
  }
  return step;
}

bool FootSearch::negligible(const Vector2& step) const {
  for (int i = 0; i < 2; ++i)
    if (std::abs(step[i]) > ulp_[i] && std::abs(step[i]) * at_.speed[i] > kRoundOff * at_.scale) return false;
  return true;
}

// How far d lies from the surface's normal at s, along the directions with room [length].
double FootSearch::tangential_distance(const DistanceSample& s) const {
  double largest = 0.0;
  for (int i = 0; i < 2; ++i)
    if (!held(s, i) && s.speed[i] > 0.0) largest = std::max(largest, std::abs(s.gradient[i]) / s.speed[i]);
  return largest;
}

// Where the expected decrease of phi drowns in round-off, the gradient is the judge.
bool FootSearch::better(const DistanceSample& trial, double expected) const {
  if (expected > phi_round_off()) return trial.phi <= at_.phi - 0.1 * expected;
  return tangential_distance(trial) < 0.5 * tangential_distance(at_);
}

bool FootSearch::descend() {
  for (Vector2 step = newton_step(); !negligible(step); step *= 0.5) {
    const DistanceSample trial = sample(moved(step), region_);
    if (better(trial, -at_.gradient.dot(step))) {
      at_ = trial;
      return true;
    }
  }
  return false;
}

// On a crease: goes on in the neighbouring region if that leads downhill.
bool FootSearch::cross_crease() {
  for (int i = 0; i < 2; ++i) {
    const int side = at_.u[i] == region_.low[i] ? -1 : at_.u[i] == region_.high[i] ? 1 : 0;
    Indices<2> crease = region_.crease;
    crease[i] += side;
    const int region_count = static_cast<int>(space_.knots(i).creases().size()) - 1;
    if (side == 0 || crease[i] < 0 || crease[i] >= region_count) continue;
    const SmoothRegion beyond = region_from_crease(space_, crease);
    const DistanceSample s = sample(at_.u, beyond);
    if (!(side * s.gradient[i] < -4.0 * kRoundOff * s.scale * s.speed[i])) continue;
    region_ = beyond;
    at_ = s;
    return true;
  }
  return false;
}

// On a saddle or maximum: a small step along the most negative curvature, to the better side.
bool FootSearch::leave_saddle() {
  constexpr double kClearlyNegative = -1e-6;
  Matrix2 C = Matrix2::Identity();  // curvature of phi per unit length, left at 1 where there is no room
  const auto free = [&](int i) {    // a slope of round-off holds nothing
    return at_.speed[i] > 0.0 &&
           (!held(at_, i) || std::abs(at_.gradient[i]) <= 64.0 * kRoundOff * at_.scale * at_.speed[i]);
  };
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (free(i) && free(j)) C(i, j) = at_.hessian(i, j) / (at_.speed[i] * at_.speed[j]);
  const double bound = std::min(C(0, 0), C(1, 1)) - std::abs(C(0, 1));  // of the eigenvalues (Gershgorin)
  if (bound > kClearlyNegative) return false;
  Eigen::SelfAdjointEigenSolver<Matrix2> eigen;
  eigen.computeDirect(C);
  if (!(eigen.eigenvalues()[0] < kClearlyNegative)) return false;

  Vector2 step = eigen.eigenvectors().col(0);
  for (int i = 0; i < 2; ++i) step[i] = at_.speed[i] > 0.0 ? step[i] / at_.speed[i] : 0.0;
  step /= 16.0 * step.cwiseQuotient(range_).lpNorm<Eigen::Infinity>();
  for (int halving = 0; halving < 12; ++halving, step *= 0.5)
    for (const double side : {1.0, -1.0}) {
      const DistanceSample trial = sample(moved(side * step), region_);
      if (trial.phi < at_.phi - phi_round_off()) {
        at_ = trial;
        return true;
      }
    }
  return false;
}

// On a pole, an edge j = const that is one point: all parameters i along it are the same foot, but each meets
// the surface in another direction.  Turns to the one that leads most steeply downhill.
bool FootSearch::leave_pole() {
  constexpr double kPole = 1e-9;  // length of the edge, relative
  constexpr int kSamples = 16;    // per region
  for (int j = 0; j < 2; ++j) {
    const int i = 1 - j;
    if (!held(at_, j) || at_.speed[i] * range_[i] > kPole * at_.scale) continue;
    const double inward = at_.u[j] == region_.low[j] ? 1.0 : -1.0;
    double steepest = -4.0 * kRoundOff * at_.scale;
    bool found = false;
    Indices<2> crease = region_.crease;
    for (crease[i] = 0; crease[i] + 1 < static_cast<int>(space_.knots(i).creases().size()); ++crease[i]) {
      const SmoothRegion sector = region_from_crease(space_, crease);
      for (int k = 0; k <= kSamples; ++k) {
        Vector2 u = at_.u;
        u[i] = sector.low[i] + (sector.high[i] - sector.low[i]) * k / kSamples;
        const DistanceSample s = sample(u, sector);
        const double slope = inward * s.gradient[j] / s.speed[j];
        if (slope < steepest) steepest = slope, at_ = s, region_ = sector, found = true;
      }
    }
    if (found) return true;
  }
  return false;
}

Projection FootSearch::result(int iterations, bool converged) const {
  constexpr double kFlush = 1e-10;  // relative: below it the two sides of a crease are one smooth surface
  constexpr ProjectionStatus kByBorders[] = {ProjectionStatus::interior, ProjectionStatus::edge,
                                             ProjectionStatus::corner};
  int borders = 0;
  for (int i = 0; i < 2; ++i) {
    const bool edge = at_.u[i] == space_.knots(i).front() || at_.u[i] == space_.knots(i).back();
    const bool crease = held(at_, i) && std::abs(at_.gradient[i]) > kFlush * at_.scale * at_.speed[i];
    if (edge || crease) ++borders;
  }
  const double distance = at_.r.norm();
  const bool found = converged && std::isfinite(distance);
  return {{at_.u[0], at_.u[1]},
          at_.S,
          distance,
          found ? kByBorders[borders] : ProjectionStatus::not_converged,
          iterations};
}

}  // namespace nurbs
