// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/bezier_curve.h"

#include <fmt/format.h>

#include <stdexcept>

#include "nurbs/basis.h"

namespace brep {

namespace {

template <int Dim>
struct HomogeneousDerivatives {
  Eigen::Matrix<double, Dim + 1, 1> point, first, second;
};

// De Casteljau's algorithm; the last columns say what derivatives are.  P: the degree, or at most that; then
// `p` is.
template <int Dim, int P, bool kFixed>
HomogeneousDerivatives<Dim> casteljau(const Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>& points,
                                      double s) {
  const int p = kFixed ? P : static_cast<int>(points.cols()) - 1;
  Eigen::Matrix<double, Dim + 1, P + 1> b;
  b.leftCols(p + 1) = points;
  HomogeneousDerivatives<Dim> at;
  at.first.setZero(), at.second.setZero();
  for (int left = p; left > 0; --left) {
    if (left == 2) at.second = p * (p - 1) * (b.col(left) - 2.0 * b.col(1) + b.col(0));
    if (left == 1) at.first = p * (b.col(1) - b.col(0));
    for (int k = 0; k < left; ++k) b.col(k) += s * (b.col(k + 1) - b.col(k));
  }
  at.point = b.col(0);
  return at;
}

template <int Dim>
HomogeneousDerivatives<Dim> casteljau(const Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>& points,
                                      double s) {
  switch (points.cols()) {
    case 2:
      return casteljau<Dim, 1, true>(points, s);
    case 3:
      return casteljau<Dim, 2, true>(points, s);
    case 4:
      return casteljau<Dim, 3, true>(points, s);
    default:
      return casteljau<Dim, nurbs::kMaxDegree, false>(points, s);
  }
}

}  // namespace

template <int Dim>
typename BezierCurve<Dim>::Derivatives BezierCurve<Dim>::derivatives(double s) const {
  const auto [homogeneous, first, second] = casteljau<Dim>(points, s);
  const double w = homogeneous[Dim];
  Derivatives at;
  at.point = homogeneous.template head<Dim>() / w;
  at.first = (first.template head<Dim>() - first[Dim] * at.point) / w;
  at.second = (second.template head<Dim>() - 2.0 * first[Dim] * at.first - second[Dim] * at.point) / w;
  return at;
}

template <int Dim>
std::pair<BezierCurve<Dim>, BezierCurve<Dim>> BezierCurve<Dim>::parts(double s) const {
  const double middle = begin + s * (end - begin);
  std::pair<BezierCurve, BezierCurve> parts{{points, begin, middle}, {points, middle, end}};
  auto& behind = parts.second.points;
  for (int k = 1; k <= degree(); ++k) {
    for (int i = 0; i <= degree() - k; ++i) behind.col(i) += s * (behind.col(i + 1) - behind.col(i));
    parts.first.points.col(k) = behind.col(0);
  }
  return parts;
}

namespace {

// Index of the first of degree + 1 equal knots inside: there the curve may be in two; 0 if there are none.
template <int Dim>
int place_of_cut(const Spline<Dim>& spline) {
  const int p = spline.degree, count = static_cast<int>(spline.knots.size());
  for (int i = p + 1; i + 2 * p + 1 < count; ++i)
    if (spline.knots[i] == spline.knots[i + p]) return i;
  return 0;
}

template <int Dim>
Spline<Dim> part_of(const Spline<Dim>& spline, int first_knot, int end_knot, int first, int count) {
  Spline<Dim> part;
  part.degree = spline.degree;
  part.knots.assign(spline.knots.begin() + first_knot, spline.knots.begin() + end_knot);
  part.points = spline.points.middleCols(first, count);
  if (!spline.weights.empty())
    part.weights.assign(spline.weights.begin() + first, spline.weights.begin() + first + count);
  return part;
}

}  // namespace

template <int Dim>
std::vector<BezierCurve<Dim>> beziers(const Spline<Dim>& spline) {
  const auto points = static_cast<int>(spline.points.cols());
  if (const int cut = place_of_cut(spline); cut > 0 && cut < points) {
    const int knots = static_cast<int>(spline.knots.size());
    std::vector<BezierCurve<Dim>> result = beziers(part_of(spline, 0, cut + spline.degree + 1, 0, cut));
    for (BezierCurve<Dim>& curve : beziers(part_of(spline, cut, knots, cut, points - cut)))
      result.push_back(std::move(curve));
    return result;
  }
  const nurbs::KnotVector knots(spline.degree, spline.knots);
  const auto count = static_cast<long>(knots.control_point_count());
  const auto weights = static_cast<long>(spline.weights.size());
  if (spline.points.cols() != count || (weights != 0 && weights != count))
    throw std::invalid_argument(fmt::format("a curve of {} points and {} weights, expected {} of each",
                                            spline.points.cols(), weights, count));
  const std::vector<nurbs::ElementFunctions> functions = nurbs::element_functions(knots);
  std::vector<BezierCurve<Dim>> result;
  for (int e = 0; e < knots.element_count(); ++e) {
    const int p = knots.degree(), first = knots.span_of_element(e) - p;
    BezierCurve<Dim> curve{{}, knots.breaks()[e], knots.breaks()[e + 1]};
    curve.points.setZero(Dim + 1, p + 1);
    for (int k = 0; k <= p; ++k)
      for (int j = 0; j <= p; ++j) {
        const double w = weights == 0 ? 1.0 : spline.weights[first + j], N = functions[e].bezier[k][j];
        curve.points.col(k).template head<Dim>() += N * w * spline.points.col(first + j);
        curve.points(Dim, k) += N * w;
      }
    result.push_back(std::move(curve));
  }
  return result;
}

template struct BezierCurve<2>;
template struct BezierCurve<3>;
template std::vector<BezierCurve<2>> beziers(const Spline<2>&);
template std::vector<BezierCurve<3>> beziers(const Spline<3>&);

}  // namespace brep
