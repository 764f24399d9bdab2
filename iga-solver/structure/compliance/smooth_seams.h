// SPDX-License-Identifier: GPL-2.0-or-later
// Seams of a body's skin: where patches are welded, or a patch has a C0 knot, and the undeformed surface has
// no kink.  A mesh kinks there as it deforms, and under a contact most: its foot would jump from side to side
// of its own dent.  So contacts meet a seam's nodes s in line with those beside them, a and b, as they stood,
//
//   x_s = share x_a + (1 - share) x_b,
//
// which leaves the surface G1 however a and b move; where s is on no line with them, with shares of those
// beside the two along the seam, too, about G1.  The seam itself would still give way as twice as fine a
// mesh does; so a and b are met beside where they are by part of the kink k,
//
//   x_a + kPress k,  x_b + kPress k,   k = x_s - share x_a - (1 - share) x_b,
//
// and forces on all three go to nodes by the transposed shares: with them the kink stays about 0, and the
// mesh gives way as it does without a seam (README.md).  Sums and moments of forces stay, as k of a rigid
// motion is 0.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "structure/compliance/free_faces.h"
#include "structure/compliance/reference_body.h"

namespace structure {

class SmoothSeams {
 public:
  /// By how much of the kink a and b are met beside where they are, and the nodes next to them; of cubic
  /// patches also by how much of b = x_a - x_b less as much of the nodes next to them, at a as here, at b the
  /// other way.
  struct Press {
    double kink[2], bend[2];
  };
  /// Of quadratic and of cubic patches: so that forces on two elements on each side of a seam leave neither.
  static constexpr Press kPress[] = {{{0.45, -0.15}, {0.0, 0.0}}, {{0.52, -0.23}, {-0.39, 0.32}}};

  /// Of the pieces of the skin that forces act on.
  SmoothSeams(const ReferenceBody& body, const std::vector<SkinPiece>& skin);

  /// A node, `from`, is met at the sum of shares of nodes.
  struct Share {
    Id from, to;
    double share;
  };
  /// Of nodes on seams and beside them, rising; those from a node sum to 1.
  std::vector<Share> shares() const;
  /// Of a node on a seam those that it is met between, which are on none; null: it is on none either.
  using Row = std::map<Id, double>;
  const Row* between(Id node) const {
    const auto found = between_.find(node);
    return found == between_.end() ? nullptr : &found->second;
  }
  /// Nodes where a mesh kinks, and is met so: between no two of those beside them, though the undeformed
  /// surface has no edge there.  Rising.
  const std::vector<Id>& kinks() const { return kinks_; }
  /// What forces on nodes, as they are met, are on the body's: by nodes, rising, but as they are if none is
  /// met elsewhere.
  void carry(std::vector<Id>& nodes, std::vector<double>& forces) const;
  SkinPoint carried(SkinPoint foot) const;

 private:
  std::map<Id, Row> between_;
  std::map<Id, Row> rows_;  // of nodes that are met elsewhere
  std::vector<Id> kinks_;
};

}  // namespace structure
