// SPDX-License-Identifier: GPL-2.0-or-later
// The elements around one of them, across welds, too.
#pragma once

#include <array>
#include <vector>

#include "structure/compliance/reference_body.h"

namespace structure {

/// Of a piece of the surface that is touched, counted as nurbs::Space does.
struct SkinElement {
  int piece, element;
};

class NearElements {
 public:
  /// Keeps a reference to the body.
  explicit NearElements(const ReferenceBody& body);

  /// The element and all that are at most `layers` vertices away, and those that are nearer to it than
  /// `layers` times `reach` of its longest edge; rising.
  std::vector<BodyElement> around(const BodyElement& element, int layers, double reach) const;
  /// Those with a common vertex, itself included, in any order.
  std::vector<BodyElement> neighbours(const BodyElement& element) const;
  /// The sine of the largest angle at which an element's corners are seen above a plane from a point of it;
  /// -1 if none is above.
  double rise(const BodyElement& element, const Vector3& point, const Vector3& normal) const;
  /// Whether all of these are corners of the element.
  bool has_corners(const BodyElement& element, const std::vector<Vector3>& points) const;
  /// How many elements of the body have the node.
  int elements_of(Id node) const;
  /// Whether a face of a patch is part of the body's skin.
  bool is_free(int patch, nurbs::Face face) const { return is_free_[6 * patch + static_cast<int>(face)]; }

 private:
  using Corners = std::array<Vector3, 8>;
  /// Half-open ranges of spans that a control point's function is not zero on, per direction.
  std::array<std::array<int, 2>, 3> support(int patch, int control_point) const;
  std::vector<NodeNumbering::Place> places_of(Id node) const;
  Corners corners(const BodyElement& element) const;
  void append_across_welds(const BodyElement& element, std::vector<BodyElement>& found) const;

  const ReferenceBody& body_;
  std::vector<bool> is_free_;
};

}  // namespace structure
