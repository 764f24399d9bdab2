// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/border_strips.h"

#include <cstddef>

namespace structure {

namespace {

/// How far a place is in a strip: q from 0 to 1 on the border, and its derivative.
struct Depth {
  explicit Depth(double s)
      : end(s < 0.0 ? 0 : 1),
        q(std::max(0.0, (std::abs(s) - 1.0) / BorderStrips::kWidth + 1.0)),
        by_s((end == 0 ? -1.0 : 1.0) / BorderStrips::kWidth) {}
  int end;
  double q, by_s;
};

}  // namespace

BorderStrips::BorderStrips(const std::array<int, 2>& counts, int polynomials, const Kinks& kinks)
    : counts_(counts), polynomials_(polynomials) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      border_[a][b] = append(kinks.border[a][b]);
      corner_[a][b] = append(kinks.corner[a][b]);
    }
}

int BorderStrips::append(const std::vector<double>& numbers) {
  if (numbers.empty()) return -1;
  const std::size_t begin = numbers_.size(), powers = numbers.size() / polynomials_;
  for (std::size_t power = 0; power < powers; ++power)
    for (int k = 0; k < polynomials_; ++k) numbers_.push_back(numbers[power + k * powers]);
  return static_cast<int>(begin);
}

template <int count>
void BorderStrips::add(double s, double t, int first, double* value, double* by_s, double* by_t) const {
  const std::array<double, 2> own = {s, t};
  const std::array<Depth, 2> depth = {Depth(s), Depth(t)};
  const std::array<double*, 2> by = {by_s, by_t};
  const int corner = corner_[depth[0].end][depth[1].end];
  for (int d = 0; d < 2; ++d) {
    const Depth &across = depth[d], &along = depth[1 - d];
    if (across.q == 0.0 || border_[d][across.end] < 0) continue;
    // Beside fewer than four elements a border that ends there is let be.
    double fade = 1.0, fade_by = 0.0;
    if (corner < 0) {
      fade = (1.0 - along.q) * (1.0 - along.q) * (1.0 + 2.0 * along.q);
      fade_by = -6.0 * along.q * (1.0 - along.q) * along.by_s;
    }
    const double* const powers = numbers_.data() + border_[d][across.end] + first;
    std::array<double, count> a{}, a_by{};
    for (int j = counts_[1 - d] - 1; j >= 0; --j)
      for (int k = 0; k < count; ++k) {
        a_by[k] = a_by[k] * own[1 - d] + a[k];
        a[k] = a[k] * own[1 - d] + powers[j * polynomials_ + k];
      }
    const double q2 = across.q * across.q, q2_by = 2.0 * across.q * across.by_s;
    for (int k = 0; k < count; ++k) {
      value[k] += a[k] * fade * q2;
      by[d][k] += a[k] * fade * q2_by;
      by[1 - d][k] += (a_by[k] * fade + a[k] * fade_by) * q2;
    }
  }
  const double q_s = depth[0].q, q_t = depth[1].q;
  if (corner < 0 || q_s == 0.0 || q_t == 0.0) return;
  for (int k = 0; k < count; ++k) {
    const double change = numbers_[corner + first + k];
    value[k] += change * q_s * q_s * q_t * q_t;
    by_s[k] += 2.0 * change * q_s * depth[0].by_s * q_t * q_t;
    by_t[k] += 2.0 * change * q_s * q_s * q_t * depth[1].by_s;
  }
}

void BorderStrips::add(double s, double t, int first, int count, double* value, double* by_s,
                       double* by_t) const {
  constexpr int kTogether = 4;
  if (count == kTogether) return add<kTogether>(s, t, first, value, by_s, by_t);
  for (int k = 0; k < count; ++k) add<1>(s, t, first + k, value + k, by_s + k, by_t + k);
}

}  // namespace structure
