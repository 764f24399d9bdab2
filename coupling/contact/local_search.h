// SPDX-License-Identifier: GPL-2.0-or-later
// Local search: the feet of a particle's centre on the surface, by the method the deck asks for.
#pragma once

#include "coupling/contact/search_counts.h"
#include "search/multi_patch_projector.h"

namespace contact {

enum class SearchMethod {
  newton,        ///< safeguarded Newton (search/surface_projector.h)
  simplex_brent  ///< the paper's (search/simplex_brent.h); Newton where the foot it finds is not interior
};

class LocalSearch {
 public:
  /// Keeps references to both.
  LocalSearch(SearchMethod method, const search::MultiPatchProjector& projector, SearchCounts& counts)
      : method_(method), projector_(projector), counts_(counts) {}

  /// Takes feet[k], on the image of the surface where it is, to the local minimum that it has come to for
  /// centres[k].
  void advance(const nurbs::Vector3* centres, search::Foot* const* feet, int count);
  /// All feet nearer than `reach` on candidate elements, as MultiPatchProjector::add_minima.
  void add_minima(const nurbs::Vector3& centre, const nurbs::Vector3& image, double reach, double same_foot,
                  const int* elements, int count, std::vector<search::Foot>& out);
  const search::MultiPatchProjector& projector() const { return projector_; }

 private:
  search::Foot simplex_brent(const nurbs::Vector3& centre, const search::Foot& from);

  SearchMethod method_;
  const search::MultiPatchProjector& projector_;
  SearchCounts& counts_;
};

}  // namespace contact
