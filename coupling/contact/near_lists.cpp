// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/near_lists.h"

#include <limits>

namespace contact {

namespace {

constexpr double kFurther = 1.1;     // of its reach: how far a particle looks
constexpr double kNearer = 0.9;      // what is in there stays within its reach as long
constexpr double kUncertain = 1e-5;  // of the wall's size: of distances from boxes in single precision

}  // namespace

void NearLists::near(int particle, const nurbs::Vector3& d, double reach, std::vector<int>& pieces) {
  if (particle >= static_cast<int>(known_.size())) known_.resize(particle + 1);
  Known& known = known_[particle];
  double moved = (d - known.centre).norm();
  if (!(moved + reach <= known.radius)) {
    look(d, reach, known);
    moved = 0.0;
  }
  const double uncertain = moved + kUncertain * search_.surface().size;
  if (known.least - uncertain > reach) return;
  if (known.most + uncertain <= reach || any_within(d, reach, known))
    pieces.insert(pieces.end(), known.pieces.begin(), known.pieces.end());
}

void NearLists::look(const nurbs::Vector3& d, double reach, Known& known) {
  known.centre = d;
  known.radius = kFurther * reach;
  known.pieces.clear();
  cells_.near(d, known.radius, known.pieces);
  known.least = search_.nearest(d, known.radius, known.pieces.data(), static_cast<int>(known.pieces.size()));
  known.most =
      any_within(d, kNearer * reach, known) ? kNearer * reach : std::numeric_limits<double>::infinity();
}

bool NearLists::any_within(const nurbs::Vector3& d, double reach, const Known& known) const {
  return search_.nearest(d, reach, known.pieces.data(), static_cast<int>(known.pieces.size())) < reach;
}

}  // namespace contact
