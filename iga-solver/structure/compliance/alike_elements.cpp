// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/alike_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "structure/sweep/affine_map.h"

namespace structure {

namespace {

double span(const nurbs::KnotVector& knots, int element) {
  return knots.breaks()[element + 1] - knots.breaks()[element];
}

/// How many elements on one side (step -1 or 1) of an element count: `least`, and as many as begin within
/// `distance` of it; nothing if the end of the knots comes first.
std::optional<int> elements_within(const nurbs::KnotVector& knots, int element, int step, int least,
                                   double distance) {
  double way = 0.0;
  for (int count = 0;; ++count) {
    if (count >= least && way > distance) return count;
    const int next = element + step * (count + 1);
    if (next < 0 || next >= knots.element_count()) return std::nullopt;
    way += span(knots, next);
  }
}

struct Surroundings {
  int element, before, after;
};

bool alike(const nurbs::KnotVector& knots, const Surroundings& a, const Surroundings& b) {
  constexpr double kSame = 1e-9;
  if (a.before != b.before || a.after != b.after) return false;
  const double size = span(knots, a.element);
  for (int k = -a.before; k <= a.after; ++k) {
    const int e = a.element + k, f = b.element + k;
    if (std::abs(span(knots, e) - span(knots, f)) > kSame * size) return false;
    if (k < a.after && knots.span_of_element(e + 1) - knots.span_of_element(e) !=
                           knots.span_of_element(f + 1) - knots.span_of_element(f))
      return false;
  }
  return true;
}

}  // namespace

std::vector<int> alike_elements(const nurbs::Volume& patch, int direction, const LocalExtent& extent) {
  const nurbs::KnotVector& knots = patch.space.knots(direction);
  std::vector<int> first(knots.element_count());
  std::iota(first.begin(), first.end(), 0);
  const std::optional<Matrix3> J = affine_jacobian(patch);
  if (!J) return first;
  double longest = 0.0;
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < patch.space.knots(d).element_count(); ++e)
      longest = std::max(longest, span(patch.space.knots(d), e) * J->col(d).norm());
  const double distance = extent.layers * extent.reach * longest / J->col(direction).norm();
  const int least = extent.layers + knots.degree();
  std::vector<Surroundings> different;
  for (int e = 0; e < knots.element_count(); ++e) {
    const auto before = elements_within(knots, e, -1, least, distance),
               after = elements_within(knots, e, 1, least, distance);
    if (!before || !after) continue;
    const Surroundings here{e, *before, *after};
    const auto same = std::find_if(different.begin(), different.end(),
                                   [&](const Surroundings& other) { return alike(knots, here, other); });
    if (same == different.end())
      different.push_back(here);
    else
      first[e] = same->element;
  }
  return first;
}

}  // namespace structure
