// SPDX-License-Identifier: GPL-2.0-or-later
// A patch cut into boxes of knot spans, by the patch alone: whoever holds which of them, forces are added box
// after box, in the order of their numbers.
#pragma once

#include <array>
#include <vector>

#include "nurbs/patch.h"
#include "structure/partition.h"

namespace structure {

/// Knot spans begin <= span < end in each direction.
struct SpanBox {
  std::array<int, 3> begin, end;
  int spans(int direction) const { return end[direction] - begin[direction]; }
  int element_count() const { return spans(0) * spans(1) * spans(2); }
  bool holds(const std::array<int, 3>& span) const {
    for (int d = 0; d < 3; ++d)
      if (span[d] < begin[d] || span[d] >= end[d]) return false;
    return true;
  }
  /// Elements are counted with the first direction fastest.
  int element(const std::array<int, 3>& span) const {
    return span[0] - begin[0] + spans(0) * (span[1] - begin[1] + spans(1) * (span[2] - begin[2]));
  }
  std::array<int, 3> span(int element) const {
    return {begin[0] + element % spans(0), begin[1] + element / spans(0) % spans(1),
            begin[2] + element / (spans(0) * spans(1))};
  }
};

/// Spans of a box in each direction: whole words of numbers; what is in work fits into the cache beside the
/// processor; many ranks have one each.
constexpr std::array<int, 3> kBoxSpans = {32, 16, 16};

/// A direction is cut into pieces of kBoxSpans; the last has what is left, but no fewer spans than the
/// degree: so a control point has elements in at most two boxes per direction.
BoxCuts box_cuts(const nurbs::Space<3>& space);
/// Boxes, the first direction fastest.
std::vector<SpanBox> box_grid(const nurbs::Space<3>& space);

/// Control points of the elements of a box, the first direction fastest.
std::vector<int> box_nodes(const nurbs::Space<3>& space, const SpanBox& box);

/// How many of them there are in each direction.
std::array<int, 3> box_node_counts(const nurbs::Space<3>& space, const SpanBox& box);

/// A box, and where the values of its control points, as box_nodes gives them, stand in nodal arrays.
struct PlacedBox {
  SpanBox spans;
  std::vector<int> columns;             ///< of positions, displacements and forces
  std::vector<int> share_columns = {};  ///< of forces, where others than `columns`; else empty

  const std::vector<int>& read() const { return columns; }
  const std::vector<int>& write() const { return share_columns.empty() ? columns : share_columns; }
};

/// The part that has all of one patch whose control points are the nodes; and its boxes.
Part whole_part(const nurbs::Space<3>& space);
std::vector<PlacedBox> whole_patch(const nurbs::Space<3>& space);
/// Those of a patch that a part has, cut at box_cuts, in the order in which the part has them.
std::vector<PlacedBox> boxes_of(const Part& part, int patch, const nurbs::Space<3>& space);

}  // namespace structure
