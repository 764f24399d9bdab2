// SPDX-License-Identifier: GPL-2.0-or-later
// The wall across the periodic faces of the box.
#pragma once

#include <vector>

#include "coupling/rigid_frame.h"

namespace contact {

/// The part of space that a rank's particles are in, and where it repeats.
struct PeriodicBox {
  nurbs::Vector3 low, high;  ///< of the whole box [length]
  bool periodic[3];
};

/// One box length along each periodic direction [length].
std::vector<nurbs::Vector3> periods(const PeriodicBox& box);

/// By how much the wall must be moved so that it comes within `reach` of the box [length]: 0 first, then
/// those that are at most one period per direction from where it is nearest to the middle of the box.  Bounds
/// of the wall in its frame.
std::vector<nurbs::Vector3> wall_images(const PeriodicBox& box, const search::Box& wall,
                                        const coupling::RigidFrame& frame, double reach);

}  // namespace contact
