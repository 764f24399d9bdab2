// SPDX-License-Identifier: GPL-2.0-or-later
// Local search: the foot of a particle's centre on the surface, by the method the deck asks for, and what
// the searches of one run came to.
#pragma once

#include <mpi.h>

#include <string>

#include "nurbs/surface_projector.h"

namespace liggghts_pkg {

enum class SearchMethod {
  newton,        ///< safeguarded Newton (nurbs/surface_projector.h)
  simplex_brent  ///< the paper's (nurbs/simplex_brent.h); Newton where the foot it finds is not interior
};

/// What to look for.
struct FootQuery {
  const nurbs::Space<2>& space;
  const nurbs::NodalVectors& control_points;  ///< 3 x n [length]
  const nurbs::SurfaceProjector& projector;   ///< of the same control points
  nurbs::Vector3 centre;                      ///< of the particle [length]
  const int* elements;                        ///< candidates, element_count of them
  int element_count;
  const nurbs::Parameter<2>* guess;  ///< the last foot; null: search all candidates (cold)
};

class LocalSearch {
 public:
  explicit LocalSearch(SearchMethod method) : method_(method) {}

  /// The foot reached from the guess, or, without one or where it leads nowhere, the nearest on the
  /// candidates.
  nurbs::Projection project(const FootQuery& query);

  /// Projections since the last reset, on this rank.
  struct Counts {
    long by_status[4];  ///< in the order of nurbs::ProjectionStatus
    long cold;          ///< searched on all candidates
    long fallbacks;     ///< simplex_brent found no interior foot
    long iterations;    ///< of the methods that found the feet, all together

    long not_converged() const { return by_status[static_cast<int>(nurbs::ProjectionStatus::not_converged)]; }
  };
  const Counts& counts() const { return counts_; }
  void reset() { counts_ = Counts(); }

 private:
  SearchMethod method_;
  Counts counts_{};
};

/// Sum over all ranks (collective).
LocalSearch::Counts sum(const LocalSearch::Counts& counts, MPI_Comm world);
/// One line.
std::string report(const LocalSearch::Counts& counts);

}  // namespace liggghts_pkg
