// SPDX-License-Identifier: GPL-2.0-or-later
// How faces of a wall of patches are called by all others: by patches, their parameters and their sides.
#pragma once

#include <vector>

#include "brep/chart.h"
#include "brep/patch_parts.h"

namespace contact {

struct FaceNames {
  const std::vector<brep::Chart>* charts = nullptr;  ///< null: the faces' own parameters
  const brep::PatchParts* parts = nullptr;           ///< null: faces have the numbers of patches

  FaceNames() = default;
  /// Keeps references.
  FaceNames(const std::vector<brep::Chart>& of_charts, const brep::PatchParts& of_parts)
      : charts(of_charts.empty() ? nullptr : &of_charts), parts(of_parts.none() ? nullptr : &of_parts) {}

  int patch_of(int face) const { return parts ? parts->patch_of(face) : face; }
  int face_at(const nurbs::SurfacePoint& at) const { return parts ? parts->part_at(at) : at.patch; }
  /// Parameters of a point of the face on its patch.
  nurbs::Parameter<2> on_patch(int face, const nurbs::Parameter<2>& xi) const {
    return inside(face, charts ? (*charts)[face].to_patch(xi) : xi);
  }
  /// Parameters on the patch that round-off may have brought out of the face.
  nurbs::Parameter<2> inside(int face, nurbs::Parameter<2> on) const {
    if (charts) on = (*charts)[face].inside(on);
    if (parts) parts->keep_in(face, on);
    return on;
  }
  /// A side of the face as one of the patch, and back.
  int side(int face, int side) const { return charts ? (*charts)[face].side * side : side; }
};

}  // namespace contact
