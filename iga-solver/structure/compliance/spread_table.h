// SPDX-License-Identifier: GPL-2.0-or-later
// On one element of a body's skin, as polynomials: what a force gives way there that is spread over the net
// (net_mean.h), R + w Z, beside what compliance_table.h has of R.
#pragma once

#include <array>
#include <vector>

#include "structure/compliance/compliance_table.h"

namespace structure {

class SpreadTable {
 public:
  /// `one` and `both` (LocalProblem::OfSpread) of the components that a contact with friction asks for, along
  /// the normal less what links take; their second moment, the mean of both directions [length^2]; how far
  /// Z's nodes are above the foot in the undeformed body [length]; what links take of R along the normal, of
  /// R and Z, and of Z (cross_compliance.h) [length/force].
  enum Scalar {
    one = 0,
    both = ComplianceTable::kTogether,
    moment = 2 * ComplianceTable::kTogether,
    height,
    taken,
    taken_one,
    taken_both,
    kScalars
  };
  static constexpr int kPolynomials = kScalars;
  using Strips = BorderStrips<kPolynomials>;
  using Values = std::array<std::vector<double>, kScalars>;  ///< at table_points()

  SpreadTable(const std::array<int, 2>& counts, const Values& values);
  /// Where it goes on as those beside it.
  SpreadTable(const SpreadTable& other, const Strips& strips) : SpreadTable(other) { strips_ = strips; }
  const double* powers() const { return powers_.data(); }  ///< [scalar][of t][of s]
  /// As ComplianceTable::turn().
  static void turn(double* scalars, double c, double s) {
    ComplianceTable::turn_together(scalars + one, c, s);
    ComplianceTable::turn_together(scalars + both, c, s);
  }

  /// f(scalar, value) for each; on the element [low, high] of the parameters.
  template <class Function>
  void for_each(const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
                const nurbs::Parameter<2>& xi, Function f) const {
    for (int k = 0; k < kScalars; ++k) f(k, at(k, low, high, xi));
  }

 private:
  ComplianceTable::Value at(int scalar, const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high,
                            const nurbs::Parameter<2>& xi) const;

  std::array<int, 2> counts_;
  Strips strips_;
  std::vector<double> powers_;  // [scalar][of t][of s] in s, t from -1 to 1
};

}  // namespace structure
