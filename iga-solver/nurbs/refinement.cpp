// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nurbs {
namespace {

// A control point of the new knot vector: sum_j c[j] P_{first+j} over old ones.
struct Row {
  int first;
  double c[kMaxDegree + 1];
};

// Oslo algorithm: the new control point i is the blossom at its p knots, on the old span that holds the knot
// before them (there all factors are positive).
std::vector<Row> insertion_rows(const KnotVector& coarse, const KnotVector& fine) {
  const int p = coarse.degree();
  std::vector<Row> rows(fine.control_point_count());
  for (int i = 0; i < fine.control_point_count(); ++i) {
    const int span = coarse.find_span(fine.knots()[i]);
    rows[i].first = span - p;
    evaluate_blossom(coarse, span, &fine.knots()[i + 1], rows[i].c);
  }
  return rows;
}

// The blossom of degree p+1 is the mean of the p+1 blossoms of degree p that leave out one argument each
// (Prautzsch).
std::vector<Row> elevation_rows(const KnotVector& low, const KnotVector& high) {
  const int p = low.degree();
  std::vector<Row> rows(high.control_point_count());
  for (int i = 0; i < high.control_point_count(); ++i) {
    const double* t = &high.knots()[i + 1];
    const int span = low.find_span(high.knots()[i]);
    rows[i] = {span - p, {}};
    for (int omitted = 0; omitted <= p; ++omitted) {
      double others[kMaxDegree], c[kMaxDegree + 1];
      std::copy(t + omitted + 1, t + p + 1, std::copy(t, t + omitted, others));
      evaluate_blossom(low, span, others, c);
      for (int j = 0; j <= p; ++j) rows[i].c[j] += c[j] / (p + 1);
    }
  }
  return rows;
}

// Applies the rows to every line of control points of one direction, in homogeneous coordinates (w P, w).
template <int Dim>
Patch<Dim> transform(const Patch<Dim>& old, int direction, const KnotVector& knots,
                     const std::vector<Row>& rows) {
  std::array<KnotVector, Dim> all_knots = old.space.knots();
  all_knots[direction] = knots;
  const int old_length = old.space.control_point_count(direction), length = knots.control_point_count();
  const int count = old.space.control_point_count() / old_length * length;
  int stride = 1;
  for (int d = 0; d < direction; ++d) stride *= old.space.control_point_count(d);

  NodalVectors control_points(3, count);
  std::vector<double> weights(count);
  for (int a = 0; a < count; ++a) {
    const int inner = a % stride, i = a / stride % length, outer = a / stride / length;
    Vector3 wP = Vector3::Zero();
    double w = 0.0;
    for (int j = 0; j <= old.space.degree(direction); ++j) {
      const int b = inner + stride * (rows[i].first + j + old_length * outer);
      const double cw = rows[i].c[j] * old.space.weight(b);
      wP += cw * old.control_points.col(b);
      w += cw;
    }
    weights[a] = w;
    control_points.col(a) = old.space.rational() ? Vector3(wP / w) : wP;
  }
  if (!old.space.rational()) weights.clear();
  return {Space<Dim>(std::move(all_knots), std::move(weights)), std::move(control_points)};
}

template <int Dim>
void check_arguments(const Patch<Dim>& patch, int direction, int times) {
  check_patch(patch);
  if (direction < 0 || direction >= Dim)
    throw std::invalid_argument(fmt::format("direction is {}, expected 0 to {}", direction, Dim - 1));
  if (times < 0) throw std::invalid_argument(fmt::format("times is {}, expected 0 or more", times));
}

// Same curve, one degree more: each distinct knot stands once more.
KnotVector elevated(const KnotVector& knots) {
  std::vector<double> all = knots.knots();
  all.insert(all.end(), knots.breaks().begin(), knots.breaks().end());
  std::sort(all.begin(), all.end());
  return KnotVector(knots.degree() + 1, std::move(all));
}

}  // namespace

template <int Dim>
Patch<Dim> insert_knots(const Patch<Dim>& patch, int direction, const std::vector<double>& added) {
  check_arguments(patch, direction, 0);
  const KnotVector& coarse = patch.space.knots(direction);
  for (double xi : added)
    if (!(coarse.front() < xi && xi < coarse.back()))
      throw std::invalid_argument(fmt::format("knot {} is outside, expected one between {} and {}", xi,
                                              coarse.front(), coarse.back()));
  std::vector<double> knots = coarse.knots();
  knots.insert(knots.end(), added.begin(), added.end());
  std::sort(knots.begin(), knots.end());
  const KnotVector fine(coarse.degree(), std::move(knots));
  return transform(patch, direction, fine, insertion_rows(coarse, fine));
}

template <int Dim>
Patch<Dim> insert_knot(const Patch<Dim>& patch, int direction, double xi, int times) {
  check_arguments(patch, direction, times);
  return insert_knots(patch, direction, std::vector<double>(times, xi));
}

template <int Dim>
Patch<Dim> elevate_degree(const Patch<Dim>& patch, int direction, int times) {
  check_arguments(patch, direction, times);
  Patch<Dim> result = patch;
  for (int k = 0; k < times; ++k) {
    const KnotVector low = result.space.knots(direction), high = elevated(low);
    result = transform(result, direction, high, elevation_rows(low, high));
  }
  return result;
}

namespace {

// Times that it stands inside; the ends count as often as they may.
int multiplicity(const KnotVector& knots, double xi) {
  if (xi == knots.front() || xi == knots.back()) return knots.degree();
  return static_cast<int>(std::count(knots.knots().begin(), knots.knots().end(), xi));
}

}  // namespace

// Between knots that stand `degree` times, control points from one of these to the other.
template <int Dim>
Patch<Dim> part_between(const Patch<Dim>& patch, int direction, double begin, double end) {
  check_arguments(patch, direction, 0);
  const KnotVector& given = patch.space.knots(direction);
  if (!(given.front() <= begin && begin < end && end <= given.back()))
    throw std::invalid_argument(fmt::format("the part is {} to {}, expected a range within {} to {}", begin,
                                            end, given.front(), given.back()));
  std::vector<double> missing;
  for (const double xi : {begin, end})
    missing.insert(missing.end(), given.degree() - multiplicity(given, xi), xi);
  const Patch<Dim> whole = missing.empty() ? patch : insert_knots(patch, direction, missing);
  const std::vector<double>& all = whole.space.knots(direction).knots();
  const auto inner = std::upper_bound(all.begin(), all.end(), begin),
             behind = std::lower_bound(all.begin(), all.end(), end);
  std::vector<double> knots(given.degree() + 1, begin);
  knots.insert(knots.end(), inner, behind);
  knots.insert(knots.end(), given.degree() + 1, end);
  const int first = static_cast<int>(inner - all.begin()) - given.degree() - 1;
  std::array<KnotVector, Dim> all_knots = whole.space.knots();
  all_knots[direction] = KnotVector(given.degree(), std::move(knots));
  const int old_length = whole.space.control_point_count(direction),
            length = all_knots[direction].control_point_count();
  int stride = 1;
  for (int d = 0; d < direction; ++d) stride *= whole.space.control_point_count(d);
  NodalVectors control_points(3, whole.space.control_point_count() / old_length * length);
  std::vector<double> weights;
  for (int a = 0; a < control_points.cols(); ++a) {
    const int b = a % stride + stride * (first + a / stride % length + old_length * (a / stride / length));
    control_points.col(a) = whole.control_points.col(b);
    if (whole.space.rational()) weights.push_back(whole.space.weight(b));
  }
  return {Space<Dim>(std::move(all_knots), std::move(weights)), std::move(control_points)};
}

#define INSTANTIATE(Dim)                                                                \
  template Patch<Dim> insert_knots(const Patch<Dim>&, int, const std::vector<double>&); \
  template Patch<Dim> insert_knot(const Patch<Dim>&, int, double, int);                 \
  template Patch<Dim> elevate_degree(const Patch<Dim>&, int, int);                      \
  template Patch<Dim> part_between(const Patch<Dim>&, int, double, double);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace nurbs
