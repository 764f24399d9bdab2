// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/local_search.h"

#include "search/simplex_brent.h"

namespace contact {

using nurbs::Vector3;
using search::Foot;
using search::FootStatus;

void LocalSearch::advance(const Vector3* centres, Foot* const* feet, int count_of_feet) {
  if (method_ == SearchMethod::newton) {
    projector_.follow(centres, feet, count_of_feet);
  } else {
    for (int k = 0; k < count_of_feet; ++k) *feet[k] = simplex_brent(centres[k], *feet[k]);
  }
  for (int k = 0; k < count_of_feet; ++k) counts_.add(*feet[k]);
}

Foot LocalSearch::simplex_brent(const Vector3& centre, const Foot& from) {
  const search::SurfaceProjector& patch = projector_.patch(from.patch);
  const Foot foot = search::closest_point_simplex_brent(patch.space(), patch.control_points(),
                                                        centre - from.image, from.xi, true);
  if (foot.status == FootStatus::interior) return search::placed(foot, from.patch, from.image);
  ++counts_.fallbacks;
  return projector_.follow(centre, from.at(), from.image);
}

void LocalSearch::add_minima(const Vector3& centre, const Vector3& image, double reach, double same_foot,
                             const int* elements, int count_of_elements, std::vector<Foot>& out) {
  const size_t before = out.size();
  projector_.add_minima(centre, image, reach, same_foot, elements, count_of_elements, out);
  counts_.cold += static_cast<long>(out.size() - before);
  for (size_t k = before; k < out.size(); ++k) counts_.add(out[k]);
}

}  // namespace contact
