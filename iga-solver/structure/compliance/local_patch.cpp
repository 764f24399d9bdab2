// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/local_patch.h"

#include <algorithm>
#include <utility>

namespace structure {

LocalExtent extent_for(const nurbs::Space<3>& space) {
  return {std::max({space.degree(0), space.degree(1), space.degree(2)}) + 1};
}

LocalPatch::LocalPatch(const ReferenceBody& body, const NearElements& near, const BodyElement& hit,
                       const LocalExtent& extent)
    : body_(body), hit_(hit), elements_(near.around(hit, extent.layers, extent.reach)) {
  number_nodes(near);
  take_free_faces(near);
}

bool LocalPatch::are_free(const std::vector<Id>& nodes) const {
  return std::all_of(nodes.begin(), nodes.end(), [&](Id node) {
    const auto place = place_.find(node);
    return place != place_.end() && place->second < free_;
  });
}

void LocalPatch::number_nodes(const NearElements& near) {
  std::map<Id, int> elements_inside;
  for (const BodyElement& element : elements_) {
    const nurbs::Space<3>& space = body_.patches[element.patch].space;
    std::vector<int> control_points(space.functions_per_element());
    space.element_control_points(element.element, control_points.data());
    for (const int a : control_points) ++elements_inside[body_.nodes.node(element.patch, a)];
  }
  std::vector<Id> shared;
  for (const auto& [node, inside] : elements_inside)
    (near.elements_of(node) == inside ? nodes_ : shared).push_back(node);
  free_ = static_cast<int>(nodes_.size());
  sort_along_widest_axis();
  nodes_.insert(nodes_.end(), shared.begin(), shared.end());
  for (std::size_t place = 0; place < nodes_.size(); ++place) place_[nodes_[place]] = static_cast<int>(place);
}

// So matrices have narrow bands.
void LocalPatch::sort_along_widest_axis() {
  if (nodes_.empty()) return;
  Vector3 low = body_.place(nodes_.front()), high = low;
  for (const Id node : nodes_) {
    low = low.cwiseMin(body_.place(node));
    high = high.cwiseMax(body_.place(node));
  }
  int axis;
  (high - low).maxCoeff(&axis);
  std::vector<std::pair<double, Id>> sorted;
  for (const Id node : nodes_) sorted.emplace_back(body_.place(node)[axis], node);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i] = sorted[i].second;
}

void LocalPatch::take_free_faces(const NearElements& near) {
  std::map<std::pair<int, nurbs::Face>, std::vector<int>> faces;
  for (const auto& [p, element] : elements_) {
    const nurbs::Space<3>& space = body_.patches[p].space;
    const nurbs::Indices<3> span = space.element_indices(element);
    for (int f = 0; f < 6; ++f) {
      const int d = f / 2, u = d == 0 ? 1 : 0, v = d == 2 ? 1 : 2;
      if (span[d] != (f % 2 == 0 ? 0 : space.knots(d).element_count() - 1)) continue;
      const auto face = static_cast<nurbs::Face>(f);
      if (near.is_free(p, face))
        faces[{p, face}].push_back(span[u] + space.knots(u).element_count() * span[v]);
    }
  }
  for (const auto& [piece, elements] : faces) free_faces_.push_back({{piece.first, piece.second}, elements});
}

std::vector<int> LocalPatch::places_of(const BodyElement& element) const {
  const nurbs::Space<3>& space = body_.patches[element.patch].space;
  std::vector<int> places(space.functions_per_element());
  space.element_control_points(element.element, places.data());
  for (int& place : places) place = place_.at(body_.nodes.node(element.patch, place));
  return places;
}

}  // namespace structure
