// SPDX-License-Identifier: GPL-2.0-or-later
// Local search: the feet of a particle's centre on the surface, by the method the deck asks for, and what the
// searches of one run came to.
#pragma once

#include <mpi.h>

#include <string>

#include "search/multi_patch_projector.h"

namespace contact {

enum class SearchMethod {
  newton,        ///< safeguarded Newton (search/surface_projector.h)
  simplex_brent  ///< the paper's (search/simplex_brent.h); Newton where the foot it finds is not interior
};

class LocalSearch {
 public:
  /// Keeps a reference to `projector`.
  LocalSearch(SearchMethod method, const search::MultiPatchProjector& projector)
      : method_(method), projector_(projector) {}

  /// The foot that a branch has come to: the local minimum reached from a point of the surface moved by
  /// `image`.
  search::SurfaceFoot follow(const nurbs::Vector3& centre, const nurbs::SurfacePoint& from,
                             const nurbs::Vector3& image);
  /// The same for many branches, each foot in place.
  void follow_batch(const nurbs::Vector3* centres, search::SurfaceFoot* const* feet, int count);
  /// All feet nearer than `reach` on candidate elements, as MultiPatchProjector::add_minima.
  void add_minima(const nurbs::Vector3& centre, const nurbs::Vector3& image, double reach, double same_foot,
                  const int* elements, int count, std::vector<search::SurfaceFoot>& out);
  const search::MultiPatchProjector& projector() const { return projector_; }

  /// Feet found since the last reset, on this rank.
  struct Counts {
    long by_status[4];  ///< in the order of search::ProjectionStatus
    long cold;          ///< found by a search of all candidates
    long fallbacks;     ///< simplex_brent found no interior foot
    long iterations;    ///< of the methods that found the feet, all together

    long not_converged() const {
      return by_status[static_cast<int>(search::ProjectionStatus::not_converged)];
    }
  };
  const Counts& counts() const { return counts_; }
  void reset() { counts_ = Counts(); }

 private:
  void count(const search::SurfaceFoot& foot);

  SearchMethod method_;
  const search::MultiPatchProjector& projector_;
  Counts counts_{};
};

/// Sum over all ranks (collective).
LocalSearch::Counts sum(const LocalSearch::Counts& counts, MPI_Comm world);
/// One line.
std::string report(const LocalSearch::Counts& counts);

}  // namespace contact
