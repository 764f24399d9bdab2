// SPDX-License-Identifier: GPL-2.0-or-later
// Where one element goes on as the next, their tables have the same values but not the same slopes, as each
// has its own patch; a ball that stands there would be rocked.  Narrow strips beside the border take up the
// kink: in each direction the polynomials' mean over a window whose middle goes from the strip's end, where
// it is a point, to the border.  Nothing changes inside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace structure {

class BorderStrips {
 public:
  /// How wide one is in an element's own parameters, which go from -1 to 1.  What a kink leaves in c is as
  /// wide as strips are: 0.05 % of it on cubes.  A ball of the least elements is still rocked in strips a
  /// quarter as wide, as its foot goes by the surface's tilt; no more in those of 0.05.
  static constexpr double kWidth = 0.08;

  /// An element: its polynomials by their powers, [polynomial][of t][of s], null if there is none; and how
  /// long it is in the patch's parameters.
  struct Element {
    const double* powers = nullptr;
    std::array<double, 2> length{};
  };
  /// [of t][of s]: an element in the middle, and those that go on from it.
  using Block = std::array<std::array<Element, 3>, 3>;

  BorderStrips() = default;  ///< changes nothing
  BorderStrips(const std::array<int, 2>& counts, int polynomials, const Block& block);

  bool reach(double s, double t) const {
    return std::max(std::abs(s), std::abs(t)) > 1.0 - kWidth && !borders_.empty();
  }
  /// To values and derivatives of `count` polynomials from the first on.
  void add(double s, double t, int first, int count, double* value, double* by_s, double* by_t) const;

 private:
  static int corner(int end_of_s, int end_of_t) { return end_of_s + 2 * end_of_t; }
  /// Where the changes of the border at an end of direction d are: [polynomial][of the other direction].
  int border(int d, int end) const { return polynomials_ * (2 * d * counts_[1] + end * counts_[1 - d]); }

  std::array<int, 2> counts_{};
  int polynomials_ = 0;
  std::vector<double> borders_, corners_;  // corners_: [corner][polynomial]
  std::array<bool, 4> is_among_four_{};    // [corner]: of elements that go on from each other
};

}  // namespace structure
