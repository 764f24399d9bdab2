// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/border_strips.h"

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

int append(const std::vector<double>& numbers, std::vector<double>& to) {
  if (numbers.empty()) return -1;
  const auto begin = static_cast<int>(to.size());
  to.insert(to.end(), numbers.begin(), numbers.end());
  return begin;
}

}  // namespace

BorderStrips::BorderStrips(const std::array<int, 2>& counts, const Kinks& kinks) : counts_(counts) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      border_[a][b] = append(kinks.border[a][b], borders_);
      corner_[a][b] = append(kinks.corner[a][b], corners_);
    }
}

void BorderStrips::add(double s, double t, int first, int count, double* value, double* by_s,
                       double* by_t) const {
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
    const double* powers = borders_.data() + border_[d][across.end] + first * counts_[1 - d];
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
  if (corner < 0) return;
  const double q_s = depth[0].q, q_t = depth[1].q;
  for (int k = 0; k < count; ++k) {
    const double change = corners_[corner + first + k];
    value[k] += change * q_s * q_s * q_t * q_t;
    by_s[k] += 2.0 * change * q_s * depth[0].by_s * q_t * q_t;
    by_t[k] += 2.0 * change * q_s * q_s * q_t * depth[1].by_s;
  }
}

}  // namespace structure
