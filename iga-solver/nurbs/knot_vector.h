// SPDX-License-Identifier: GPL-2.0-or-later
// Open (clamped) knot vectors.  Source: Piegl & Tiller, The NURBS Book, 2nd ed. (1997), chapter 2.
#pragma once

#include <vector>

#include "nurbs/types.h"

namespace nurbs {

/// Open knot vector of degree p: first and last knot p+1 times, interior knots at most p times (C0 or
/// smoother), any spacing.  An *element* is a knot span of positive length; elements are counted from 0.
class KnotVector {
 public:
  /// Throws std::invalid_argument, saying what was given and what was expected, unless 1 <= degree <=
  /// kMaxDegree, the knots are finite and non-decreasing, open, and no interior multiplicity exceeds the
  /// degree.
  KnotVector(int degree, std::vector<double> knots);

  /// Open knot vector with simple interior knots at the given strictly increasing breakpoints (graded
  /// meshes).
  static KnotVector from_breaks(int degree, const std::vector<double>& breaks);
  /// Open knot vector with `elements` equal spans on [first, last].
  static KnotVector uniform(int degree, int elements, double first = 0.0, double last = 1.0);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  int control_point_count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  double front() const { return knots_.front(); }
  double back() const { return knots_.back(); }

  /// Distinct knots, element_count() + 1 of them: element e is [breaks()[e], breaks()[e+1]].
  const std::vector<double>& breaks() const { return breaks_; }
  int element_count() const { return static_cast<int>(breaks_.size()) - 1; }
  /// First knot, the interior knots of multiplicity p (only there may a patch have a kink), last knot.
  const std::vector<double>& creases() const { return creases_; }
  /// Knot index i of element e: knots()[i] = breaks()[e] < knots()[i+1].
  int span_of_element(int element) const { return span_of_element_[element]; }
  /// Element that holds xi (clamped to the domain; a knot belongs to the element right of it, the last to the
  /// left).
  int element_at(double xi) const {
    // The element it would be in if all were equal, or a search.
    const double place = (xi - breaks_.front()) * elements_per_length_;
    const int last = element_count() - 1,
              guess = place < last ? (place > 0.0 ? static_cast<int>(place) : 0) : last;
    return breaks_[guess] <= xi && xi < breaks_[guess + 1] ? guess : search_element(xi);
  }
  /// Knot index i with knots()[i] <= xi < knots()[i+1] (algorithm A2.1, clamped as element_at).
  int find_span(double xi) const { return span_of_element_[element_at(xi)]; }

  /// Greville abscissae, one per control point: control points placed there reproduce x(xi) = xi.
  std::vector<double> greville() const;

  bool operator==(const KnotVector& other) const {
    return degree_ == other.degree_ && knots_ == other.knots_;
  }

 private:
  int search_element(double xi) const;

  int degree_;
  std::vector<double> knots_;
  std::vector<double> breaks_;
  std::vector<double> creases_;
  std::vector<int> span_of_element_;
  double elements_per_length_;
};

}  // namespace nurbs
