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

  /// Where slopes per length of an element are met, `a` on this side of a border and `b` beyond, which is
  /// 1/`ratio` as long: what the mean over windows of half a strip to both sides adds on the border.
  static constexpr double rounded(double a, double b, double ratio) {
    return 0.5 * kWidth * (b - a) / (1.0 + ratio);
  }

  /// What is added, of each polynomial of an element.
  struct Kinks {
    /// [direction][end]: on the border there, by powers of the other direction; empty where none goes on.
    std::array<std::array<std::vector<double>, 2>, 2> border;
    /// [end of s][end of t]: at the corner of four elements; empty beside others, where borders end.
    std::array<std::array<std::vector<double>, 2>, 2> corner;
  };

  BorderStrips() = default;  ///< changes nothing
  BorderStrips(const std::array<int, 2>& counts, int polynomials, const Kinks& kinks);

  bool reach(double s, double t) const {
    return std::max(std::abs(s), std::abs(t)) > 1.0 - kWidth && !numbers_.empty();
  }
  /// To values and derivatives of `count` polynomials from the first on.
  void add(double s, double t, int first, int count, double* value, double* by_s, double* by_t) const;

 private:
  template <int count>
  void add(double s, double t, int first, double* value, double* by_s, double* by_t) const;
  int append(const std::vector<double>& numbers);

  std::array<int, 2> counts_{};
  int polynomials_ = 0;
  std::array<std::array<int, 2>, 2> border_{}, corner_{};  // where they begin; -1: none
  std::vector<double> numbers_;                            // of each [power][polynomial]
};

}  // namespace structure
