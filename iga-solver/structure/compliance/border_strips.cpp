// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/border_strips.h"

#include "structure/compliance/table_kernel.h"

namespace structure {

namespace {

/// How far a place is in a strip: q from 0 to 1 on the border, and its derivative.
struct Depth {
  explicit Depth(double s)
      : q(std::max(0.0, (std::abs(s) - 1.0) / kStripWidth + 1.0)),
        by_s((s < 0.0 ? -1.0 : 1.0) / kStripWidth) {}
  double q, by_s;
};

}  // namespace

template <int polynomials>
BorderStrips<polynomials>::BorderStrips(const std::array<int, 2>& counts, const BorderKinks& kinks)
    : counts_(counts) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const std::vector<double>&border = kinks.border[a][b], &corner = kinks.corner[a][b];
      has_border_[a][b] = !border.empty();
      has_corner_[a][b] = !corner.empty();
      rounds_ = rounds_ || has_border_[a][b];
      const std::size_t powers = border.size() / polynomials;
      for (std::size_t power = 0; power < powers; ++power)
        for (int k = 0; k < polynomials; ++k)
          border_[a][b][power * polynomials + k] = border[power + k * powers];
      std::copy(corner.begin(), corner.end(), corner_[a][b].begin());
    }
}

template <int polynomials>
template <int count>
void BorderStrips<polynomials>::add(double s, double t, int first, double* value, double* by_s,
                                    double* by_t) const {
  const std::array<double, 2> own = {s, t};
  const std::array<int, 2> end = {end_of(s), end_of(t)};
  const std::array<Depth, 2> depth = {Depth(s), Depth(t)};
  const std::array<double*, 2> by = {by_s, by_t};
  const bool has_corner = has_corner_[end[0]][end[1]];
  for (int d = 0; d < 2; ++d) {
    const Depth &across = depth[d], &along = depth[1 - d];
    if (across.q == 0.0 || !has_border_[d][end[d]]) continue;
    // Beside fewer than four elements a border that ends there is let be.
    double fade = 1.0, fade_by = 0.0;
    if (!has_corner) {
      fade = (1.0 - along.q) * (1.0 - along.q) * (1.0 + 2.0 * along.q);
      fade_by = -6.0 * along.q * (1.0 - along.q) * along.by_s;
    }
    const double* const powers = border_[d][end[d]].data() + first;
    std::array<double, count> a{}, a_by{};
    for (int j = counts_[1 - d] - 1; j >= 0; --j)
      for (int k = 0; k < count; ++k) {
        a_by[k] = a_by[k] * own[1 - d] + a[k];
        a[k] = a[k] * own[1 - d] + powers[j * polynomials + k];
      }
    const double q2 = across.q * across.q, q2_by = 2.0 * across.q * across.by_s;
    for (int k = 0; k < count; ++k) {
      value[k] += a[k] * fade * q2;
      by[d][k] += a[k] * fade * q2_by;
      by[1 - d][k] += (a_by[k] * fade + a[k] * fade_by) * q2;
    }
  }
  const double q_s = depth[0].q, q_t = depth[1].q;
  if (!has_corner || q_s == 0.0 || q_t == 0.0) return;
  for (int k = 0; k < count; ++k) {
    const double change = corner_[end[0]][end[1]][first + k];
    value[k] += change * q_s * q_s * q_t * q_t;
    by_s[k] += 2.0 * change * q_s * depth[0].by_s * q_t * q_t;
    by_t[k] += 2.0 * change * q_s * q_s * q_t * depth[1].by_s;
  }
}

template <int polynomials>
void BorderStrips<polynomials>::add(double s, double t, int first, int count, double* value, double* by_s,
                                    double* by_t) const {
  constexpr int kTogether = FourPolynomials::kCount;
  if (count == kTogether) return add<kTogether>(s, t, first, value, by_s, by_t);
  for (int k = 0; k < count; ++k) add<1>(s, t, first + k, value + k, by_s + k, by_t + k);
}

// Tables with other numbers of polynomials do not link.
template class BorderStrips<6>;   // ComplianceTable
template class BorderStrips<13>;  // SpreadTable

}  // namespace structure
