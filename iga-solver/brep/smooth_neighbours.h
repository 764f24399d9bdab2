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
  /// Whether a few smooth edges, one of them slightly concave, lead from one of these faces to one of those.
  bool joined(const std::vector<int>& from, const std::vector<int>& to) const;

 private:
  struct Beyond {
    int face;
    bool concave;  // the edge between, slightly
  };
  std::vector<int> first_;  // of each face's in beyond_
  std::vector<Beyond> beyond_;
};

}  // namespace brep
