// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/compliance_table.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "structure/compliance/table_polynomial.h"

namespace structure {

std::vector<double> lobatto_points(int count) {
  std::vector<double> points(count);
  for (int i = 0; i < count; ++i) points[i] = -std::cos(nurbs::kPi * i / (count - 1));
  return points;
}

std::array<int, 2> table_counts(const nurbs::Space<2>& space) {
  return {2 * space.degree(0) + 1, 2 * space.degree(1) + 1};
}

std::vector<nurbs::Parameter<2>> table_points(const nurbs::Space<2>& space, int element) {
  const std::array<int, 2> counts = table_counts(space);
  const nurbs::Indices<2> span = space.element_indices(element);
  std::array<std::vector<double>, 2> along;
  for (int d = 0; d < 2; ++d) {
    const std::vector<double>& breaks = space.knots(d).breaks();
    for (const double s : lobatto_points(counts[d]))
      along[d].push_back(0.5 * ((1.0 - s) * breaks[span[d]] + (1.0 + s) * breaks[span[d] + 1]));
  }
  std::vector<nurbs::Parameter<2>> points;
  for (const double eta : along[1])
    for (const double xi : along[0]) points.push_back({xi, eta});
  return points;
}

Eigen::MatrixXd lobatto_powers(int count) {
  const std::vector<double> points = lobatto_points(count);
  Eigen::MatrixXd powers(count, count);
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) powers(i, k) = std::pow(points[i], k);
  return powers.inverse();
}

ComplianceTable::ComplianceTable(const std::array<int, 2>& counts,
                                 const std::vector<std::vector<double>>& values,
                                 const std::vector<double>& taken)
    : kernel_(table_kernel(nurbs::simd_level())),
      counts_(counts),
      largest_normal_(*std::max_element(values[normal].begin(), values[normal].end())) {
  const Eigen::MatrixXd of_s = lobatto_powers(counts[0]), of_t = lobatto_powers(counts[1]);
  double* next = powers_.data();
  for (const std::vector<double>& component : values) {
    const Eigen::MatrixXd powers =
        of_s * Eigen::MatrixXd::Map(component.data(), counts[0], counts[1]) * of_t.transpose();
    next = std::copy_n(powers.data(), powers.size(), next);
  }
  if (!taken.empty()) {
    const Eigen::MatrixXd powers =
        of_s * Eigen::MatrixXd::Map(taken.data(), counts[0], counts[1]) * of_t.transpose();
    std::transform(powers.data(), powers.data() + powers.size(), taken_.begin(),
                   [](double power) { return static_cast<float>(power); });
  }
  const int count = counts[0] * counts[1];
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < kTogether; ++c) together_[k * kTogether + c] = powers_[c * count + k];
}

void ComplianceTable::turn_together(double* components, double c, double s) {
  const double t11 = components[first], t22 = components[second], t12 = components[first_second];
  components[first] = c * c * t11 - 2.0 * c * s * t12 + s * s * t22;
  components[second] = s * s * t11 + 2.0 * c * s * t12 + c * c * t22;
  components[first_second] = c * s * (t11 - t22) + (c * c - s * s) * t12;
}

void ComplianceTable::turn(double* components, double c, double s) {
  turn_together(components, c, s);
  const double t1n = components[first_normal], t2n = components[second_normal];
  components[first_normal] = c * t1n - s * t2n;
  components[second_normal] = s * t1n + c * t2n;
}

ComplianceTable::Value ComplianceTable::at(Component component, const nurbs::Parameter<2>& low,
                                           const nurbs::Parameter<2>& high,
                                           const nurbs::Parameter<2>& xi) const {
  const double* const first = powers_.data() + static_cast<std::size_t>(component) * counts_[0] * counts_[1];
  const OwnParameter s(low[0], high[0], xi[0]), t(low[1], high[1], xi[1]);
  TablePolynomial at(first, counts_, s.value, t.value);
  if (strips_.reach(s.value, t.value))
    strips_.add(s.value, t.value, component, 1, &at.value, &at.by_s, &at.by_t);
  return {at.value, {at.by_s * s.change, at.by_t * t.change}};
}

}  // namespace structure
