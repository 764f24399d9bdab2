// SPDX-License-Identifier: GPL-2.0-or-later
// An element of the skin that is hit: where its feet may be.
#pragma once

#include "structure/compliance/free_faces.h"
#include "structure/compliance/near_elements.h"

namespace structure {

/// The element of the body behind one of a piece of its skin.
BodyElement element_behind(const ReferenceBody& body, const SkinPiece& piece, int element);
/// The other way: -1 if that element of the piece's patch does not touch the piece.
int element_on(const ReferenceBody& body, const SkinPiece& piece, int volume_element);

class HitElement {
 public:
  /// Keeps a reference to the surface.  Throws std::invalid_argument if it has no normal at a side's middle.
  HitElement(const ReferenceBody& body, const NearElements& near, const SkinPiece& piece,
             const FaceSurface& surface, int element);

  const BodyElement& volume() const { return volume_; }
  /// The foot that has the compliance asked for at xi: where the skin ends at a side, or the body stands up
  /// beyond it, no nearer to it than a quarter of the element.
  nurbs::Parameter<2> inside(nurbs::Parameter<2> xi) const;
  SkinPoint foot(const nurbs::Parameter<2>& xi) const { return surface_.at(element_, inside(xi)); }
  /// How far that foot is from such a side, about; infinite without one [length].
  double room(const nurbs::Parameter<2>& xi) const;
  Matrix3 frame(const nurbs::Parameter<2>& xi) const { return surface_.frame(element_, inside(xi)); }

 private:
  bool is_edge(const NearElements& near, const SkinPiece& piece, int direction, int side) const;

  const FaceSurface& surface_;
  int element_;
  BodyElement volume_;
  nurbs::Parameter<2> low_, high_;        // of the element
  nurbs::Parameter<2> lowest_, highest_;  // of its feet
};

}  // namespace structure
