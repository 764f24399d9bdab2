// SPDX-License-Identifier: GPL-2.0-or-later
// The local search of Gao & Feng (2019), section 4.2: Brent's method on their eqs. 27-28,
// S_xi . (d - S) = S_eta . (d - S) = 0, started by a simplex search on the squared distance.
// A check on surface_projector.h for feet inside the patch, slower and less safe:
// eqs. 27-28 hold at every stationary point of the distance, and do not describe feet on edges, corners and
// creases, where d - S is not normal to the surface.
#pragma once

#include "search/foot.h"
#include "search/names.h"

namespace search {

/// The foot that Brent's method finds from `guess` (warm) or from where the simplex search from `guess` ends.
/// Status `interior`: a minimum of the distance strictly inside the patch, not farther than the start;
/// otherwise `not_converged`, with the start for a foot.  `iterations` are Brent's sweeps, as the paper
/// counts. Lengths of parameters are relative to the guess's element.  No allocation.
Foot closest_point_simplex_brent(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                                 const Vector3& d, const Parameter<2>& guess, bool warm);

/// Nearest of the feet found from the centres of the given elements (cold search on candidates of a
/// SurfaceTree); the first that is `not_converged` is returned at once, since the nearest may be missing
/// then. Throws std::invalid_argument if there are no elements.
Foot closest_point_simplex_brent_on_elements(const Space<2>& space,
                                             const Eigen::Ref<const NodalVectors>& control_points,
                                             const Vector3& d, const int* elements, int element_count);

}  // namespace search
