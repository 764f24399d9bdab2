// SPDX-License-Identifier: GPL-2.0-or-later
// The elements around one of them that a local compliance is worked out on, and their nodes.
#pragma once

#include <map>
#include <vector>

#include "structure/compliance/near_elements.h"

namespace structure {

/// How many elements take part: so many layers around the one that is hit, and as many more as are nearer to
/// it than `reach` times layers times its longest edge.
struct LocalExtent {
  int layers;
  double reach = 0.7;
};

/// p + 1 layers of elements around the one that is hit.
LocalExtent extent_for(const nurbs::Space<3>& space);

class LocalPatch {
 public:
  /// Keeps a reference to the body.
  LocalPatch(const ReferenceBody& body, const NearElements& near, const BodyElement& hit,
             const LocalExtent& extent);

  const ReferenceBody& body() const { return body_; }
  const BodyElement& hit() const { return hit_; }
  const std::vector<BodyElement>& elements() const { return elements_; }
  /// Nodes have places from 0 on: first those that no other element has, along the axis of their largest
  /// extent, then the others.
  const std::vector<Id>& nodes() const { return nodes_; }
  int free_count() const { return free_; }
  int place(Id node) const { return place_.at(node); }
  bool are_free(const std::vector<Id>& nodes) const;
  /// Of an element's control points, the first direction fastest.
  std::vector<int> places_of(const BodyElement& element) const;
  /// Elements of each free face of a patch, as that surface counts them.
  struct FreeFace {
    SkinPiece piece;
    std::vector<int> elements;
  };
  const std::vector<FreeFace>& free_faces() const { return free_faces_; }

 private:
  void number_nodes(const NearElements& near);
  void sort_along_widest_axis();
  void take_free_faces(const NearElements& near);

  const ReferenceBody& body_;
  BodyElement hit_;
  std::vector<BodyElement> elements_;
  std::vector<Id> nodes_;
  std::map<Id, int> place_;
  int free_ = 0;
  std::vector<FreeFace> free_faces_;
};

}  // namespace structure
