// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/smooth_borders.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>

#include "structure/compliance/table_polynomial.h"

namespace structure {

namespace {

constexpr double sign(int end) { return end == 0 ? -1.0 : 1.0; }

/// [low, high] of an element, in the surface's parameters.
std::array<nurbs::Parameter<2>, 2> bounds(const nurbs::Space<2>& space, int element) {
  const nurbs::Indices<2> span = space.element_indices(element);
  std::array<nurbs::Parameter<2>, 2> bounds;
  for (int d = 0; d < 2; ++d)
    for (int end = 0; end < 2; ++end) bounds[end][d] = space.knots(d).breaks()[span[d] + end];
  return bounds;
}

/// Slope of a polynomial by its powers at an end of [-1, 1], out of it.
double slope_out(const double* powers, int count, int end) {
  double slope = 0.0, power = sign(end);
  for (int k = 1; k < count; ++k, power *= sign(end)) slope += k * power * powers[k];
  return slope;
}

}  // namespace

/// A point of a border: in both elements' own parameters; how many lengths of the other one go on one of this
/// one's, straight across the border and along it, and on one along a border that crosses it; the other's t_1
/// in this one's frame.
struct SmoothBorders::Meeting {
  std::array<double, 2> here, there;
  double across = 1.0, along = 0.0, length = 1.0;
  double c = 1.0, s = 0.0;
};

std::optional<SmoothBorders::Beyond> SmoothBorders::beyond(const Side& side) const {
  const nurbs::Space<2>& space = undeformed_.surface(side.piece).space();
  const nurbs::KnotVector& knots = space.knots(side.direction);
  nurbs::Indices<2> span = space.element_indices(side.element);
  int& along = span[side.direction];
  const int from = along;
  along += side.end == 0 ? -1 : 1;
  const bool is_inside = along >= 0 && along < knots.element_count();
  if (!is_inside || std::abs(knots.span_of_element(along) - knots.span_of_element(from)) >= knots.degree())
    return seams(side.piece, side.element)[side.direction][side.end];
  return Beyond{{side.piece, space.element_index(span), side.direction, 1 - side.end}, false, true};
}

/// Over what is no smooth knot.
const SmoothBorders::Seams& SmoothBorders::seams(int piece, int element) const {
  const auto [found, is_new] = seams_.try_emplace({piece, element});
  Seams& seams = found->second;
  if (!is_new) return seams;
  const auto points = undeformed_.shared().of(piece, element);
  for (int d = 0; d < 2; ++d)
    for (int end = 0; end < 2; ++end) seams[d][end] = beyond_seam({piece, element, d, end}, points);
  return seams;
}

std::optional<SmoothBorders::Beyond> SmoothBorders::beyond_seam(
    const Side& side, const std::vector<std::vector<TablePoint>>& points) const {
  const auto counts_of = [&](int piece) { return table_counts(undeformed_.surface(piece).space()); };
  const std::array<int, 2> counts = counts_of(side.piece);
  const int last = counts[1 - side.direction] - 1;
  const auto at = [&](int along) -> const std::vector<TablePoint>& {
    std::array<int, 2> place;
    place[side.direction] = side.end == 0 ? 0 : counts[side.direction] - 1;
    place[1 - side.direction] = along;
    return points[place[0] + counts[0] * place[1]];
  };
  const auto is_own = [&](const TablePoint& point) {
    return point.piece == side.piece && point.element == side.element;
  };
  // Two have the middle of a smooth border, if patches are not welded to themselves.
  const std::vector<TablePoint>& middle = at(last / 2);
  if (middle.size() != 2 || is_own(middle[0]) == is_own(middle[1]) ||
      !((middle[0].normal - middle[1].normal).norm() <= SharedPoints::kSmooth))
    return {};
  const TablePoint& other = is_own(middle[0]) ? middle[1] : middle[0];
  const std::array<int, 2> theirs = counts_of(other.piece),
                           place = {other.index % theirs[0], other.index / theirs[0]};
  const int direction = place[0] == 0 || place[0] == theirs[0] - 1 ? 0 : 1;
  if (theirs[1 - direction] != counts[1 - side.direction]) return {};
  for (const TablePoint& first : at(0)) {
    if (first.piece != other.piece || first.element != other.element) continue;
    const int along = direction == 0 ? first.index / theirs[0] : first.index % theirs[0];
    return Beyond{{other.piece, other.element, direction, place[direction] == 0 ? 0 : 1}, along != 0, false};
  }
  return {};
}

/// Where its own parameter along the border is `along`.
SmoothBorders::Meeting SmoothBorders::meeting(const Side& own, const Beyond& beyond, double along) const {
  const Side& other = beyond.side;
  Meeting at;
  at.here[own.direction] = sign(own.end);
  at.here[1 - own.direction] = along;
  at.there[other.direction] = sign(other.end);
  at.there[1 - other.direction] = beyond.is_reversed ? -along : along;
  if (beyond.is_regular) {
    at.across = undeformed_.lengths(own.piece, own.element)[own.direction] /
                undeformed_.lengths(other.piece, other.element)[own.direction];
    at.length = at.across;
    return at;
  }
  // Tangents with own parameters, and frames.
  const auto on = [&](const Side& side, const std::array<double, 2>& place) {
    const FaceSurface& surface = undeformed_.surface(side.piece);
    const auto [low, high] = bounds(surface.space(), side.element);
    nurbs::Parameter<2> xi;
    for (int d = 0; d < 2; ++d) xi[d] = 0.5 * ((1.0 - place[d]) * low[d] + (1.0 + place[d]) * high[d]);
    std::array<Vector3, 2> tangents = surface.tangents(side.element, xi);
    for (int d = 0; d < 2; ++d) tangents[d] *= 0.5 * (high[d] - low[d]);
    return std::pair{tangents, surface.frame(side.element, xi)};
  };
  const auto [tangents, frame] = on(own, at.here);
  const auto [theirs, their_frame] = on(other, at.there);
  const Vector3 out = sign(own.end) * tangents[own.direction];
  Eigen::Matrix<double, 3, 2> basis;
  basis << -sign(other.end) * theirs[other.direction], theirs[1 - other.direction];
  const Eigen::Vector2d way = (basis.transpose() * basis).inverse() * (basis.transpose() * out);
  at.across = way[0];
  at.along = way[1];
  at.length = out.norm() / theirs[other.direction].norm();
  const double c = their_frame.col(0).dot(frame.col(0)), s = their_frame.col(0).dot(frame.col(1));
  at.c = c / std::hypot(c, s);
  at.s = s / std::hypot(c, s);
  return at;
}

/// What strips have on a border, by powers of the parameter along it.
std::vector<double> SmoothBorders::kink(const Side& own, const Polynomials& of) const {
  const std::optional<Beyond> beyond = this->beyond(own);
  if (!beyond) return {};
  const Side& other = beyond->side;
  const double *const here = of.powers(own.piece, own.element), *const there =
                                                                    of.powers(other.piece, other.element);
  if (!here || !there) return {};
  const auto polynomials = [&](const Side& side, const double* powers, const std::array<double, 2>& at) {
    const std::array<int, 2> counts = table_counts(undeformed_.surface(side.piece).space());
    std::vector<TablePolynomial> values;
    for (int k = 0; k < of.count; ++k)
      values.emplace_back(powers + static_cast<std::ptrdiff_t>(k) * counts[0] * counts[1], counts, at[0],
                          at[1]);
    return values;
  };
  const auto by = [](const TablePolynomial& at, int d) { return d == 0 ? at.by_s : at.by_t; };
  const int count = table_counts(undeformed_.surface(own.piece).space())[1 - own.direction];
  const std::vector<double> points = lobatto_points(count);
  Eigen::MatrixXd values(count, of.count);
  std::vector<double> slopes(of.count);
  for (int j = 0; j < count; ++j) {
    const Meeting at = meeting(own, *beyond, points[j]);
    const std::vector<TablePolynomial> a = polynomials(own, here, at.here),
                                       b = polynomials(other, there, at.there);
    for (int k = 0; k < of.count; ++k)
      slopes[k] =
          at.along * by(b[k], 1 - other.direction) - at.across * sign(other.end) * by(b[k], other.direction);
    of.turn(slopes.data(), at.c, at.s);
    for (int k = 0; k < of.count; ++k)
      values(j, k) = kink_of_slopes(sign(own.end) * by(a[k], own.direction), slopes[k], at.across);
  }
  const Eigen::MatrixXd powers = lobatto_powers(count) * values;
  return {powers.data(), powers.data() + powers.size()};
}

/// The side of the element beyond a border that goes on from its own at a corner.
SmoothBorders::Side SmoothBorders::past(const Side& border, int corner_end) const {
  const std::optional<Beyond> beyond = this->beyond(border);
  if (!beyond) return {-1, -1, 0, 0};
  const Side& other = beyond->side;
  return {other.piece, other.element, 1 - other.direction, beyond->is_reversed ? 1 - corner_end : corner_end};
}

/// Where four elements meet: as each of the two borders' own strips have a kink where they cross the other.
std::vector<double> SmoothBorders::corner_kink(int piece, int element, const std::array<int, 2>& ends,
                                               const Borders& borders, const Polynomials& of) const {
  std::vector<double> mean(of.count, 0.0);
  for (int d = 0; d < 2; ++d) {
    const Side crossed = {piece, element, 1 - d, ends[1 - d]}, next = past(crossed, ends[d]);
    if (next.piece < 0) return {};
    const std::vector<double>&here = borders[d][ends[d]], there = kink(next, of);
    if (here.empty() || there.empty()) return {};
    const Beyond over = *beyond(crossed);
    const Meeting at = meeting(crossed, over, sign(ends[d]));
    const int count = static_cast<int>(here.size()) / of.count,
              count_there = static_cast<int>(there.size()) / of.count;
    std::vector<double> slopes(of.count);
    for (int k = 0; k < of.count; ++k)
      slopes[k] = -at.length * slope_out(there.data() + k * count_there, count_there, over.side.end);
    of.turn(slopes.data(), at.c, at.s);
    for (int k = 0; k < of.count; ++k)
      mean[k] +=
          0.5 * kink_of_slopes(slope_out(here.data() + k * count, count, ends[1 - d]), slopes[k], at.length);
  }
  return mean;
}

SmoothBorders::Around SmoothBorders::around(int piece, int element) const {
  Around around;
  for (auto& row : around.elements) row.fill({-1, -1});
  around.elements[1][1] = {piece, element};
  const auto beyond = [&](const Side& side) -> SkinElement {
    if (side.piece < 0) return {-1, -1};
    const std::optional<Beyond> found = this->beyond(side);
    if (!found) return {-1, -1};
    around.is_regular = around.is_regular && found->is_regular;
    return {found->side.piece, found->side.element};
  };
  for (int end = 0; end < 2; ++end) {
    around.elements[1][2 * end] = beyond({piece, element, 0, end});
    around.elements[2 * end][1] = beyond({piece, element, 1, end});
  }
  for (int s = 0; s < 2; ++s)
    for (int t = 0; t < 2; ++t) {
      const SkinElement one = beyond(past({piece, element, 0, s}, t)),
                        other = beyond(past({piece, element, 1, t}, s));
      if (one.piece == other.piece && one.element == other.element) around.elements[2 * t][2 * s] = one;
    }
  return around;
}

BorderKinks SmoothBorders::kinks(int piece, int element, const Polynomials& of) const {
  const Around around = this->around(piece, element);
  BorderKinks kinks;
  for (int d = 0; d < 2; ++d)
    for (int end = 0; end < 2; ++end) kinks.border[d][end] = kink({piece, element, d, end}, of);
  for (int s = 0; s < 2; ++s)
    for (int t = 0; t < 2; ++t)
      if (around.elements[2 * t][2 * s].piece >= 0)
        kinks.corner[s][t] = corner_kink(piece, element, {s, t}, kinks.border, of);
  return kinks;
}

}  // namespace structure
