// SPDX-License-Identifier: GPL-2.0-or-later
// A piece of the undeformed skin, whole, whatever part of the body a rank holds.
#pragma once

#include "structure/body.h"
#include "structure/node_numbering.h"

namespace structure {

struct SkinSurface {
  SkinPiece piece;
  nurbs::BoundarySurface face;  ///< its control points are nodes of the whole body
  NodalVectors X;               ///< undeformed, 3 x control points of the face [length]
};

/// Of a body in one piece.
inline SkinSurface skin_surface(const Body& body, const SkinPiece& piece) {
  nurbs::BoundarySurface face = body.skin(piece);
  NodalVectors X = body.reference()(Eigen::all, face.volume_control_point);
  return {piece, std::move(face), std::move(X)};
}

/// Of the patch that `piece` names, with the nodes of the body.
inline SkinSurface skin_surface(const nurbs::Volume& patch, const SkinPiece& piece,
                                const NodeNumbering& nodes) {
  nurbs::BoundarySurface face = nurbs::boundary_surface(patch.space, piece.face);
  NodalVectors X = patch.control_points(Eigen::all, face.volume_control_point);
  for (int& point : face.volume_control_point) point = static_cast<int>(nodes.node(piece.patch, point));
  return {piece, std::move(face), std::move(X)};
}

}  // namespace structure
