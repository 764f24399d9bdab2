// SPDX-License-Identifier: GPL-2.0-or-later
// Where one element goes on as the next, their tables have the same values but not the same slopes, as each
// has its own patch; a ball that stands there would be rocked.  Narrow strips beside the border take up the
// kink: in each direction the polynomials' mean over a window whose middle goes from the strip's end, where
// it is a point, to the border.  Nothing changes inside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace structure {

/// How wide a strip is in an element's own parameters, which go from -1 to 1.  What a kink leaves in c is as
/// wide as strips are: 0.05 % of it on cubes.  A ball of the least elements is still rocked in strips a
/// quarter as wide, as its foot goes by the surface's tilt; no more in those of 0.05.
constexpr double kStripWidth = 0.08;

/// Where slopes per length of an element are met, `a` on this side of a border and `b` beyond, which is
/// 1/`ratio` as long: what the mean over windows of half a strip to both sides adds on the border.
constexpr double kink_of_slopes(double a, double b, double ratio) {
  return 0.5 * kStripWidth * (b - a) / (1.0 + ratio);
}

/// What strips add, of each polynomial of an element.
struct BorderKinks {
  /// [direction][end]: on the border there, by powers of the other direction; empty where none goes on.
  std::array<std::array<std::vector<double>, 2>, 2> border;
  /// [end of s][end of t]: at the corner of four elements; empty beside others, where borders end.
  std::array<std::array<std::vector<double>, 2>, 2> corner;
};

/// Of so many polynomials, in one piece, as they come from memory for each contact.
template <int polynomials>
class BorderStrips {
 public:
  BorderStrips() = default;  ///< changes nothing
  BorderStrips(const std::array<int, 2>& counts, const BorderKinks& kinks);

  bool reach(double s, double t) const { return rounds_ && is_in_one(s, t); }
  /// To values and derivatives of `count` polynomials from the first on.
  void add(double s, double t, int first, int count, double* value, double* by_s, double* by_t) const;
  /// As ComplianceTable::prefetch(), of quadratic elements.
  [[gnu::always_inline]] void prefetch(double s, double t) const {
    if (!is_in_one(s, t)) return;
    __builtin_prefetch(this);
    constexpr std::size_t kLine = 64, kBytes = sizeof(double) * 5 * polynomials;
    const std::array<double, 2> own = {s, t};
    for (int d = 0; d < 2; ++d) {
      if (!is_in_one(own[d], 0.0)) continue;
      const char* const begin = reinterpret_cast<const char*>(border_[d][end_of(own[d])].data());
      for (std::size_t byte = 0; byte <= kBytes; byte += kLine) __builtin_prefetch(begin + byte);
    }
  }

 private:
  static constexpr int kMost = 7;  // powers: of degree 3
  static bool is_in_one(double s, double t) { return std::max(std::abs(s), std::abs(t)) > 1.0 - kStripWidth; }
  static int end_of(double s) { return s < 0.0 ? 0 : 1; }
  template <int count>
  void add(double s, double t, int first, double* value, double* by_s, double* by_t) const;

  bool rounds_ = false;  // any
  std::array<std::array<bool, 2>, 2> has_border_{}, has_corner_{};
  std::array<int, 2> counts_{};
  std::array<std::array<std::array<double, polynomials>, 2>, 2> corner_{};
  // [direction][end][power][polynomial]
  std::array<std::array<std::array<double, kMost * polynomials>, 2>, 2> border_{};
};

}  // namespace structure
