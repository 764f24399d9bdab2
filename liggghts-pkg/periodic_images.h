// SPDX-License-Identifier: GPL-2.0-or-later
// The wall across the periodic faces of the box.
#pragma once

#include <vector>

#include "coupling/rigid_frame.h"

namespace LAMMPS_NS {
class Domain;
}

namespace liggghts_pkg {

/// One box length along each periodic direction [length].
std::vector<nurbs::Vector3> periods(const LAMMPS_NS::Domain& domain);

/// By how much the wall must be moved so that it comes within `reach` of the box: 0 first, then sums of at
/// most one period per direction [length].  Box of the wall in its frame.
std::vector<nurbs::Vector3> wall_images(const LAMMPS_NS::Domain& domain, const search::Box& wall,
                                        const coupling::RigidFrame& frame, double reach);

}  // namespace liggghts_pkg
