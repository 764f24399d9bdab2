// SPDX-License-Identifier: GPL-2.0-or-later
// Which particles may touch the wall until the next rebuild, and which surface elements they may touch.
// Source: Gao & Feng (2019), section 4.1; control-point boxes and a tree in place of their CGRID.
#pragma once

#include <vector>

#include "nurbs/box_tree.h"

namespace liggghts_pkg {

struct Candidate {
  int particle;      ///< local index, valid until LIGGGHTS exchanges or sorts its particles
  int first, count;  ///< range in CandidateList::elements()
};

class CandidateList {
 public:
  /// Particle i (of n; x[i] its centre [length]) becomes a candidate of each element whose control-point box
  /// is closer than radius[i] * radius_factor + skin.
  void build(const nurbs::Space<2>& space, const nurbs::NodalVectors& control_points, int n,
             const double* const* x, const double* radius, double radius_factor, double skin);

  const std::vector<Candidate>& candidates() const { return candidates_; }
  const int* elements(const Candidate& candidate) const { return elements_.data() + candidate.first; }

  /// Largest distance that any control point has moved since build; bounds the motion of the whole surface,
  /// because a surface point is a convex combination of control points [length].
  double motion_since_build(const nurbs::NodalVectors& control_points) const;
  const nurbs::Box& wall_bounds() const { return tree_.bounds(); }

 private:
  std::vector<Candidate> candidates_;
  std::vector<int> elements_;
  std::vector<nurbs::Box> boxes_;
  nurbs::BoxTree tree_;
  nurbs::NodalVectors control_points_at_build_;
};

}  // namespace liggghts_pkg
