// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_projector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/distance_polynomial.h"
#include "nurbs/pole.h"
#include "nurbs/surface_search.h"

namespace nurbs {
namespace {

constexpr ProjectionStatus kByBorders[] = {ProjectionStatus::interior, ProjectionStatus::edge,
                                           ProjectionStatus::corner};

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

SurfaceProjector::SurfaceProjector(const Space<2>& space, SimdLevel level)
    : space_(space),
      elements_(space, level),
      products_(product_terms(space.degree(0), space.degree(1))),
      tree_(space),
      reach_(space),
      net_version_(space.element_count(), 0),
      nets_(static_cast<size_t>(space.element_count()) * space.functions_per_element()) {
  const int p = space.degree(0), q = space.degree(1);
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) binomials_.push_back(binomial(p, i) * binomial(q, j));
}

SurfaceProjector::~SurfaceProjector() = default;

void SurfaceProjector::set_control_points(const Eigen::Ref<const NodalVectors>& control_points) {
  if (control_points.cols() != space_.control_point_count())
    throw std::invalid_argument(fmt::format("{} control points given, expected {}", control_points.cols(),
                                            space_.control_point_count()));
  elements_.set_control_points(control_points);
  reach_.forget();
  tree_current_ = false;
  ++version_;
}

// Parameters and status where Newton alone has found the foot: inside an element.
inline void SurfaceProjector::take_parameters(const int (&e)[2], const double (&s)[2],
                                              Projection& out) const {
  int borders = 0;
  for (int i = 0; i < 2; ++i) {
    const AxisElement& element = elements_.axis(i, e[i]);
    out.xi[i] = std::min(element.begin + element.half_width * (1.0 + s[i]), element.end);
    if (element.at_end[0] || element.at_end[1]) borders += element.at_patch_end(out.xi[i]);
  }
  out.status = kByBorders[borders];
}

Projection SurfaceProjector::projection(const Vector3& d, const DescentResult& found) const {
  Projection result;
  int borders = 0;
  for (int i = 0; i < 2; ++i) {
    const AxisElement& element = elements_.axis(i, found.at.e[i]);
    result.xi[i] = element.parameter(found.at.s[i]);
    if (element.at_patch_end(result.xi[i]) || found.crease[i]) ++borders;
  }
  result.foot = d + found.r;
  result.distance = found.r.norm();
  result.status = std::isfinite(result.distance) ? kByBorders[borders] : ProjectionStatus::not_converged;
  result.iterations = found.iterations;
  return result;
}

inline void SurfaceProjector::newton(const Vector3& d, const LocalPoint& start, NewtonEnd& end) const {
  const ElementKernel& kernel = elements_.kernel();
  kernel.newton(kernel.p, kernel.q, elements_.element(start.e).row, d.data(), start.s[0], start.s[1], end);
}

void SurfaceProjector::take_foot(const NewtonEnd& end, const int (&e)[2], Projection& out) const {
  for (int c = 0; c < 3; ++c) out.foot[c] = end.foot[c];
  out.distance = end.distance;
  out.iterations = end.iterations;
  take_parameters(e, end.s, out);
}

// The general descent goes on from where Newton has left off.
DescentResult SurfaceProjector::descend_after(const Vector3& d, const int (&e)[2], const double (&s)[2],
                                              int iterations) const {
  DescentResult found = descend_past_poles(elements_, d, {{e[0], e[1]}, {s[0], s[1]}});
  found.iterations += iterations;
  return found;
}

SurfaceProjector::Foot SurfaceProjector::foot_from(const Vector3& d, const LocalPoint& start) const {
  NewtonEnd end;
  newton(d, start, end);
  if (!end.done) return foot(d, descend_after(d, start.e, end.s, end.iterations));
  Foot foot{{}, DescentEnd::minimum, {{start.e[0], start.e[1]}, {end.s[0], end.s[1]}}};
  take_foot(end, start.e, foot.point);
  return foot;
}

SurfaceProjector::Foot SurfaceProjector::foot(const Vector3& d, const DescentResult& found) const {
  return {projection(d, found), found.end, found.at};
}

Projection SurfaceProjector::minimum_or_global(const Vector3& d, const DescentResult& found) const {
  return found.end == DescentEnd::minimum ? projection(d, found) : global(d, foot(d, found));
}

Projection SurfaceProjector::warm_from(const Vector3& d, const LocalPoint& start) const {
  Projection result;
  NewtonEnd end;
  newton(d, start, end);
  if (end.done)
    take_foot(end, start.e, result);
  else
    result = minimum_or_global(d, descend_after(d, start.e, end.s, end.iterations));
  return result;
}

void SurfaceProjector::warm_batch(const Vector3* d, const Parameter<2>* guesses, int count,
                                  Projection* out) const {
  const ElementKernel& kernel = elements_.kernel();
  NewtonBatch batch;
  int e[NewtonBatch::kCapacity][2];
  for (; count > 0; count -= batch.count, d += batch.count, guesses += batch.count, out += batch.count) {
    batch.count = std::min(NewtonBatch::kCapacity, count);
    for (int k = 0; k < batch.count; ++k) {
      for (int i = 0; i < 2; ++i) elements_.axis(i).locate(guesses[k][i], e[k][i], batch.s[i][k]);
      batch.element[k] = elements_.element(e[k]).row;
      batch.d[k] = d[k].data();
    }
    kernel.newton_batch(kernel.p, kernel.q, batch);
    for (int k = 0; k < batch.count; ++k) {
      const double s[2] = {batch.s[0][k], batch.s[1][k]};
      if (batch.done[k]) {
        for (int c = 0; c < 3; ++c) out[k].foot[c] = batch.foot[c][k];
        out[k].distance = batch.distance[k];
        out[k].iterations = static_cast<int>(batch.iterations[k]);
        take_parameters(e[k], s, out[k]);
      } else {
        out[k] = minimum_or_global(d[k], descend_after(d[k], e[k], s, static_cast<int>(batch.iterations[k])));
      }
    }
  }
}

LocalPoint SurfaceProjector::centre(int element) const {
  const Indices<2> e = space_.element_indices(element);
  return {{e[0], e[1]}, {0.0, 0.0}};
}

Projection SurfaceProjector::cold(const Vector3& d) const {
  Search search{tree_, d};
  search_tree(search);
  if (!search.started) return global(d, foot_from(d, centre(0)));  // not finite, or too far off for the tree
  return search.best.point;
}

Projection SurfaceProjector::nearest(const Vector3& d, const Parameter<2>& guess) const {
  return global(d, foot_from(d, local(guess)));
}

// The global minimum; `start` is a point known.
Projection SurfaceProjector::global(const Vector3& d, const Foot& start) const {
  if (!start.finite()) return start.point;
  Search search{tree_, d};
  search.best = start;
  search.started = true;
  search_tree(search);
  return search.best.point;
}

Projection SurfaceProjector::cold_on(const Vector3& d, const int* elements, int count) const {
  if (count < 1) throw std::invalid_argument("no elements given, expected at least 1");
  Search search{tree_, d};
  search_elements(elements, count, search);
  return search.best.point;
}

void SurfaceProjector::all_minima(const Vector3& d, double reach, std::vector<Projection>& out) const {
  collect(d, reach, out, [this](Search& search) { search_tree(search); });
}

void SurfaceProjector::all_minima_on(const Vector3& d, double reach, const int* elements, int count,
                                     std::vector<Projection>& out) const {
  collect(d, reach, out, [&](Search& search) { search_elements(elements, count, search); });
}

template <class Examine>
void SurfaceProjector::collect(const Vector3& d, double reach, std::vector<Projection>& out,
                               Examine examine) const {
  out.clear();
  Search search{tree_, d, &out, reach * reach, true};
  examine(search);
  std::sort(out.begin(), out.end(),
            [](const Projection& a, const Projection& b) { return a.distance < b.distance; });
}

}  // namespace nurbs
