// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/skin_boxes.h"

namespace structure {

namespace {

/// Elements of the face that the box has, the first direction fastest; the face's are the volume's two
/// others.
std::vector<int> elements_on_face(const nurbs::Space<3>& space, const SpanBox& box, int normal) {
  const int u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;
  std::vector<int> elements;
  for (int j = box.begin[v]; j < box.end[v]; ++j)
    for (int i = box.begin[u]; i < box.end[u]; ++i)
      elements.push_back(i + space.knots(u).element_count() * j);
  return elements;
}

}  // namespace

std::vector<SkinBox> skin_boxes(const nurbs::Space<3>& space, nurbs::Face face,
                                const std::vector<PlacedBox>& boxes) {
  const int normal = static_cast<int>(face) / 2, u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;
  const bool plus = static_cast<int>(face) % 2 == 1;
  const int layer = plus ? space.control_point_count(normal) - 1 : 0,
            span = plus ? space.knots(normal).element_count() - 1 : 0;
  std::vector<SkinBox> found;
  for (const PlacedBox& box : boxes) {
    if (span < box.spans.begin[normal] || span >= box.spans.end[normal]) continue;
    SkinBox skin{elements_on_face(space, box.spans, normal), {}, {}, {}};
    const std::vector<int> points = box_nodes(space, box.spans);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int n_xi = space.control_point_count(0), n_eta = space.control_point_count(1), A = points[i];
      const std::array<int, 3> index{A % n_xi, A / n_xi % n_eta, A / (n_xi * n_eta)};
      if (index[normal] != layer) continue;
      skin.control_points.push_back(index[u] + space.control_point_count(u) * index[v]);
      skin.read.push_back(box.read()[i]);
      skin.write.push_back(box.write()[i]);
    }
    found.push_back(std::move(skin));
  }
  return found;
}

}  // namespace structure
