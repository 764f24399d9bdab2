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
  /// Whether a few smooth edges lead from one of these faces to one of those.
  bool joined(const std::vector<int>& from, const std::vector<int>& to) const;

 private:
  std::vector<int> first_, beyond_;
};

}  // namespace brep
