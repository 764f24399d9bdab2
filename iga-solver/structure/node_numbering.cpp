// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/node_numbering.h"

#include <algorithm>

#include "nurbs/assert.h"

namespace structure {

NodeNumbering::NodeNumbering(const std::vector<int>& control_points) : begin_{0} {
  for (const int count : control_points) begin_.push_back(begin_.back() + count);
  node_count_ = begin_.back();
}

NodeNumbering::NodeNumbering(const std::vector<int>& control_points, const std::vector<int>& first)
    : NodeNumbering(control_points) {
  NURBS_ASSERT(static_cast<Id>(first.size()) == node_count_, first.size(), node_count_);
  std::vector<std::pair<Id, Id>> again;  // nodes, and places that are not their first
  nodes_.resize(first.size());
  for (Id place = 0; place < begin_.back(); ++place) {
    if (first[place] == place) {
      nodes_[place] = static_cast<Id>(first_place_.size());
      first_place_.push_back(place);
    } else {
      nodes_[place] = nodes_[first[place]];
      again.emplace_back(nodes_[place], place);
    }
  }
  if (again.empty()) {
    nodes_.clear();
    first_place_.clear();
    return;
  }
  node_count_ = static_cast<Id>(first_place_.size());
  std::sort(again.begin(), again.end());
  for (const auto& [node, place] : again) {
    if (welded_.empty() || welded_.back() != node) {
      welded_.push_back(node);
      welded_places_.push_back({first_place_[node]});
    }
    welded_places_.back().push_back(place);
  }
}

NodeNumbering::Place NodeNumbering::place_of(Id in_order) const {
  const auto patch = std::upper_bound(begin_.begin(), begin_.end(), in_order) - begin_.begin() - 1;
  return {static_cast<int>(patch), static_cast<int>(in_order - begin_[patch])};
}

NodeNumbering::Place NodeNumbering::place(Id node) const {
  return place_of(first_place_.empty() ? node : first_place_[node]);
}

std::vector<NodeNumbering::Place> NodeNumbering::places_of_welded(std::size_t i) const {
  std::vector<Place> places;
  for (const Id place : welded_places_[i]) places.push_back(place_of(place));
  return places;
}

}  // namespace structure
