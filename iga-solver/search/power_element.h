// SPDX-License-Identifier: GPL-2.0-or-later
// Surface elements as polynomials in local coordinates s = (s_0, s_1), -1 <= s_i <= 1:
//   S(s) - O = A(s) / W(s),  A = sum_ij a_ij s_0^i s_1^j, W likewise,
// relative to the element's own origin O (one of its control points), so that a surface far from the origin
// of space loses no digits.  Polynomial patches have no W.  Source: Piegl & Tiller (1997), section 6.6.
#pragma once

#include <algorithm>
#include <vector>

#include "search/names.h"
#include "search/power_kernel.h"

namespace search {

/// (A_x, A_y, A_z, W), or (A_x, A_y, A_z, 0) where the patch is polynomial.
using Vector4 = Eigen::Array4d;

/// One element of one direction: eight numbers, of which kernels read four.
struct AxisElement {
  double begin, end;  ///< its knots
  double half_width;  ///< d xi / d s
  double per_half_width;
  double low, high;  ///< local coordinates of the creases or ends before and after; -1, 1 if its own ends
  const nurbs::ElementFunctions* functions;
  int first;       ///< index of its first control point
  bool at_end[2];  ///< begin, end is an end of the patch

  double parameter(double s) const {
    return s <= -1.0 ? begin : s >= 1.0 ? end : begin + half_width * (1.0 + s);
  }
  /// The coordinate s nearest to xi.
  double local(double xi) const {
    return xi <= begin ? -1.0 : xi >= end ? 1.0 : (xi - begin) * per_half_width - 1.0;
  }
};
static_assert(sizeof(AxisElement) == 8 * sizeof(double), "the rows of AxisNumbers");

/// The elements of one direction.
class ElementAxis {
 public:
  ElementAxis(const Space<2>& space, int direction);
  ElementAxis(const ElementAxis&) = delete;
  ElementAxis& operator=(const ElementAxis&) = delete;
  int count() const { return count_; }
  const AxisElement& operator[](int e) const { return elements_[e]; }
  const AxisNumbers& numbers() const { return numbers_; }
  /// Whether a parameter is that of an end of the patch (it may be, by rounding, where |s| < 1).
  bool at_patch_end(double xi) const { return xi <= numbers_.front || numbers_.back <= xi; }
  struct Place {
    int e;
    double s;
  };
  /// The element of a parameter (KnotVector::element_at), and where in it.
  Place locate(double xi) const {
    // As if all elements were equal; a search where they are not.
    const double place = (xi - numbers_.front) * numbers_.elements_per_length;
    const int e = static_cast<int>(std::min(std::max(0.0, place), numbers_.last));
    const AxisElement& element = elements_[e];
    if (element.begin <= xi && xi < element.end)
      return {e, (xi - element.begin) * element.per_half_width - 1.0};
    return search(xi);
  }

 private:
  Place search(double xi) const;

  const KnotVector& knots_;
  int count_;
  std::vector<AxisElement> elements_;
  AxisNumbers numbers_;
};

}  // namespace search
