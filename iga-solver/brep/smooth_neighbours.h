// SPDX-License-Identifier: GPL-2.0-or-later
// Which faces meet in smooth edges that are slightly concave on one side.
#pragma once

#include <vector>

#include "brep/surface.h"

namespace brep {

class SmoothNeighbours {
 public:
  /// Looks at the surface now.
  explicit SmoothNeighbours(const Surface& surface);
  bool any() const { return !beyond_.empty(); }
  /// Whether a few smooth edges, one of them concave by `bend` [rad] or more, lead from one of these faces to
  /// one of those.
  bool joined(const std::vector<int>& from, const std::vector<int>& to, double bend) const;

 private:
  struct Beyond {
    int face;
    double bend;  // of the edge between; 0: it is not concave [rad]
  };
  std::vector<int> first_;  // of each face's in beyond_
  std::vector<Beyond> beyond_;
};

}  // namespace brep
