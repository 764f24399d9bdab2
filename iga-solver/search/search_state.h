// SPDX-License-Identifier: GPL-2.0-or-later
// What the searches of SurfaceProjector carry along; used by its sources alone (surface_projector.cpp,
// surface_search.cpp).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "search/element_descent.h"
#include "search/foot.h"
#include "search/second_foot.h"
#include "search/surface_tree.h"

namespace search {

constexpr double kEqual = 4.0 * std::numeric_limits<double>::epsilon();  // of distances, relative: round-off

// Where a descent ends, and what is known of it.
struct Reached {
  Foot foot;
  DescentEnd end;
  LocalPoint at;

  bool finite() const { return foot.status != FootStatus::not_converged; }
  // Of equally near feet one inside comes before one on an edge (so that no seam of a closed patch is felt),
  // and any foot before a point that is none.
  int rank() const { return end == DescentEnd::unknown ? 3 : static_cast<int>(foot.status); }
};

// A search for the nearest foot, or for all.
struct Search {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kTie = 1e-10;      // relative: squared distances this close are equal
  static constexpr double kSameFoot = 1e-7;  // of the surface's size: feet this close are one of all

  const SurfaceTree& tree;
  const Vector3& d;
  std::vector<Foot>* all = nullptr;  // null in a search for the nearest
  double bound2 = kInfinity;         // squared distance from which on nothing is wanted
  bool started = false;              // there is a bound
  Reached best{};                    // the nearest so far; of a search for all the last
  double same = 0.0;                 // lengths that differ less are equal
  double size = 0.0;                 // of the surface

  // For the tree: d and the bound in its units.
  SurfaceTree::Point point{};
  float limit = std::numeric_limits<float>::infinity();
  // The window around the block of `proved_level` that holds the best foot has nothing else that is wanted;
  // this is not known for the level `unproved_level`.
  ElementWindow proved{};
  int proved_level = -1, unproved_level = 0;

  void begin(double surface_size) {
    size = surface_size;
    if (all != nullptr) same = kSameFoot * size;
    if (all != nullptr || !started) return set_bound(bound2);
    started = false;
    set_best(best);
  }

  void set_bound(double squared) {
    bound2 = squared;
    limit = tree.limit(point, squared);
  }

  void set_best(const Reached& reached) {
    const double distance = reached.foot.distance;
    if (!started) same = kEqual * (size + distance);
    started = true;
    best = reached;
    set_bound(best.rank() == 0 ? distance * distance * (1.0 - kTie) : (distance + same) * (distance + same));
    nothing_is_proved();
  }

  void nothing_is_proved() {
    proved = {};
    proved_level = -1;
    unproved_level = best.end == DescentEnd::minimum ? SecondFoot::kLevels : 0;
  }

  // A window with a foot has nothing else that is wanted if a second foot is excluded below more than this.
  double needed_reach() const { return all != nullptr ? std::sqrt(bound2) : best.foot.distance; }

  void found(const Reached& reached) {
    if (all != nullptr) return list(reached);
    if (!started) return set_best(reached);
    const int lower = reached.rank() - best.rank();
    const double level = best.foot.distance + (lower < 0 ? same : lower > 0 ? -same : 0.0);
    if (reached.foot.distance < level) set_best(reached);
  }

  void list(const Reached& reached) {
    const Foot& foot = reached.foot;
    if (reached.end == DescentEnd::unknown || !(foot.distance * foot.distance < bound2)) return;
    for (Foot& other : *all) {
      if ((other.point - foot.point).norm() > same) continue;
      if (foot.status < other.status) other = foot;
      return;
    }
    all->push_back(foot);
    best = reached;
    nothing_is_proved();
  }
};

}  // namespace search
