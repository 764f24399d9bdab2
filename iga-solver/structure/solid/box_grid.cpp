// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/box_grid.h"

#include <algorithm>

namespace structure {

namespace {

/// Where a direction is cut: first and last span included.
std::vector<int> cuts(const nurbs::KnotVector& knots, int longest) {
  const int spans = knots.element_count();
  std::vector<int> cuts{0};
  while (spans - cuts.back() >= longest + knots.degree()) cuts.push_back(cuts.back() + longest);
  cuts.push_back(spans);
  return cuts;
}

int first_node(const nurbs::KnotVector& knots, int element) {
  return knots.span_of_element(element) - knots.degree();
}

}  // namespace

BoxCuts box_cuts(const nurbs::Space<3>& space) {
  BoxCuts all;
  for (int d = 0; d < 3; ++d) all[d] = cuts(space.knots(d), kBoxSpans[d]);
  return all;
}

std::vector<SpanBox> box_grid(const nurbs::Space<3>& space) {
  const auto [x, y, z] = box_cuts(space);
  std::vector<SpanBox> boxes;
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
      for (std::size_t i = 0; i + 1 < x.size(); ++i)
        boxes.push_back({{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}});
  return boxes;
}

std::array<int, 3> box_node_counts(const nurbs::Space<3>& space, const SpanBox& box) {
  std::array<int, 3> counts;
  for (int d = 0; d < 3; ++d) {
    const nurbs::KnotVector& knots = space.knots(d);
    const int last = knots.span_of_element(box.end[d] - 1);
    counts[d] = last + 1 - first_node(knots, box.begin[d]);
  }
  return counts;
}

std::vector<int> box_nodes(const nurbs::Space<3>& space, const SpanBox& box) {
  std::array<int, 3> first, end = box_node_counts(space, box);
  for (int d = 0; d < 3; ++d) {
    first[d] = first_node(space.knots(d), box.begin[d]);
    end[d] += first[d];
  }
  std::vector<int> nodes;
  nodes.reserve(std::size_t(end[0] - first[0]) * (end[1] - first[1]) * (end[2] - first[2]));
  for (int k = first[2]; k < end[2]; ++k)
    for (int j = first[1]; j < end[1]; ++j)
      for (int i = first[0]; i < end[0]; ++i)
        nodes.push_back(i + space.control_point_count(0) * (j + space.control_point_count(1) * k));
  return nodes;
}

std::vector<PlacedBox> boxes_of(const Part& part, int patch, const nurbs::Space<3>& space) {
  const std::vector<SpanBox> grid = box_grid(space);
  const PatchPart& own = part.patches[patch];
  std::vector<PlacedBox> boxes;
  for (int b = own.begin; b < own.end; ++b) {
    PlacedBox& box = boxes.emplace_back(PlacedBox{grid[part.boxes[b] - own.first_box], part.gather[b]});
    if (part.scatter[b] != part.gather[b]) box.share_columns = part.scatter[b];
  }
  return boxes;
}

Part whole_part(const nurbs::Space<3>& space) { return Partition(space, box_cuts(space), 1).part(0); }

std::vector<PlacedBox> whole_patch(const nurbs::Space<3>& space) {
  return boxes_of(whole_part(space), 0, space);
}

}  // namespace structure
