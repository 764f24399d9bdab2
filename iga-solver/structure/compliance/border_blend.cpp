// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/border_blend.h"

#include <cmath>
#include <utility>

#include "structure/compliance/compliance_table.h"
#include "structure/compliance/table_polynomial.h"

namespace structure {

namespace {

using Curve = std::vector<Matrix3>;  // values at lobatto_points()

/// Row i: the slope at the ith point, of values at all of them.
Eigen::MatrixXd slopes_of(int count) {
  const std::vector<double> points = lobatto_points(count);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i)
    for (int k = 1; k < count; ++k) slopes(i, k) = k * std::pow(points[i], k - 1);
  return slopes * lobatto_powers(count);
}

const Eigen::MatrixXd& lobatto_slopes(int count) {
  static const Eigen::MatrixXd of_degree_2 = slopes_of(5), of_degree_3 = slopes_of(7);
  return count == 5 ? of_degree_2 : of_degree_3;
}

/// Cubics that are 1, or whose slope is 1, at one end of [-1, 1], and whose other three are 0.
struct HermiteCubics {
  explicit HermiteCubics(double s) {
    const double x = 0.5 * (1.0 + s), y = 1.0 - x;
    value = {y * y * (1.0 + 2.0 * x), x * x * (1.0 + 2.0 * y)};
    slope = {2.0 * x * y * y * (y - x), -2.0 * x * x * y * (x - y)};
  }
  std::array<double, 2> value, slope;
};

Matrix3 end_slope(const Curve& curve, int end) {
  const int count = static_cast<int>(curve.size());
  const Eigen::MatrixXd& slopes = lobatto_slopes(count);
  Matrix3 sum = Matrix3::Zero();
  for (int k = 0; k < count; ++k) sum += slopes(end * (count - 1), k) * curve[k];
  return sum;
}

void give_slopes(Curve& curve, const std::array<Matrix3, 2>& wanted) {
  const std::vector<double> points = lobatto_points(static_cast<int>(curve.size()));
  const Matrix3 first = wanted[0] - end_slope(curve, 0), last = wanted[1] - end_slope(curve, 1);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const HermiteCubics cubics(points[k]);
    curve[k] += cubics.slope[0] * first + cubics.slope[1] * last;
  }
}

/// Points of an element's border: `d` is the direction that ends there, `end` which of its ends.
struct Border {
  const std::array<int, 2>& counts;
  int d, end;
  int point(int along) const {
    const int across = end * (counts[d] - 1);
    return d == 0 ? across + counts[0] * along : along + counts[0] * across;
  }
  int length() const { return counts[1 - d]; }
  std::array<int, 2> corners() const { return {point(0), point(length() - 1)}; }
};

}  // namespace

TensorGrid::TensorGrid(const std::array<int, 2>& counts, std::vector<Matrix3> values)
    : counts_(counts), values_(std::move(values)) {}

Matrix3 TensorGrid::slope(int direction, int point) const {
  const Eigen::MatrixXd& slopes = lobatto_slopes(counts_[direction]);
  const int stride = direction == 0 ? 1 : counts_[0], at = point / stride % counts_[direction];
  Matrix3 sum = Matrix3::Zero();
  for (int k = 0; k < counts_[direction]; ++k) sum += slopes(at, k) * values_[point + (k - at) * stride];
  return sum;
}

Matrix3 TensorGrid::twist(int point) const {
  const Eigen::MatrixXd& slopes = lobatto_slopes(counts_[1]);
  const int at = point / counts_[0];
  Matrix3 sum = Matrix3::Zero();
  for (int k = 0; k < counts_[1]; ++k) sum += slopes(at, k) * slope(0, point + (k - at) * counts_[0]);
  return sum;
}

void BorderChange::add_slopes(const TensorGrid& grid, int point, const std::array<double, 2>& scale) {
  for (int d = 0; d < 2; ++d) slope[d] += scale[d] * grid.slope(d, point);
  twist += scale[0] * scale[1] * grid.twist(point);
}

BorderChange BorderChange::less(const TensorGrid& own, int point, int count) const {
  BorderChange change;
  change.value = value / count - own.values()[point];
  change.has_slopes = has_slopes;
  if (!has_slopes) return change;
  for (int d = 0; d < 2; ++d) change.slope[d] = slope[d] / count - own.slope(d, point);
  change.twist = twist / count - own.twist(point);
  return change;
}

void add_blend(const std::array<int, 2>& counts, std::vector<BorderChange> change,
               std::vector<Matrix3>& values) {
  std::array<std::array<Curve, 2>, 2> value, slope;  // [direction that ends][end]
  for (int d = 0; d < 2; ++d)
    for (int end = 0; end < 2; ++end) {
      const Border border{counts, d, end};
      Curve& curve = value[d][end];
      for (int k = 0; k < border.length(); ++k) curve.push_back(change[border.point(k)].value);
      for (int corner = 0; corner < 2; ++corner) {
        BorderChange& at = change[border.corners()[corner]];
        if (!at.has_slopes) at.slope[1 - d] = end_slope(curve, corner);
      }
    }
  for (int d = 0; d < 2; ++d)
    for (int end = 0; end < 2; ++end) {
      const Border border{counts, d, end};
      for (int k = 0; k < border.length(); ++k) slope[d][end].push_back(change[border.point(k)].slope[d]);
      const BorderChange &first = change[border.corners()[0]], &last = change[border.corners()[1]];
      give_slopes(value[d][end], {first.slope[1 - d], last.slope[1 - d]});
      give_slopes(slope[d][end], {first.twist, last.twist});
    }
  const std::vector<double> s = lobatto_points(counts[0]), t = lobatto_points(counts[1]);
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i) {
      const HermiteCubics by_s(s[i]), by_t(t[j]);
      Matrix3& sum = values[i + counts[0] * j];
      for (int end = 0; end < 2; ++end) {
        sum += by_s.value[end] * value[0][end][j] + by_s.slope[end] * slope[0][end][j];
        sum += by_t.value[end] * value[1][end][i] + by_t.slope[end] * slope[1][end][i];
        for (int top = 0; top < 2; ++top) {
          const BorderChange& corner = change[Border{counts, 0, end}.corners()[top]];
          sum -= by_s.value[end] * (by_t.value[top] * corner.value + by_t.slope[top] * corner.slope[1]) +
                 by_s.slope[end] * (by_t.value[top] * corner.slope[0] + by_t.slope[top] * corner.twist);
        }
      }
    }
}

}  // namespace structure
