// SPDX-License-Identifier: GPL-2.0-or-later
// A tree of boxes over the pieces of a wall, in single precision, rounded outwards; below it a flat disc
// around every piece, which lists of pieces are filtered by.
#pragma once

#include <cstdint>
#include <vector>

#include "brep/bounds.h"
#include "brep/surface.h"
#include "nurbs/processor.h"
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

  /// Appends the pieces that may be within reach, in no order; those with several boxes maybe more than once.
  void near(const Query& query, std::vector<int>& pieces) const;
  /// Those of these pieces that are not farther than the reach for certain.  Returns their number; `kept` has
  /// room for `count`, and may be `pieces`.
  int filter(const Query& query, const int* pieces, int count, int* kept) const {
    int number = 0;
    for (int k = 0; k < count; ++k) {  // without branches: which pieces are near follows no pattern
      const int piece = pieces[k];
      kept[number] = piece;
      number += static_cast<int>(may_be_near(query, discs_[piece]));
    }
    return number;
  }
  /// Distance of the boxes of a piece that has several, in parts: such a piece is much less than the surface
  /// that it is cut from [length], rounded down, infinite if it is beyond the reach; else 0.
  double distance_of_parts(const Query& query, int piece) const {
    return first_part_.empty() || first_part_[piece] == first_part_[piece + 1]
               ? 0.0
               : distance_of_boxes(query, first_part_[piece], first_part_[piece + 1]);
  }
  /// Has the processor fetch what the filter looks at.
  void prefetch(const int* pieces, int count) const {
    for (int k = 0; k < count; ++k) nurbs::prefetch(discs_[pieces[k]]);
  }

 private:
  struct alignas(32) Disc {
    float centre[3], radius, normal[3], thickness;  // half; no normal: a ball
  };
  // At a height h over the disc's plane, d is within `far` of it if it is within R + sqrt(far^2 - h^2) of its
  // axis; here without the root.
  static bool may_be_near(const Query& query, const Disc& disc) {
    const float x = query.d[0] - disc.centre[0], y = query.d[1] - disc.centre[1],
                z = query.d[2] - disc.centre[2];
    const float far = query.reach + disc.thickness, R2 = disc.radius * disc.radius;
    const float h = x * disc.normal[0] + y * disc.normal[1] + z * disc.normal[2];
    const float left = far * far - h * h, beyond = x * x + y * y + z * z - R2 - far * far;
    return static_cast<int>(left >= 0.0f) &
           (static_cast<int>(beyond <= 0.0f) | static_cast<int>(beyond * beyond <= 4.0f * R2 * left));
  }
  struct Node {
    float low[3], high[3];
    std::int32_t first;  // of the pieces in a leaf, or the second child; the first child follows its parent
    std::int32_t count;  // 0: not a leaf
  };
  struct Boxes;
  static constexpr int kGroup = 8;
  using OfGroup = Eigen::Array<float, kGroup, 1>;
  static OfGroup off2(const Query& query, const std::vector<float> (&low)[3],
                      const std::vector<float> (&high)[3], int first);
  double distance_of_boxes(const Query& query, int first, int end) const;
  void keep_parts(const Boxes& boxes, int pieces);
  void set_disc(const Surface& surface, int piece, const std::vector<Bounds>& boxes);
  void build(const Boxes& boxes, int first, int count);

  search::BoxUnits units_;
  std::vector<Disc> discs_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
  // Boxes of pieces with several, each coordinate in a row; none of others.
  std::vector<std::int32_t> first_part_;
  std::vector<float> part_low_[3], part_high_[3], group_low_[3], group_high_[3];
};

}  // namespace brep
