// SPDX-License-Identifier: GPL-2.0-or-later
// What the surface's mesh gives way under a contact beyond what the body does: a contact law that holds the
// give of a half-space counts it twice (iga-solver/structure/compliance has the derivation).
#pragma once

#include <array>

#include "nurbs/multi_patch.h"

namespace coupling {

class LocalCompliance {
 public:
  virtual ~LocalCompliance() = default;

  struct Value {
    double normal;                 ///< along the normal, by a force along it [length/force]
    std::array<double, 2> change;  ///< with the parameters of the foot's patch [length/force/parameter]
  };
  /// On an element that was not asked for before this takes some time.  Throws std::invalid_argument, with
  /// the place, where it is not known.
  virtual Value at(const nurbs::SurfacePoint& foot) = 0;
};

}  // namespace coupling
