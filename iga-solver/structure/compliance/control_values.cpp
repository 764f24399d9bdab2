// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/control_values.h"

#include <algorithm>
#include <limits>

namespace structure {

namespace {

struct DirectionTerm {
  double xi, weight;
};

/// Of one function of a direction: three points from the first to the last of its inner knots t_1, ..., t_p,
/// with weights that give the blossom of 1, xi and xi^2 at these knots (quasi-interpolation: Lyche &
/// Schumaker 1975, J. Approx. Theory 15, 294-325).
std::vector<DirectionTerm> direction_terms(const nurbs::KnotVector& knots, int function) {
  const int p = knots.degree();
  const double* const t = knots.knots().data() + function + 1;
  const double middle = 0.5 * (t[0] + t[p - 1]), half = 0.5 * (t[p - 1] - t[0]);
  if (half == 0.0) return {{middle, 1.0}};
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < p; ++i) {
    const double s = (t[i] - middle) / half;
    sum += s;
    squares += s * s;
  }
  const double first = sum / p, second = (sum * sum - squares) / (p * (p - 1.0));
  return {{t[0], 0.5 * (second - first)}, {middle, 1.0 - second}, {t[p - 1], 0.5 * (second + first)}};
}

}  // namespace

ControlValues::Place ControlValues::place(int patch, const nurbs::Parameter<3>& xi) {
  const auto [found, is_new] = places_.insert({{patch, xi}, {}});
  if (is_new) {
    const nurbs::Volume& volume = body_.patches[patch];
    nurbs::RationalBasis<3> basis;
    nurbs::evaluate(volume.space, xi, 0, basis);
    found->second = {static_cast<int>(points_.size()), 1.0};
    if (volume.space.rational()) {  // R_A = w_A N_A / W, and the R_A / w_A sum up to 1 / W
      double inverse_W = 0.0;
      for (int a = 0; a < basis.count; ++a)
        inverse_W += basis.R[a] / volume.space.weight(basis.control_point[a]);
      found->second.W = 1.0 / inverse_W;
    }
    points_.push_back(nurbs::interpolate(basis, volume.control_points));
  }
  return found->second;
}

// Of a rational patch W u is a spline whose control values are w_A u_A.
std::vector<ControlValues::Term> ControlValues::terms_of(Id node) {
  const auto [patch, control_point] = body_.nodes.place(node);
  const nurbs::Space<3>& space = body_.patches[patch].space;
  std::vector<DirectionTerm> terms[3];
  for (int d = 0, rest = control_point; d < 3; rest /= space.control_point_count(d++))
    terms[d] = direction_terms(space.knots(d), rest % space.control_point_count(d));
  std::vector<Term> sum;
  for (const auto& [zeta, in_zeta] : terms[2])
    for (const auto& [eta, in_eta] : terms[1])
      for (const auto& [xi, in_xi] : terms[0]) {
        const Place at = place(patch, {xi, eta, zeta});
        sum.push_back({at.point, in_xi * in_eta * in_zeta * at.W / space.weight(control_point)});
      }
  return sum;
}

void ControlValues::add(Id node) { sums_.push_back(terms_of(node)); }

double ControlValues::nearest(Id node, const Vector3& to) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Term& term : terms_of(node)) distance = std::min(distance, (points_[term.point] - to).norm());
  return distance;
}

}  // namespace structure
