// SPDX-License-Identifier: GPL-2.0-or-later
#include "local_search.h"

#include <fmt/format.h>

#include "nurbs/simplex_brent.h"

namespace liggghts_pkg {

using nurbs::Projection;
using nurbs::ProjectionStatus;

namespace {

Projection warm_newton(const FootQuery& q) { return q.projector.warm(q.centre, *q.guess); }

Projection cold_newton(const FootQuery& q) {
  return q.projector.cold_on(q.centre, q.elements, q.element_count);
}

Projection simplex_brent(const FootQuery& q) {
  if (q.guess) return nurbs::closest_point_simplex_brent(q.space, q.control_points, q.centre, *q.guess, true);
  return nurbs::closest_point_simplex_brent_on_elements(q.space, q.control_points, q.centre, q.elements,
                                                        q.element_count);
}

}  // namespace

Projection LocalSearch::project(const FootQuery& query) {
  bool cold = query.guess == nullptr, found = false;
  Projection foot;
  if (method_ == SearchMethod::simplex_brent) {
    foot = simplex_brent(query);
    found = foot.status == ProjectionStatus::interior;
    if (!found) ++counts_.fallbacks;
  }
  if (!found && query.guess) {
    foot = warm_newton(query);
    // On an edge of the patch the surface may go on: a closed one begins again beyond its seam.
    found = foot.status == ProjectionStatus::interior;
    if (!found) cold = true;
  }
  if (!found) foot = cold_newton(query);

  ++counts_.by_status[static_cast<int>(foot.status)];
  counts_.iterations += foot.iterations;
  if (cold) ++counts_.cold;
  return foot;
}

LocalSearch::Counts sum(const LocalSearch::Counts& counts, MPI_Comm world) {
  constexpr int kNumbers = 7;
  static_assert(sizeof(LocalSearch::Counts) == kNumbers * sizeof(long), "Counts is a row of numbers");
  LocalSearch::Counts all;
  MPI_Allreduce(&counts, &all, kNumbers, MPI_LONG, MPI_SUM, world);
  return all;
}

std::string report(const LocalSearch::Counts& counts) {
  const long* n = counts.by_status;
  const long projections = n[0] + n[1] + n[2] + n[3];
  const double iterations =
      projections > 0 ? static_cast<double>(counts.iterations) / static_cast<double>(projections) : 0.0;
  return fmt::format(
      "{} projections: {} interior, {} edge, {} corner, {} not converged; {} cold, {} fallbacks, {:.2f} "
      "iterations on average",
      projections, n[0], n[1], n[2], n[3], counts.cold, counts.fallbacks, iterations);
}

}  // namespace liggghts_pkg
