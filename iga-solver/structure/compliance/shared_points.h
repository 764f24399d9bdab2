// SPDX-License-Identifier: GPL-2.0-or-later
// Points that the tables of several elements have in common: those on their borders, where the skin is
// smooth.
#pragma once

#include <vector>

#include "structure/compliance/near_elements.h"

namespace structure {

class FaceSurface;

/// Of the table of an element: index counts as table_points() does.
struct TablePoint {
  int piece, element, index;
  Vector3 normal;  ///< of the element there, outwards; 0 if it has none everywhere
  bool operator<(const TablePoint& other) const;
};

class SharedPoints {
 public:
  /// The angle between normals below which an edge is smooth, as it is for contacts [rad].
  static constexpr double kSmooth = 0.02;

  /// Keeps references to all; surfaces are those of the pieces.
  SharedPoints(const ReferenceBody& body, const NearElements& near, const std::vector<SkinPiece>& skin,
               const std::vector<FaceSurface>& surfaces);

  /// Per point of an element's table all that are in its place, itself included, rising; across welds and
  /// convex edges, too.  Elements without a normal somewhere have none in common with others.
  std::vector<std::vector<TablePoint>> of(int piece, int element) const;

 private:
  struct Sides {
    int piece, element;
    Vector3 centre;          // of the element
    std::vector<int> index;  // points on its sides
    std::vector<Vector3> place, normal;
    /// Seen from one of these points.
    bool is_above(int point, const Vector3& place_of_other) const {
      return normal[point].dot(place_of_other - place[point]) > 0.0;
    }
  };
  Sides sides_of(int piece, int element) const;
  std::vector<Sides> beside(int piece, int element) const;

  const ReferenceBody& body_;
  const NearElements& near_;
  const std::vector<SkinPiece>& skin_;
  const std::vector<FaceSurface>& surfaces_;
};

}  // namespace structure
