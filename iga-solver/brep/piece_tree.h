// SPDX-License-Identifier: GPL-2.0-or-later
// A tree of boxes over the pieces of a wall, in single precision, rounded outwards; below it a flat disc
// around every piece, which lists of pieces are filtered by.
#pragma once

#include <cstdint>
#include <vector>

#include "brep/surface.h"
#include "search/box_units.h"

namespace brep {

class PieceTree {
 public:
  /// Looks at the surface now; keeps nothing of it.
  explicit PieceTree(const Surface& surface);

  /// Where a point is, and how far away a piece may be, in the tree's units.
  struct Query {
    float d[3];
    float reach;
  };
  Query query(const Vector3& d, double reach) const;

  /// Appends the pieces that may be within reach, in no order.
  void near(const Query& query, std::vector<int>& pieces) const;
  /// False if the piece is farther than the reach for certain.
  bool may_be_near(const Query& query, int piece) const {
    const Disc& disc = discs_[piece];
    const float x = query.d[0] - disc.centre[0], y = query.d[1] - disc.centre[1],
                z = query.d[2] - disc.centre[2], far = query.reach + disc.radius;
    const float height = x * disc.normal[0] + y * disc.normal[1] + z * disc.normal[2];
    return std::abs(height) <= query.reach + disc.thickness && x * x + y * y + z * z <= far * far;
  }

 private:
  struct Disc {
    float centre[3], radius, normal[3], thickness;  // half; no normal: a ball
  };
  struct Node {
    float low[3], high[3];
    std::int32_t first;  // of the pieces in a leaf, or the second child; the first child follows its parent
    std::int32_t count;  // 0: not a leaf
  };
  struct Boxes;
  void set_disc(const Surface& surface, int piece);
  void build(const Boxes& boxes, int first, int count);

  search::BoxUnits units_;
  std::vector<Disc> discs_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace brep
