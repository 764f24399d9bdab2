// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/simplex_brent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/bezier_element.h"
#include "search/box.h"
#include "search/brent.h"
#include "search/simplex.h"

namespace search {
namespace {

using Vector2 = Eigen::Vector2d;

// Lengths of parameters, in elements.
constexpr double kFirstEdge = 0.5;  // of the simplex: one that fits into any patch from any point of it
constexpr int kHalvings = 5;        // of the simplex, before Brent takes over
constexpr double kStep = 1.5e-8;    // difference step: square root of the round-off
constexpr double kLastStep = 1e-8;  // a sweep so short has squared an error that small
constexpr int kMostSimplexSteps = 25;

// The squared distance and its half gradient as functions of x, the parameters in elements from the guess.
class DistanceTo {
 public:
  DistanceTo(const Vector3& d, const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
             const Parameter<2>& guess)
      : d_(d), space_(space), control_points_(control_points) {
    for (int i = 0; i < 2; ++i) {
      const KnotVector& knots = space.knots(i);
      low_[i] = knots.front();
      high_[i] = knots.back();
      origin_[i] = std::clamp(guess[i], low_[i], high_[i]);
      const double* knot = &knots.breaks()[knots.element_at(origin_[i])];
      unit_[i] = knot[1] - knot[0];
    }
    element_.fetch(space, control_points, space.element_at({origin_[0], origin_[1]}));
  }

  Vector2 parameter(const Vector2& x) const { return origin_ + unit_.cwiseProduct(x); }
  bool inside(const Vector2& x) const {
    const Vector2 xi = parameter(x);
    return (low_.array() < xi.array()).all() && (xi.array() < high_.array()).all();
  }
  // Signs of the way from the guess to the middle of the patch.
  Vector2 inward() const {
    return ((low_ + high_ - 2.0 * origin_).array() < 0.0).select(-Vector2::Ones(), Vector2::Ones());
  }

  // |S - d|^2, infinite outside the patch: what the simplex descends.
  double operator()(const Vector2& x) const {
    const Vector2 xi = parameter(x);
    if ((xi.array() < low_.array()).any() || (high_.array() < xi.array()).any())
      return std::numeric_limits<double>::infinity();
    return (evaluate_at(x, 0).S - d_).squaredNorm();
  }

  // Eqs. 27 (j = 0) and 28 (j = 1), per element: the gradient of |S - d|^2 / 2.  A little outside the patch
  // its border elements go on, so differences need no special side there.
  double operator()(int j, const Vector2& x) const {
    const nurbs::BezierElement::PointAndTangent at = evaluate_at(x, j);
    return unit_[j] * at.S_j.dot(at.S - d_);
  }

  // The Hessian, by differences as in Brent's method, is positive definite: of the stationary points, a
  // minimum.
  bool convex(const Vector2& x) const {
    const DistanceTo& f = *this;
    const Vector2 x_0 = x + kStep * Vector2::UnitX(), x_1 = x + kStep * Vector2::UnitY();
    const double f_0 = f(0, x), f_1 = f(1, x);
    const double H_00 = f(0, x_0) - f_0, H_01 = f(0, x_1) - f_0, H_11 = f(1, x_1) - f_1;
    return H_00 > 0.0 && H_00 * H_11 > H_01 * H_01;
  }

  Foot foot_at(const Vector2& x, FootStatus status, int iterations) const {
    const Vector2 xi = parameter(x);
    const Vector3 foot = evaluate_at(x, 0).S;
    return {{xi[0], xi[1]}, foot, (d_ - foot).norm(), status, iterations};
  }

 private:
  nurbs::BezierElement::PointAndTangent evaluate_at(const Vector2& x, int j) const {
    const Vector2 xi = parameter(x);
    const Parameter<2> inside = {std::clamp(xi[0], low_[0], high_[0]), std::clamp(xi[1], low_[1], high_[1])};
    if (!element_.holds(inside)) element_.fetch(space_, control_points_, space_.element_at(inside));
    return element_.evaluate({xi[0], xi[1]}, j);
  }

  const Vector3& d_;
  const Space<2>& space_;
  const Eigen::Ref<const NodalVectors>& control_points_;
  Vector2 origin_, unit_, low_, high_;
  mutable nurbs::BezierElement element_;  // the last one visited
};

Foot brent_from(const DistanceTo& distance, const Vector2& start) {
  Vector2 x = start;
  int iterations = 0;
  bool converged = false;
  while (!converged && iterations < kMostSimplexSteps) {
    const Vector2 before = x;
    ++iterations;
    if (!brent_sweep(distance, kStep, x) || !distance.inside(x)) break;
    converged = (x - before).norm() <= kLastStep;
  }
  const Foot at_start = distance.foot_at(start, FootStatus::not_converged, iterations);
  if (!converged || !distance.convex(x)) return at_start;
  // A start that is the foot to round-off may be nearer by as little.
  const Foot foot = distance.foot_at(x, FootStatus::interior, iterations);
  const bool nearer = foot.distance <= at_start.distance || (x - start).norm() <= kLastStep;
  return nearer ? foot : at_start;
}

}  // namespace

Foot closest_point_simplex_brent(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                                 const Vector3& d, const Parameter<2>& guess, bool warm) {
  const DistanceTo distance(d, space, control_points, guess);
  const Vector2 origin = Vector2::Zero();
  if (warm) return brent_from(distance, origin);
  return brent_from(distance, simplex_minimum(distance, origin, kFirstEdge * distance.inward(), kHalvings));
}

Foot closest_point_simplex_brent_on_elements(const Space<2>& space,
                                             const Eigen::Ref<const NodalVectors>& control_points,
                                             const Vector3& d, const int* elements, int element_count) {
  if (element_count < 1) throw std::invalid_argument("no elements given, expected at least 1");
  Foot best{};
  best.distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < element_count; ++k) {
    const Box box = element_box(space, control_points, elements[k]);
    if (box.squared_distance(d) >= best.distance * best.distance) continue;
    const Foot foot =
        closest_point_simplex_brent(space, control_points, d, space.element_centre(elements[k]), false);
    if (foot.status == FootStatus::not_converged) return foot;
    if (foot.distance < best.distance) best = foot;
  }
  return best;
}

}  // namespace search
