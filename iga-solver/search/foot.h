// SPDX-License-Identifier: GPL-2.0-or-later
// What every search for closest points returns.
#pragma once

#include "search/names.h"

namespace search {

enum class FootStatus {
  interior,      ///< inside the patch: d - S is normal to the surface
  edge,          ///< on an edge of the patch or on a crease
  corner,        ///< on a corner of these
  not_converged  ///< no foot: the point, the guess or control points are not finite (simplex_brent.h: gave
                 ///< up)
};

/// A foot of a point d: where the distance from a surface has a local minimum.
struct Foot {
  Parameter<2> xi;  ///< parameters on its patch
  Vector3 point;    ///< S(xi) + image [length]
  double distance;  ///< |d - point| [length]
  FootStatus status;
  int iterations;                   ///< of the descents that found it
  int patch = 0;                    ///< of a surface of patches
  Vector3 image = Vector3::Zero();  ///< the surface was met moved by this (periodic images) [length]

  SurfacePoint at() const { return {patch, xi}; }
};

/// The foot of d + image where `foot` is one of d on a single surface, which is patch `patch` here.
inline Foot placed(Foot foot, int patch, const Vector3& image) {
  foot.patch = patch;
  foot.image = image;
  foot.point += image;
  return foot;
}

}  // namespace search
