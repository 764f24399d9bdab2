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

  /// Takes feet[k], on the image of the surface where it is, to the local minimum that it has come to for
  /// centres[k].
  void advance(const nurbs::Vector3* centres, search::Foot* const* feet, int count);
  /// All feet nearer than `reach` on candidate elements, as MultiPatchProjector::add_minima.
  void add_minima(const nurbs::Vector3& centre, const nurbs::Vector3& image, double reach, double same_foot,
                  const int* elements, int count, std::vector<search::Foot>& out);
  const search::MultiPatchProjector& projector() const { return projector_; }

  /// Feet found since the last reset, on this rank.
  struct Counts {
    long by_status[4];  ///< in the order of search::FootStatus
    long cold;          ///< found by a search of all candidates
    long fallbacks;     ///< simplex_brent found no interior foot
    long iterations;    ///< of the methods that found the feet, all together

    long not_converged() const { return by_status[static_cast<int>(search::FootStatus::not_converged)]; }
  };
  const Counts& counts() const { return counts_; }
  void reset() { counts_ = Counts(); }

 private:
  void count(const search::Foot& foot);
  search::Foot simplex_brent(const nurbs::Vector3& centre, const search::Foot& from);

  SearchMethod method_;
  const search::MultiPatchProjector& projector_;
  Counts counts_{};
};

/// Sum over all ranks (collective).
LocalSearch::Counts sum(const LocalSearch::Counts& counts, MPI_Comm world);
/// One line.
std::string report(const LocalSearch::Counts& counts);

}  // namespace contact
