// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes of a body of several patches.  Control points that are one node stand at the same place and move
// together: so patches are welded, and a patch to itself (a closed tube, an edge shrunk to a point).
#pragma once

#include <utility>
#include <vector>

#include "structure/id.h"

namespace structure {

/// Nodes are counted patch after patch, each in the order of its control points, where they come first.
class NodeNumbering {
 public:
  /// Where a node stands: a control point of a patch.
  struct Place {
    int patch, control_point;
  };

  /// Every control point is a node of its own.
  explicit NodeNumbering(const std::vector<int>& control_points);
  /// `first`: per patch and control point, the earliest one of all patches at its place (or itself), counted
  /// patch after patch.
  NodeNumbering(const std::vector<int>& control_points, const std::vector<int>& first);

  int patch_count() const { return static_cast<int>(begin_.size()) - 1; }
  int control_point_count(int patch) const { return static_cast<int>(begin_[patch + 1] - begin_[patch]); }
  Id node_count() const { return node_count_; }
  Id node(int patch, int control_point) const {
    const Id place = begin_[patch] + control_point;
    return nodes_.empty() ? place : nodes_[place];
  }
  /// Its first place.
  Place place(Id node) const;
  /// The nodes that stand at several places, rising.
  const std::vector<Id>& welded() const { return welded_; }
  /// All places of welded()[i], in order.
  std::vector<Place> places_of_welded(std::size_t i) const;

 private:
  Place place_of(Id in_order) const;

  std::vector<Id> begin_;  // control points of the patches before, and of all
  Id node_count_;
  std::vector<Id> nodes_, first_place_;  // per control point of all; per node; empty: they are the same
  std::vector<Id> welded_;
  std::vector<std::vector<Id>> welded_places_;
};

}  // namespace structure
