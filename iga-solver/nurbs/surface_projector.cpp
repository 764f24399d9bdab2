// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_projector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/distance_polynomial.h"
#include "nurbs/pole.h"

namespace nurbs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-10;  // relative: squared distances this close are equal
constexpr double kEqual = 4.0 * std::numeric_limits<double>::epsilon();  // the same, of distances: round-off
constexpr double kSmallestPart = 0x1p-20;  // of an element: below it a part is searched from its centre
constexpr double kSameFoot = 1e-7;         // of the surface's size: feet this close are one

Box united(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

double squared_distance_to_centre(const Box& box, const Vector3& d) {
  return (0.5 * (box.low + box.high) - d).squaredNorm();
}

// A descent, and where it ends beside a pole, what the pole makes of it.
DescentResult descend_past_poles(const ElementStore& elements, const Vector3& d, const LocalPoint& start) {
  DescentResult found = descend(elements, d, start);
  if (found.end == DescentEnd::minimum) return found;
  const Pole pole = pole_beside(elements, d, found.at);
  if (pole.kind == PoleKind::saddle) found.end = DescentEnd::unknown;
  if (pole.kind == PoleKind::minimum && pole.r.norm() <= (1.0 + kEqual) * found.r.norm()) {
    found.at = pole.at;
    found.r = pole.r;
    found.end = DescentEnd::minimum;
  }
  if (pole.kind == PoleKind::slope && found.end == DescentEnd::unknown) {
    DescentResult beyond = descend(elements, d, pole.at);
    beyond.iterations += found.iterations;
    if (beyond.r.norm() <= (1.0 + kEqual) * found.r.norm()) found = beyond;
  }
  return found;
}

}  // namespace

// The end of a descent as a projection, and what is known of it.
struct SurfaceProjector::Foot {
  Projection point;
  DescentEnd end;

  bool finite() const { return point.status != ProjectionStatus::not_converged; }
  // Of equally near feet one inside comes before one on an edge (so that no seam of a closed patch is felt),
  // and any foot before a point that is none.
  int rank() const { return end == DescentEnd::unknown ? 3 : static_cast<int>(point.status); }
};

// What a search over the tree carries along.
struct SurfaceProjector::Search {
  const Vector3& d;
  double same;                   // lengths that differ less are equal
  double bound2;                 // squared distance from which on nothing is wanted
  std::vector<Projection>* all;  // null in a search for the nearest
  Foot best;                     // of a search for the nearest

  void start_with(const Foot& foot) {
    best = foot;
    const double distance = best.point.distance;
    bound2 = best.rank() == 0 ? distance * distance * (1.0 - kTie) : (distance + same) * (distance + same);
  }

  void found(const Foot& foot) {
    if (all != nullptr) return list(foot);
    const int lower = foot.rank() - best.rank();
    const double level = best.point.distance + (lower < 0 ? same : lower > 0 ? -same : 0.0);
    if (foot.point.distance < level) start_with(foot);
  }

  void list(const Foot& foot) const {
    if (foot.end == DescentEnd::unknown || !(foot.point.distance * foot.point.distance < bound2)) return;
    for (Projection& other : *all) {
      if ((other.foot - foot.point.foot).norm() > same) continue;
      if (foot.point.status < other.status) other = foot.point;
      return;
    }
    all->push_back(foot.point);
  }
};

SurfaceProjector::SurfaceProjector(const Space<2>& space)
    : space_(space),
      elements_(space),
      products_(product_terms(space.degree(0), space.degree(1))),
      leaf_(space.element_count()),
      bezier_(static_cast<size_t>(space.element_count()) * space.functions_per_element()) {
  const int p = space.degree(0), q = space.degree(1);
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) binomials_.push_back(binomial(p, i) * binomial(q, j));
  nodes_.reserve(2 * space.element_count());
  add_node({0, 0}, {elements_.count(0), elements_.count(1)});
}

SurfaceProjector::~SurfaceProjector() = default;

// Halves the range of elements along its longer side; children follow their parent.
int SurfaceProjector::add_node(const Indices<2>& begin, const Indices<2>& end) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({{Vector3::Zero(), Vector3::Zero()}, -1, {-1, -1}});
  const int direction = end[1] - begin[1] > end[0] - begin[0] ? 1 : 0;
  if (end[direction] - begin[direction] == 1) {
    nodes_[node].element = space_.element_index(begin);
    leaf_[nodes_[node].element] = node;
    return node;
  }
  Indices<2> lower_end = end, upper_begin = begin;
  lower_end[direction] = upper_begin[direction] = (begin[direction] + end[direction]) / 2;
  const int lower = add_node(begin, lower_end), upper = add_node(upper_begin, end);
  nodes_[node].children[0] = lower, nodes_[node].children[1] = upper;
  return node;
}

void SurfaceProjector::set_control_points(const Eigen::Ref<const NodalVectors>& control_points) {
  if (control_points.cols() != space_.control_point_count())
    throw std::invalid_argument(fmt::format("{} control points given, expected {}", control_points.cols(),
                                            space_.control_point_count()));
  elements_.set_control_points(control_points);
  boxes_current_ = false;
}

// Bezier nets and boxes of all elements, then the boxes of the tree from the leaves up.
void SurfaceProjector::refit() const {
  if (boxes_current_) return;
  const int count = space_.functions_per_element();
  for (int node = static_cast<int>(nodes_.size()) - 1; node >= 0; --node) {
    Node& n = nodes_[node];
    if (n.element < 0)
      n.box = united(nodes_[n.children[0]].box, nodes_[n.children[1]].box);
    else
      n.box = fill_bezier_net(n.element, &bezier_[static_cast<size_t>(n.element) * count]);
  }
  boxes_current_ = true;
}

// Homogeneous Bezier points times binomials, as DistancePolynomial takes them; returns their box.
Box SurfaceProjector::fill_bezier_net(int element, Vector4* net) const {
  const Indices<2> indices = space_.element_indices(element);
  const int e[2] = {indices[0], indices[1]};
  const ElementKernel& kernel = elements_.kernel();
  Vector4 points[power(kMaxDegree + 1, 2)];
  const Vector3 origin = elements_.homogeneous_points(e, points).head<3>();
  kernel.transform(kernel.p, kernel.q, elements_.axis(0, e[0]).bezier, elements_.axis(1, e[1]).bezier, points,
                   net);
  Box box{Vector3::Constant(kInfinity), Vector3::Constant(-kInfinity)};
  for (int a = 0; a < space_.functions_per_element(); ++a) {
    const double w = space_.rational() ? net[a][3] : 1.0;
    const Vector3 point = origin + net[a].head<3>().matrix() / w;
    box = united(box, {point, point});
    net[a][3] = w;
    net[a] *= binomials_[a];
  }
  return box;
}

int SurfaceProjector::element_near(int axis, double xi) const {
  const KnotVector& knots = space_.knots(axis);
  const int count = knots.element_count();
  const double position = (xi - knots.front()) / (knots.back() - knots.front()) * count;
  const int guess = position > 0.0 ? static_cast<int>(std::min(position, count - 1.0)) : 0;
  const AxisElement& element = elements_.axis(axis, guess);
  return element.begin <= xi && xi < element.end ? guess : knots.element_at(xi);
}

Projection SurfaceProjector::projection(const Vector3& d, const DescentResult& found) const {
  constexpr ProjectionStatus kByBorders[] = {ProjectionStatus::interior, ProjectionStatus::edge,
                                             ProjectionStatus::corner};
  Projection result;
  int borders = 0;
  for (int i = 0; i < 2; ++i) {
    const AxisElement& element = elements_.axis(i, found.at.e[i]);
    const double s = found.at.s[i];
    result.xi[i] = element.parameter(s);
    const bool end = std::abs(s) == 1.0 && element.at_end[s > 0.0];
    if (end || found.crease[i]) ++borders;
  }
  result.foot = d + found.r;
  result.distance = found.r.norm();
  result.status = std::isfinite(result.distance) ? kByBorders[borders] : ProjectionStatus::not_converged;
  result.iterations = found.iterations;
  return result;
}

SurfaceProjector::Foot SurfaceProjector::foot_from(const Vector3& d, const LocalPoint& start) const {
  const DescentResult found = descend_past_poles(elements_, d, start);
  return {projection(d, found), found.end};
}

LocalPoint SurfaceProjector::local(const Parameter<2>& xi) const {
  LocalPoint point;
  for (int i = 0; i < 2; ++i) {
    point.e[i] = element_near(i, xi[i]);
    point.s[i] = std::clamp(elements_.axis(i, point.e[i]).local(xi[i]), -1.0, 1.0);
  }
  return point;
}

Projection SurfaceProjector::warm(const Vector3& d, const Parameter<2>& guess) const {
  const DescentResult found = descend_past_poles(elements_, d, local(guess));
  if (found.end == DescentEnd::minimum) return projection(d, found);
  return global(d, {projection(d, found), found.end});
}

Projection SurfaceProjector::cold(const Vector3& d) const {
  refit();
  int node = 0;  // to the nearest box; of equal ones, to the nearest centre
  while (nodes_[node].element < 0) {
    const int* children = nodes_[node].children;
    const auto rank = [&](int child) {
      const Box& box = nodes_[child].box;
      return std::make_pair(box.squared_distance(d), squared_distance_to_centre(box, d));
    };
    node = rank(children[1]) < rank(children[0]) ? children[1] : children[0];
  }
  return global(d, foot_from(d, local(space_.element_centre(nodes_[node].element))));
}

Projection SurfaceProjector::nearest(const Vector3& d, const Parameter<2>& guess) const {
  return global(d, foot_from(d, local(guess)));
}

// The global minimum; `start` is a point known.
Projection SurfaceProjector::global(const Vector3& d, const Foot& start) const {
  if (!start.finite()) return start.point;
  refit();
  Search search = search_from(d, start);
  visit(0, search);
  return search.best.point;
}

SurfaceProjector::Search SurfaceProjector::search_from(const Vector3& d, const Foot& start) const {
  const Box& bounds = nodes_[0].box;
  const double same = kEqual * ((bounds.high - bounds.low).norm() + start.point.distance);
  Search search{d, same, kInfinity, nullptr, start};
  search.start_with(start);
  return search;
}

Projection SurfaceProjector::cold_on(const Vector3& d, const int* elements, int count) const {
  if (count < 1) throw std::invalid_argument("no elements given, expected at least 1");
  refit();
  const auto distance2 = [&](int element) { return nodes_[leaf_[element]].box.squared_distance(d); };
  const int first = *std::min_element(elements, elements + count,
                                      [&](int a, int b) { return distance2(a) < distance2(b); });
  const Foot start = foot_from(d, local(space_.element_centre(first)));
  if (!start.finite()) return start.point;
  Search search = search_from(d, start);
  for (int k = 0; k < count; ++k)
    if (distance2(elements[k]) < search.bound2) examine_element(elements[k], search);
  return search.best.point;
}

void SurfaceProjector::all_minima(const Vector3& d, double reach, std::vector<Projection>& out) const {
  collect(d, reach, out, [this](Search& search) { visit(0, search); });
}

void SurfaceProjector::all_minima_on(const Vector3& d, double reach, const int* elements, int count,
                                     std::vector<Projection>& out) const {
  collect(d, reach, out, [&](Search& search) {
    for (int k = 0; k < count; ++k)
      if (nodes_[leaf_[elements[k]]].box.squared_distance(d) < search.bound2)
        examine_element(elements[k], search);
  });
}

template <class Examine>
void SurfaceProjector::collect(const Vector3& d, double reach, std::vector<Projection>& out,
                               Examine examine) const {
  refit();
  out.clear();
  if (!d.allFinite()) return;
  const Box& bounds = nodes_[0].box;
  Search search{d, kSameFoot * (bounds.high - bounds.low).norm(), reach * reach, &out, {}};
  examine(search);
  std::sort(out.begin(), out.end(),
            [](const Projection& a, const Projection& b) { return a.distance < b.distance; });
}

void SurfaceProjector::visit(int node, Search& search) const {
  const Node& n = nodes_[node];
  if (n.element >= 0) return examine_element(n.element, search);
  const double distance2[2] = {nodes_[n.children[0]].box.squared_distance(search.d),
                               nodes_[n.children[1]].box.squared_distance(search.d)};
  const int nearer = distance2[1] < distance2[0] ? 1 : 0;
  for (const int child : {nearer, 1 - nearer})
    if (distance2[child] < search.bound2) visit(n.children[child], search);
}

void SurfaceProjector::examine_element(int element, Search& search) const {
  const Indices<2> indices = space_.element_indices(element);
  const int e[2] = {indices[0], indices[1]};
  const Vector4* net = &bezier_[static_cast<size_t>(element) * space_.functions_per_element()];
  const Vector4 d(search.d[0], search.d[1], search.d[2], 0.0);
  examine(DistancePolynomial(elements_, e, products_, net, d - elements_.element(e).origin), search);
}

// Looks for minima on part of an element: proves that there is none, or that there is one at most and goes to
// it, or halves the part.
void SurfaceProjector::examine(const DistancePolynomial& F, Search& search) const {
  if (F.lower_bound(search.bound2) >= 0.0) return;
  for (int corner = 0; corner < 4 && search.all == nullptr; ++corner) {
    const double distance = search.best.point.distance;
    if (F.corner_distance2(corner) + F.round_off() < distance * distance)
      start_from(F.corner(corner), search);
  }

  const DistancePolynomial::Range c = F.distance2();
  for (int i = 0; i < 2; ++i) {
    if (F.collapsed(i)) continue;
    const DistancePolynomial::Range slope = F.derivative(i == 0, i == 1, c);
    const bool falls = slope.high < -F.round_off();
    if (!falls && !(slope.low > F.round_off())) continue;
    if (!on_region_border(F, i, falls)) return;
    DistancePolynomial border = F;
    border.collapse(i, falls);
    return examine(border, search);
  }

  const DistancePolynomial::Shape shape = F.shape(c);
  if (shape == DistancePolynomial::Shape::convex && descend_in(F, search)) return;
  if (shape == DistancePolynomial::Shape::no_minimum && !touches_region_border(F)) return;

  const int direction = F.widest(c);
  const LocalBox& part = F.part();
  if (c.high - c.low <= kTie * c.high || part.high[direction] - part.low[direction] < kSmallestPart)
    return start_from(F.centre(), search);
  DistancePolynomial lower = F, upper = F;
  F.halve(direction, lower, upper);
  examine(lower, search);
  examine(upper, search);
}

bool SurfaceProjector::on_region_border(const DistancePolynomial& F, int i, bool upper) const {
  const AxisElement& axis = elements_.axis(i, F.element()[i]);
  return upper ? F.part().high[i] == axis.high : F.part().low[i] == axis.low;
}

bool SurfaceProjector::touches_region_border(const DistancePolynomial& F) const {
  for (int i = 0; i < 2; ++i)
    if (!F.collapsed(i) && (on_region_border(F, i, false) || on_region_border(F, i, true))) return true;
  return false;
}

bool SurfaceProjector::holds(const DistancePolynomial& F, const Parameter<2>& xi) const {
  for (int i = 0; i < 2; ++i) {
    const AxisElement& axis = elements_.axis(i, F.element()[i]);
    if (xi[i] < axis.parameter(F.part().low[i]) || xi[i] > axis.parameter(F.part().high[i])) return false;
  }
  return true;
}

// D has one minimum at most on this part: goes to it.  False if the descent gets stuck.
bool SurfaceProjector::descend_in(const DistancePolynomial& F, Search& search) const {
  const bool for_nearest = search.all == nullptr;
  if (for_nearest && search.best.end != DescentEnd::unknown && holds(F, search.best.point.xi)) return true;
  const DescentResult inside = descend(elements_, search.d, F.centre(), &F.part());
  const bool reached = inside.end == DescentEnd::minimum;
  if (!reached || inside.r.squaredNorm() < search.bound2) start_from(inside.at, search);
  return reached;
}

void SurfaceProjector::start_from(const LocalPoint& start, Search& search) const {
  search.found(foot_from(search.d, start));
}

}  // namespace nurbs
