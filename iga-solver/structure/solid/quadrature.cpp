// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/solid/enum_words.h"

namespace structure {

namespace {

constexpr const char* kNames[] = {"full", "reduced", "zou"};

int multiplicity(const nurbs::KnotVector& knots, int brk) {
  return static_cast<int>(std::count(knots.knots().begin(), knots.knots().end(), knots.breaks()[brk]));
}

int points_of_span(const nurbs::KnotVector& knots, int span, Quadrature quadrature) {
  const int p = knots.degree();
  if (quadrature == Quadrature::full) return p + 1;
  const int before = multiplicity(knots, span), after = multiplicity(knots, span + 1);
  if (before >= p && after >= p) return p + 1;
  const bool is_smooth = before == 1 && after == 1;
  return quadrature == Quadrature::zou && is_smooth ? p - 1 : p;
}

}  // namespace

const char* name(Quadrature quadrature) { return kNames[static_cast<int>(quadrature)]; }

Quadrature quadrature_from_name(const std::string& word) {
  return enum_from_name<Quadrature>("quadrature", kNames, word);
}

std::vector<nurbs::QuadratureRule> rules_of(const nurbs::KnotVector& knots, Quadrature quadrature) {
  const int p = knots.degree();
  if (quadrature == Quadrature::zou && p != 2 && p != 3)
    throw std::invalid_argument(fmt::format(
        "quadrature is 'zou' and a degree is {}, expected degrees 2 and 3 (or 'full', 'reduced')", p));
  std::vector<nurbs::QuadratureRule> rules;
  for (int span = 0; span < knots.element_count(); ++span)
    rules.push_back(nurbs::gauss_legendre(points_of_span(knots, span, quadrature), knots.breaks()[span],
                                          knots.breaks()[span + 1]));
  return rules;
}

int points_per_element(const nurbs::Space<3>& space, Quadrature quadrature) {
  int points = 1;
  for (const nurbs::KnotVector& knots : space.knots()) {
    int most = 0;
    for (const nurbs::QuadratureRule& rule : rules_of(knots, quadrature))
      most = std::max(most, static_cast<int>(rule.points.size()));
    points *= most;
  }
  return points;
}

}  // namespace structure
