// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/any_spline.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace geometry_io {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kQuarter = 0.5 * nurbs::kPi;

// The last i with knots[i] <= t < knots[i + 1], inside the range.
int span_at(const AnySpline& spline, double t) {
  const auto first = spline.knots.begin() + spline.degree, last = spline.knots.begin() + spline.points.cols();
  int span = static_cast<int>(std::upper_bound(first, last, t) - spline.knots.begin()) - 1;
  span = std::max(span, spline.degree);
  while (span > spline.degree && spline.knots[span] == spline.knots[span + 1]) --span;
  return span;
}

// Blossom of the polynomial on `span` at t[0] ... t[degree - 1].
VectorXd blossom(const AnySpline& spline, int span, const double* t) {
  const int p = spline.degree;
  MatrixXd d = spline.points.middleCols(span - p, p + 1);
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const int i = span - p + j;
      const double a = (t[r - 1] - spline.knots[i]) / (spline.knots[i + p - r + 1] - spline.knots[i]);
      d.col(j) = (1.0 - a) * d.col(j - 1) + a * d.col(j);
    }
  return d.col(p);
}

int arc_count(double from, double to) {
  return std::max(1, static_cast<int>(std::ceil((to - from) / kQuarter - 1e-9)));
}

// Bezier pieces one behind the other, all of one degree, ends shared.
AnySpline joined(int degree, const std::vector<double>& breaks, const std::vector<MatrixXd>& pieces) {
  AnySpline all;
  all.degree = degree;
  all.points.resize(pieces.front().rows(), static_cast<int>(pieces.size()) * degree + 1);
  all.knots.assign(degree + 1, breaks.front());
  for (size_t i = 0; i < pieces.size(); ++i) {
    all.points.middleCols(static_cast<int>(i) * degree, degree + 1) = pieces[i];
    all.knots.insert(all.knots.end(), i + 1 < pieces.size() ? degree : degree + 1, breaks[i + 1]);
  }
  return all;
}

constexpr int kFit = 6;  // degree

// Places where pieces are interpolated, in (0, 1), and the matrix from values there to Bezier points.
double fit_node(int i) { return 0.5 - 0.5 * std::cos(nurbs::kPi * i / kFit); }

const MatrixXd& bezier_from_values() {
  static const MatrixXd inverse = [] {
    MatrixXd B(kFit + 1, kFit + 1);  // row k: Bernstein polynomial k at the nodes
    for (int i = 0; i <= kFit; ++i)
      for (int k = 0; k <= kFit; ++k)
        B(k, i) = nurbs::binomial(kFit, k) * std::pow(fit_node(i), k) * std::pow(1.0 - fit_node(i), kFit - k);
    return MatrixXd(B.inverse());
  }();
  return inverse;
}

AnySpline fitted_piece(const std::function<VectorXd(double)>& curve, double from, double to) {
  const VectorXd first = curve(from), last = curve(to);
  MatrixXd values(first.size(), kFit + 1);
  values.col(0) = first;
  values.col(kFit) = last;
  for (int i = 1; i < kFit; ++i) values.col(i) = curve(from + (to - from) * fit_node(i));
  MatrixXd points = values * bezier_from_values();
  points.col(0) = first;
  points.col(kFit) = last;
  return joined(kFit, {from, to}, {points});
}

}  // namespace

VectorXd AnySpline::at(double t) const {
  const std::vector<double> all(degree, t);
  return blossom(*this, span_at(*this, t), all.data());
}

VectorXd AnySpline::point(double t) const {
  const VectorXd w = at(t);
  return w.head(w.size() - 1) / w(w.size() - 1);
}

// Ends that are those of spans but for round-off are these, or a span of no length would begin there.
AnySpline window(const AnySpline& spline, double from, double to) {
  constexpr double kRoundOff = 1e-12;
  const double leeway = kRoundOff * std::max({to - from, std::abs(from), std::abs(to)});
  for (const double t : spline.knots) {
    if (std::abs(t - from) <= leeway) from = t;
    if (std::abs(t - to) <= leeway) to = t;
  }
  const int p = spline.degree;
  AnySpline part;
  part.degree = p;
  part.knots.assign(p + 1, from);
  for (const double t : spline.knots)
    if (from < t && t < to) part.knots.push_back(t);
  part.knots.insert(part.knots.end(), p + 1, to);
  if (part.knots == spline.knots) return spline;
  const int count = static_cast<int>(part.knots.size()) - p - 1;
  part.points.resize(spline.points.rows(), count);
  for (int j = 0; j < count; ++j)
    part.points.col(j) = blossom(spline, span_at(spline, part.knots[j]), &part.knots[j + 1]);
  return part;
}

AnySpline unrolled(int degree, const std::vector<double>& breaks, const std::vector<int>& multiplicities,
                   const MatrixXd& points, double from, double to) {
  std::vector<double> turn;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) turn.insert(turn.end(), multiplicities[i], breaks[i]);
  const int n = static_cast<int>(turn.size());
  const double period = breaks.back() - breaks.front();
  // Knot i of all turns; on the first span of a turn the first degree + 1 points are at work.
  const auto knot = [&](int i) {
    const int at = i - degree + multiplicities.front() - 1, turns = at >= 0 ? at / n : -((n - 1 - at) / n);
    return turn[at - turns * n] + turns * period;
  };
  int first = 0, last = n;  // points; they cover [knot(first + degree), knot(last)]
  while (knot(first + degree) > from) --first;
  while (knot(first + degree + 1) <= from) ++first;
  while (knot(last) < to) ++last;
  AnySpline all;
  all.degree = degree;
  all.points.resize(points.rows(), last - first);
  for (int j = first; j < last; ++j) all.points.col(j - first) = points.col(((j % n) + n) % n);
  for (int i = first; i <= last + degree; ++i) all.knots.push_back(knot(i));
  return all;
}

AnySpline joined(const AnySpline& spline) {
  constexpr double kSame = 1e-9;
  const int p = spline.degree, count = static_cast<int>(spline.points.cols());
  const double largest = spline.points.cwiseAbs().maxCoeff();
  AnySpline out{p, {}, spline.points};
  int columns = 0;
  for (int i = 0; i < static_cast<int>(spline.knots.size()); ++i) {
    // Knot i is the last of p + 1 equal ones; the columns before and behind them are i - p - 1 and i - p.
    const bool full = i > p && i < count && spline.knots[i - p] == spline.knots[i];
    if (full &&
        (spline.points.col(i - p) - spline.points.col(i - p - 1)).cwiseAbs().maxCoeff() > kSame * largest)
      throw std::runtime_error("in two pieces at parameter " + std::to_string(spline.knots[i]) +
                               ", expected one");
    if (!full) out.knots.push_back(spline.knots[i]);
    if (i < p || i - p >= count) continue;
    if (!full) out.points.col(columns++) = spline.points.col(i - p);
  }
  out.points.conservativeResize(Eigen::NoChange, columns);
  return out;
}

AnySpline reversed(const AnySpline& spline) {
  AnySpline back = spline;
  const double sum = spline.begin() + spline.end();
  back.points = spline.points.rowwise().reverse().eval();
  const size_t n = spline.knots.size();
  for (size_t i = 0; i < n; ++i) back.knots[i] = sum - spline.knots[n - 1 - i];
  return back;
}

AnySpline transformed(AnySpline spline, const MatrixXd& matrix) {
  spline.points = (matrix * spline.points).eval();
  return spline;
}

AnySpline segment(const VectorXd& a, const VectorXd& b, double from, double to) {
  MatrixXd points(a.size() + 1, 2);
  points << a, b, 1.0, 1.0;
  return joined(1, {from, to}, {points});
}

AnySpline unit_arc(double from, double to) {
  const int arcs = arc_count(from, to);
  const double step = (to - from) / arcs, w = std::cos(0.5 * step);
  std::vector<double> breaks{from};
  std::vector<MatrixXd> pieces;
  for (int i = 0; i < arcs; ++i) {
    const double a = from + i * step, b = i + 1 < arcs ? from + (i + 1) * step : to, middle = 0.5 * (a + b);
    MatrixXd points(3, 3);  // the middle one is where the tangents meet, times w
    points.col(0) << std::cos(a), std::sin(a), 1.0;
    points.col(1) << std::cos(middle), std::sin(middle), w;
    points.col(2) << std::cos(b), std::sin(b), 1.0;
    pieces.push_back(points);
    breaks.push_back(b);
  }
  return joined(2, breaks, pieces);
}

double arc_parameter(double from, double to, double angle) {
  const int arcs = arc_count(from, to);
  const double step = (to - from) / arcs;
  const double which = std::min(std::max(std::floor((angle - from) / step), 0.0), arcs - 1.0);
  const double begin = from + which * step, half = 0.5 * step;
  // Half angles from the middle of an arc grow as the parameter does.
  return begin + half * (1.0 + std::tan(0.5 * (angle - begin - half)) / std::tan(0.5 * half));
}

AnySpline unit_hyperbola(double from, double to) {
  const double w = std::cosh(0.5 * (to - from)), middle = 0.5 * (from + to);
  MatrixXd points(3, 3);
  points.col(0) << std::cosh(from), std::sinh(from), 1.0;
  points.col(1) << std::cosh(middle), std::sinh(middle), w;
  points.col(2) << std::cosh(to), std::sinh(to), 1.0;
  return joined(2, {from, to}, {points});
}

AnySpline unit_parabola(double from, double to) {
  MatrixXd points(3, 3);
  points.col(0) << from * from, from, 1.0;
  points.col(1) << from * to, 0.5 * (from + to), 1.0;
  points.col(2) << to * to, to, 1.0;
  return joined(2, {from, to}, {points});
}

AnySpline fitted(const std::function<VectorXd(double)>& curve, double from, double to,
                 const std::function<double(double, const VectorXd&)>& error) {
  constexpr size_t kMostPieces = 4096;
  constexpr int kProbes = 13;
  std::vector<double> breaks{from}, ends{to};  // `ends` is a stack
  std::vector<MatrixXd> pieces;
  while (!ends.empty()) {
    const double a = breaks.back(), b = ends.back();
    const AnySpline piece = fitted_piece(curve, a, b);
    double worst = 0.0;
    for (int i = 0; i < kProbes; ++i) {
      const double t = a + (b - a) * (i + 0.5) / kProbes;
      worst = std::max(worst, error(t, piece.at(t)));
    }
    if (worst > 1.0) {
      if (pieces.size() + ends.size() >= kMostPieces || !(b - a > 1e-12 * (to - from)))
        throw std::runtime_error("a curve that no polynomials come near to");
      ends.push_back(0.5 * (a + b));
      continue;
    }
    pieces.push_back(piece.points);
    breaks.push_back(b);
    ends.pop_back();
  }
  return joined(kFit, breaks, pieces);
}

template <int Dim>
brep::Spline<Dim> finished(const AnySpline& spline) {
  brep::Spline<Dim> out;
  out.degree = spline.degree;
  out.knots = spline.knots;
  const auto w = spline.points.row(Dim);
  if ((w.array() == w(0)).all()) {
    out.points = w(0) == 1.0 ? MatrixXd(spline.points.topRows(Dim)) : spline.points.topRows(Dim) / w(0);
    return out;
  }
  out.points = spline.points.topRows(Dim).array().rowwise() / w.array();
  out.weights.assign(w.begin(), w.end());
  return out;
}

template <int Dim>
AnySpline homogeneous(const brep::Spline<Dim>& spline) {
  AnySpline out{spline.degree, spline.knots, MatrixXd::Ones(Dim + 1, spline.points.cols())};
  out.points.topRows(Dim) = spline.points;
  for (size_t i = 0; i < spline.weights.size(); ++i) out.points.col(static_cast<int>(i)) *= spline.weights[i];
  return out;
}

template brep::Spline<2> finished<2>(const AnySpline&);
template brep::Spline<3> finished<3>(const AnySpline&);
template AnySpline homogeneous<2>(const brep::Spline<2>&);
template AnySpline homogeneous<3>(const brep::Spline<3>&);

}  // namespace geometry_io
