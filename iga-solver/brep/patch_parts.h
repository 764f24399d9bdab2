// SPDX-License-Identifier: GPL-2.0-or-later
// Patches that turn inside, at C0 knots, cut there into parts.  A part has the parameters of its patch, and
// the part that has a point is told by these: a cut belongs to the part behind it, and a point of the other
// is before it by one unit of the last place.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "nurbs/multi_patch.h"

namespace brep {

class PatchParts {
 public:
  /// Of patches that are not cut.
  PatchParts() = default;
  /// Patches that turn by more than `edge_angle` [rad] at one of their knots are cut at all knots where they
  /// turn, whole lines of parameters; these cuts go on through patches beyond sides that are one curve.
  /// Throws std::invalid_argument as nurbs::check_patch does.
  PatchParts(const std::vector<nurbs::Surface>& patches, double edge_angle);

  bool none() const { return patch_of_.empty(); }
  /// Patch by patch, in each the first direction fastest.
  std::vector<nurbs::Surface> parts_of(const std::vector<nurbs::Surface>& patches) const;
  int patch_of(int part) const { return none() ? part : patch_of_[part]; }
  int part_at(const nurbs::SurfacePoint& at) const { return none() ? at.patch : part_of_cut(at); }
  /// The parameters of a point of a part, moved by round-off so that part_at() finds that part.
  void keep_in(int part, nurbs::Parameter<2>& xi) const {
    if (!none()) keep_in_cut(part, xi);
  }

 private:
  // Of one patch: its cuts inside, rising, and the number of its first part.
  struct Cuts {
    std::array<std::vector<double>, 2> at;
    int first_part = 0;
    int count(int direction) const { return static_cast<int>(at[direction].size()) + 1; }
  };
  bool add(const nurbs::Surface& patch, int direction, double relative, Cuts& cuts) const;
  void continue_through(const std::vector<nurbs::Surface>& patches);
  int part_of_cut(const nurbs::SurfacePoint& at) const;
  void keep_in_cut(int part, nurbs::Parameter<2>& xi) const;

  std::vector<Cuts> cuts_;
  std::vector<int> patch_of_;  // of parts
};

}  // namespace brep
