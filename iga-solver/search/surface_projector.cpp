// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/surface_projector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "search/distance_polynomial.h"
#include "search/pole.h"
#include "search/search_state.h"

namespace search {
namespace {

bool close_to_pole(const ElementStore& elements, const LocalPoint& at) {
  constexpr double kClose = 1e-6;  // of an element
  for (int j = 0; j < 2; ++j) {
    const double from_end = 1.0 - std::abs(at.s[j]);
    if (from_end > 0.0 && from_end <= kClose && elements.axis(j, at.e[j]).at_end[at.s[j] > 0.0]) return true;
  }
  return false;
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
  if (pole.kind == PoleKind::slope) {
    DescentResult beyond = descend(elements, d, pole.at);
    beyond.iterations += found.iterations;
    if (beyond.r.norm() <= (1.0 + kEqual) * found.r.norm()) found = beyond;
    // So close to the pole that steps along it are round-off, but off it, and downhill of it.
    if (found.end == DescentEnd::unknown && close_to_pole(elements, found.at))
      found.end = DescentEnd::degenerate;
  }
  return found;
}

}  // namespace

SurfaceProjector::SurfaceProjector(const Space<2>& space, const PatchPoints& control_points, SimdLevel level)
    : space_(space),
      elements_(space, control_points, level),
      products_(product_terms(space.degree(0), space.degree(1))),
      tree_(space),
      second_foot_(space, control_points),
      box_version_(space.element_count(), 0),
      net_version_(space.element_count(), 0),
      boxes_(new Box[space.element_count()]),
      nets_(static_cast<size_t>(space.element_count()) * space.functions_per_element()) {
  if (control_points.cols() != space.control_point_count())
    throw std::invalid_argument(fmt::format("{} control points given, expected {}", control_points.cols(),
                                            space.control_point_count()));
  const int p = space.degree(0), q = space.degree(1);
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) binomials_.push_back(nurbs::binomial(p, i) * nurbs::binomial(q, j));
}

SurfaceProjector::~SurfaceProjector() = default;

void SurfaceProjector::surface_moved() {
  elements_.surface_moved();
  second_foot_.surface_moved();
  tree_current_ = false;
  ++version_;
}

Foot SurfaceProjector::foot_of(const Vector3& d, const DescentResult& found) const {
  Foot result;
  int borders = 0;
  for (int i = 0; i < 2; ++i) {
    result.xi[i] = elements_.axis(i, found.at.e[i]).parameter(found.at.s[i]);
    if (elements_.axis(i).at_patch_end(result.xi[i]) || found.crease[i]) ++borders;
  }
  result.point = d + found.r;
  result.distance = found.r.norm();
  result.status = std::isfinite(result.distance) ? kByBorders[borders] : FootStatus::not_converged;
  result.iterations = found.iterations;
  return result;
}

// The general descent, where Newton's method alone has found no foot.
DescentResult SurfaceProjector::descend_after(const Vector3& d, const LocalPoint& start,
                                              const NewtonEnd& end) const {
  DescentResult found = descend_past_poles(elements_, d, {{start.e[0], start.e[1]}, {end.s[0], end.s[1]}});
  found.iterations += end.iterations;
  return found;
}

// As a rule the next step leads into a neighbour, and Newton's method goes on and ends there.
bool SurfaceProjector::go_on(const Vector3& d, Start& start, NewtonEnd& end) const {
  constexpr int kMaxNeighbours = 3;
  Start next;
  for (int k = 0; k < kMaxNeighbours && !end.done && neighbour(start.at, end.next, next); ++k) {
    NewtonEnd there = newton(d, next);
    if (!(there.distance <= end.distance)) break;
    there.iterations += end.iterations;
    start = next;
    end = there;
  }
  return end.done;
}

Foot SurfaceProjector::warm_beyond(const Vector3& d, const Start& from, const NewtonEnd& stopped) const {
  Start start = from;
  NewtonEnd end = stopped;
  if (!go_on(d, start, end)) return minimum_or_global(d, descend_after(d, start.at, end));
  Foot result;
  take_foot(end, start.at.e, result);
  return result;
}

// A point beyond its element, in the one where it lies; false if that is none of the next or beyond a crease.
bool SurfaceProjector::neighbour(const LocalPoint& from, const double (&to)[2], Start& start) const {
  bool crossed = false;
  for (int i = 0; i < 2; ++i) {
    start.at.e[i] = from.e[i], start.at.s[i] = to[i];
    if (std::abs(to[i]) < 1.0) continue;
    const int side = to[i] > 0.0 ? 1 : -1;
    const AxisElement& here = elements_.axis(i, from.e[i]);
    if (side > 0 ? here.high == 1.0 : here.low == -1.0) return false;
    const AxisElement& next = elements_.axis(i, from.e[i] + side);
    start.at.e[i] += side;
    start.at.s[i] = side * ((side * to[i] - 1.0) * here.half_width * next.per_half_width - 1.0);
    if (!(std::abs(start.at.s[i]) < 1.0)) return false;
    crossed = true;
  }
  if (crossed) start.element = elements_.element(start.at.e);
  return crossed;
}

Reached SurfaceProjector::foot_from(const Vector3& d, const LocalPoint& from) const {
  Start start{from, elements_.element(from.e)};
  NewtonEnd end = newton(d, start);
  if (!end.done && !go_on(d, start, end)) {
    const DescentResult found = descend_after(d, start.at, end);
    return {foot_of(d, found), found.end, found.at};
  }
  Reached reached{{}, DescentEnd::minimum, {{start.at.e[0], start.at.e[1]}, {end.s[0], end.s[1]}}};
  take_foot(end, start.at.e, reached.foot);
  return reached;
}

Foot SurfaceProjector::minimum_or_global(const Vector3& d, const DescentResult& found) const {
  const Foot foot = foot_of(d, found);
  return found.end == DescentEnd::minimum ? foot : global(d, {foot, found.end, found.at});
}

void SurfaceProjector::warm_batch(const Vector3* d, Foot* const* feet, int count) const {
  const ElementKernel& kernel = elements_.kernel();
  NewtonBatch batch;
  for (int first = 0; first < count; first += batch.count) {
    batch.count = std::min(NewtonBatch::kCapacity, count - first);
    for (int k = 0; k < batch.count; ++k) {
      const Foot& foot = *feet[first + k];
      for (int c = 0; c < 3; ++c) batch.d[c][k] = d[first + k][c] - foot.image[c];
      for (int i = 0; i < 2; ++i) batch.xi[i][k] = foot.xi[i];
    }
    elements_.locate(batch);
    kernel.newton_batch(kernel.p, kernel.q, batch);
    for (int k = 0; k < batch.count; ++k) take_foot(batch, k, d[first + k], *feet[first + k]);
  }
}

LocalPoint SurfaceProjector::centre(int element) const {
  const Indices<2> e = space_.element_indices(element);
  return {{e[0], e[1]}, {0.0, 0.0}};
}

Foot SurfaceProjector::cold(const Vector3& d) const {
  Search search{tree_, d};
  search_tree(search);
  if (!search.started) return global(d, foot_from(d, centre(0)));  // not finite, or too far off for the tree
  return search.best.foot;
}

Foot SurfaceProjector::nearest(const Vector3& d, const Parameter<2>& guess) const {
  return global(d, foot_from(d, local(guess)));
}

// The global minimum; `start` is a point known.
Foot SurfaceProjector::global(const Vector3& d, const Reached& start) const {
  if (!start.finite()) return start.foot;
  Search search{tree_, d};
  search.best = start;
  search.started = true;
  search_tree(search);
  return search.best.foot;
}

Foot SurfaceProjector::cold_on(const Vector3& d, const int* elements, int count) const {
  if (count < 1) throw std::invalid_argument("no elements given, expected at least 1");
  Search search{tree_, d};
  search_elements(elements, count, search);
  return search.best.foot;
}

void SurfaceProjector::all_minima(const Vector3& d, double reach, std::vector<Foot>& out) const {
  collect(d, reach, out, [this](Search& search) { search_tree(search); });
}

void SurfaceProjector::all_minima_on(const Vector3& d, double reach, const int* elements, int count,
                                     std::vector<Foot>& out) const {
  collect(d, reach, out, [&](Search& search) { search_elements(elements, count, search); });
}

template <class Examine>
void SurfaceProjector::collect(const Vector3& d, double reach, std::vector<Foot>& out,
                               Examine examine) const {
  out.clear();
  Search search{tree_, d, &out, reach * reach, true};
  examine(search);
  std::sort(out.begin(), out.end(), [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
}

}  // namespace search
