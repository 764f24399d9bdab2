// SPDX-License-Identifier: GPL-2.0-or-later
// Branch and bound of SurfaceProjector: over the tree, past what is proved around a foot, and in elements.
#include <algorithm>
#include <cmath>

#include "nurbs/assert.h"
#include "search/distance_polynomial.h"
#include "search/search_state.h"
#include "search/surface_projector.h"

namespace search {
namespace {

constexpr double kSmallestPart = 0x1p-20;  // of an element: below it a part is searched from its centre
constexpr double kReach = 1.0 - 1e-6;      // of a proved reach: safe from round-off, in the foot as well

}  // namespace

// The nearest foot, from search.best if there is one, or all within the bound.
void SurfaceProjector::search_tree(Search& search) const {
  if (!tree_current_) {
    tree_.refit(control_points());
    tree_current_ = true;
  }
  if (!search.d.allFinite()) return;
  search.point = tree_.point(search.d);
  search.begin(tree_.size());
  visit(tree_.root(), search);
}

// The same on some elements.
void SurfaceProjector::search_elements(const int* elements, int count, Search& search) const {
  if (count < 1) return;
  Box bounds = box(elements[0]);
  int first = 0;
  double least = Search::kInfinity;
  for (int k = 0; k < count; ++k) {
    const Box& here = box(elements[k]);
    const double rank =
        here.squared_distance(search.d) + (0.5 * (here.low + here.high) - search.d).squaredNorm();
    if (rank < least) least = rank, first = k;
    bounds = {bounds.low.cwiseMin(here.low), bounds.high.cwiseMax(here.high)};
  }
  search.begin((bounds.high - bounds.low).norm());
  const Reached start = foot_from(search.d, centre(elements[first]));
  if (search.all == nullptr || start.end == DescentEnd::minimum) search.found(start);
  if (search.all == nullptr && !search.best.finite()) return;
  for (int k = 0; k < count; ++k) {
    const Indices<2> e = space_.element_indices(elements[k]);
    if (box(elements[k]).squared_distance(search.d) < search.bound2 && !settled({0, {e[0], e[1]}}, search))
      examine_element(elements[k], search);
  }
}

const Box& SurfaceProjector::box(int element) const {
  NURBS_ASSERT(0 <= element && element < space_.element_count(), element, space_.element_count());
  if (box_version_[element] != version_) {
    boxes_[element] = element_box(space_, control_points(), element);
    box_version_[element] = version_;
  }
  return boxes_[element];
}

// The children of a block, first that which seems nearest; the first element reached gives the first foot.
void SurfaceProjector::visit(const ElementBlock& block, Search& search) const {
  if (block.level == 0) return examine_element(space_.element_index({block.at[0], block.at[1]}), search);
  const SurfaceTree::Lanes near2 = tree_.near2(block, search.point);
  unsigned done = 0;  // a bit for each child
  if (!search.started) {
    const int first = SurfaceTree::least(tree_.add_middle2(block, search.point, near2));
    descend_to(SurfaceTree::child(block, first), search);
    if (block.level > 1) done = 1u << first;
  }
  unsigned left = SurfaceTree::below(near2, search.limit) & ~done;
  if (left == 0 || settled(block, search)) return;
  for (int k = SurfaceTree::least(near2); left != 0; k = (k + 1) % 16) {
    if ((left >> k & 1) == 0) continue;
    left &= ~(1u << k);
    const ElementBlock child = SurfaceTree::child(block, k);
    if (near2[k] < search.limit && !settled(child, search)) visit(child, search);
  }
}

void SurfaceProjector::descend_to(const ElementBlock& block, Search& search) const {
  if (block.level > 0) return visit(block, search);
  start_from({{block.at[0], block.at[1]}, {0.0, 0.0}}, search);
}

// Nothing on a block can be wanted, as a foot is known.
bool SurfaceProjector::settled(const ElementBlock& block, Search& search) const {
  const ElementWindow own = tree_.elements(block);
  if (search.proved.holds(own)) return true;
  const LocalPoint& at = search.best.at;
  const int wide_enough = 2 * block.level - 1;
  for (int level = std::max(search.proved_level + 1, wide_enough); level < search.unproved_level; ++level) {
    const ElementWindow window = second_foot_.window(level, at.e);
    if (!window.holds(own)) continue;
    if (interior_of_region(at) && search.needed_reach() < kReach * second_foot_.excluded_below(level, at.e)) {
      search.proved = window;
      search.proved_level = level;
      return true;
    }
    search.unproved_level = level;
  }
  return search.all != nullptr && has_its_only_foot(block, search);
}

// In a search for all minima, far from the last foot: a window around the block has one foot at most within
// reach, and it is found.
bool SurfaceProjector::has_its_only_foot(const ElementBlock& block, Search& search) const {
  const int level = 2 * block.level;
  if (level >= SecondFoot::kLevels) return false;
  const ElementWindow own = tree_.elements(block), window = second_foot_.window(level, own.begin);
  const double reach = kReach * second_foot_.excluded_below(level, own.begin);
  if (!(search.bound2 < reach * reach)) return false;
  const auto is_in_window = [&](const Foot& foot) {
    const LocalPoint at = local(foot.xi);
    return foot.distance < reach && window.holds(at.e) && interior_of_region(at);
  };
  if (std::any_of(search.all->begin(), search.all->end(), is_in_window)) return true;
  const int middle[2] = {(own.begin[0] + own.end[0]) / 2, (own.begin[1] + own.end[1]) / 2};
  const Reached reached = foot_from(search.d, {{middle[0], middle[1]}, {0.0, 0.0}});
  if (reached.end != DescentEnd::minimum || !is_in_window(reached.foot)) return false;
  search.found(reached);
  return true;
}

// Not on a crease, where the elements on the other sides have a say.
bool SurfaceProjector::interior_of_region(const LocalPoint& at) const {
  for (int i = 0; i < 2; ++i) {
    const AxisElement& axis = elements_.axis(i, at.e[i]);
    if (at.s[i] <= -1.0 && axis.low == -1.0 && !axis.at_end[0]) return false;
    if (at.s[i] >= 1.0 && axis.high == 1.0 && !axis.at_end[1]) return false;
  }
  return true;
}

void SurfaceProjector::examine_element(int element, Search& search) const {
  if (beyond(element, search)) return;
  const Indices<2> indices = space_.element_indices(element);
  const int e[2] = {indices[0], indices[1]};
  const Vector4* net = bezier_net(element);
  const Vector4 d(search.d[0], search.d[1], search.d[2], 0.0);
  examine(DistancePolynomial(elements_, e, products_, net, d - elements_.element(e).origin()), search);
}

// A plane normal to the line from d to a point amid the element keeps all its control points out of the
// search's sphere: to the middle one or, if that does not do, to the mean of that and the nearest along it
// (the first steps of Gilbert, Johnson & Keerthi 1988, "A fast procedure for computing the distance").
bool SurfaceProjector::beyond(int element, const Search& search) const {
  const Indices<2> e = space_.element_indices(element);
  const ElementNet net = elements_.net(e[0], e[1]);
  const Vector3 middle = Vector3::Map(net.origin) - search.d;
  Vector3 direction = middle;
  for (int step = 0; step < 2; ++step) {
    double least = Search::kInfinity;
    const double* nearest = net.points;
    for (int l = 0; l <= space_.degree(1); ++l)
      for (int k = 0; k <= space_.degree(0); ++k) {
        const double* point = net.points + 3 * (k + static_cast<std::ptrdiff_t>(net.stride) * l);
        const double along = direction.dot(Vector3::Map(point) - search.d);
        if (along < least) least = along, nearest = point;
      }
    if (least > 0.0 && least * least >= (1.0 + Search::kTie) * search.bound2 * direction.squaredNorm())
      return true;
    direction = 0.5 * (middle + (Vector3::Map(nearest) - search.d));
  }
  return false;
}

// Homogeneous Bezier points times binomials, as DistancePolynomial takes them.
const Vector4* SurfaceProjector::bezier_net(int element) const {
  const int count = space_.functions_per_element();
  Vector4* net = &nets_[static_cast<size_t>(element) * count];
  if (net_version_[element] == version_) return net;
  const Indices<2> indices = space_.element_indices(element);
  const int e[2] = {indices[0], indices[1]};
  const ElementKernel& kernel = elements_.kernel();
  kernel.transform(kernel.p, kernel.q, elements_.axis(0, e[0]).functions->bezier,
                   elements_.axis(1, e[1]).functions->bezier, elements_.net(e[0], e[1]), net->data());
  for (int a = 0; a < count; ++a) {
    if (!space_.rational()) net[a][3] = 1.0;
    net[a] *= binomials_[a];
  }
  net_version_[element] = version_;
  return net;
}

// Looks for minima on part of an element: proves that there is none, or that there is one at most and goes to
// it, or halves the part.
void SurfaceProjector::examine(const DistancePolynomial& F, Search& search) const {
  if (F.lower_bound(search.bound2) >= 0.0) return;
  for (int corner = 0; corner < 4 && search.all == nullptr; ++corner) {
    const double distance = search.best.foot.distance;
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
  if (c.high - c.low <= Search::kTie * c.high || part.high[direction] - part.low[direction] < kSmallestPart)
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
  if (for_nearest && search.best.end != DescentEnd::unknown && holds(F, search.best.foot.xi)) return true;
  const DescentResult inside = descend(elements_, search.d, F.centre(), &F.part());
  const bool reached = inside.end == DescentEnd::minimum;
  if (!reached || inside.r.squaredNorm() < search.bound2) start_from(inside.at, search);
  return reached;
}

void SurfaceProjector::start_from(const LocalPoint& start, Search& search) const {
  search.found(foot_from(search.d, start));
}

}  // namespace search
