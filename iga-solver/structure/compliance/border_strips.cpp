// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/border_strips.h"

#include <cstddef>

namespace structure {

namespace {

constexpr double sign(int end) { return end == 0 ? -1.0 : 1.0; }

/// Where slopes per element of `a` and of `b` are met, a kink at 0: what its mean over windows of half a
/// strip to both sides adds there, if a strip is kWidth of half an element.
double rounded(double a, double length_of_a, double b, double length_of_b) {
  return 0.5 * BorderStrips::kWidth * (b * length_of_a - a * length_of_b) / (length_of_a + length_of_b);
}

/// Slope across the border at an end of direction d of one polynomial, by powers of the other direction.
std::vector<double> slope_across(const double* powers, const std::array<int, 2>& counts, int d, int end) {
  std::vector<double> slope(counts[1 - d], 0.0);
  for (int along = 0; along < counts[1 - d]; ++along) {
    double power = 1.0;
    for (int k = 1; k < counts[d]; ++k, power *= sign(end))
      slope[along] += k * power * powers[d == 0 ? k + counts[0] * along : along + counts[0] * k];
  }
  return slope;
}

/// Slope of a polynomial by its powers at an end of [-1, 1].
double end_slope(const std::vector<double>& powers, int end) {
  double slope = 0.0, power = 1.0;
  for (std::size_t k = 1; k < powers.size(); ++k, power *= sign(end))
    slope += static_cast<double>(k) * power * powers[k];
  return slope;
}

/// What a border's strips have on the border, of one polynomial, by powers of the direction along it.
std::vector<double> change(const BorderStrips::Element& low, const BorderStrips::Element& high, int d,
                           const std::array<int, 2>& counts, int polynomial) {
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(polynomial) * counts[0] * counts[1];
  std::vector<double> a = slope_across(low.powers + offset, counts, d, 1);
  const std::vector<double> b = slope_across(high.powers + offset, counts, d, 0);
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = rounded(a[k], low.length[d], b[k], high.length[d]);
  return a;
}

/// How far a place is in a strip: q from 0 to 1 on the border, and its derivative.
struct Depth {
  explicit Depth(double s)
      : end(s < 0.0 ? 0 : 1),
        q(std::max(0.0, (std::abs(s) - 1.0) / BorderStrips::kWidth + 1.0)),
        by_s(sign(end) / BorderStrips::kWidth) {}
  int end;
  double q, by_s;
};

}  // namespace

BorderStrips::BorderStrips(const std::array<int, 2>& counts, int polynomials, const Block& block)
    : counts_(counts),
      polynomials_(polynomials),
      borders_(2 * static_cast<std::size_t>(polynomials) * (counts[0] + counts[1]), 0.0),
      corners_(4 * static_cast<std::size_t>(polynomials), 0.0) {
  // Of the two elements at a border of an element in a row or column of the block.
  const auto pair = [&](int d, int end, int other) {
    const auto at = [&](int k) { return d == 0 ? block[other][k] : block[k][other]; };
    return std::array{at(end), at(end + 1)};
  };
  for (int k = 0; k < polynomials; ++k)
    for (int d = 0; d < 2; ++d)
      for (int end = 0; end < 2; ++end) {
        const auto [low, high] = pair(d, end, 1);
        if (!low.powers || !high.powers) continue;
        const std::vector<double> powers = change(low, high, d, counts, k);
        std::copy(powers.begin(), powers.end(), borders_.begin() + border(d, end) + k * counts[1 - d]);
      }
  for (int s = 0; s < 2; ++s)
    for (int t = 0; t < 2; ++t) {
      const auto below = pair(0, s, t), above = pair(0, s, t + 1);
      is_among_four_[corner(s, t)] = below[0].powers && below[1].powers && above[0].powers && above[1].powers;
      if (!is_among_four_[corner(s, t)]) continue;
      for (int k = 0; k < polynomials; ++k)
        corners_[corner(s, t) * polynomials + k] =
            rounded(end_slope(change(below[0], below[1], 0, counts, k), 1), below[s].length[1],
                    end_slope(change(above[0], above[1], 0, counts, k), 0), above[s].length[1]);
    }
}

void BorderStrips::add(double s, double t, int first, int count, double* value, double* by_s,
                       double* by_t) const {
  const std::array<double, 2> own = {s, t};
  const std::array<Depth, 2> depth = {Depth(s), Depth(t)};
  const std::array<double*, 2> by = {by_s, by_t};
  const int at = corner(depth[0].end, depth[1].end);
  for (int d = 0; d < 2; ++d) {
    const Depth &across = depth[d], &along = depth[1 - d];
    if (across.q == 0.0) continue;
    // Beside fewer than four elements a border that ends there is let be.
    double fade = 1.0, fade_by = 0.0;
    if (!is_among_four_[at]) {
      fade = (1.0 - along.q) * (1.0 - along.q) * (1.0 + 2.0 * along.q);
      fade_by = -6.0 * along.q * (1.0 - along.q) * along.by_s;
    }
    const double* powers = borders_.data() + border(d, across.end) + first * counts_[1 - d];
    for (int k = 0; k < count; ++k, powers += counts_[1 - d]) {
      double a = 0.0, a_by = 0.0;
      for (int j = counts_[1 - d] - 1; j >= 0; --j) {
        a_by = a_by * own[1 - d] + a;
        a = a * own[1 - d] + powers[j];
      }
      a_by = a_by * fade + a * fade_by;
      a *= fade;
      value[k] += a * across.q * across.q;
      by[d][k] += 2.0 * a * across.q * across.by_s;
      by[1 - d][k] += a_by * across.q * across.q;
    }
  }
  const double q_s = depth[0].q, q_t = depth[1].q;
  for (int k = 0; k < count; ++k) {
    const double change = corners_[at * polynomials_ + first + k];
    value[k] += change * q_s * q_s * q_t * q_t;
    by_s[k] += 2.0 * change * q_s * depth[0].by_s * q_t * q_t;
    by_t[k] += 2.0 * change * q_s * q_s * q_t * depth[1].by_s;
  }
}

}  // namespace structure
