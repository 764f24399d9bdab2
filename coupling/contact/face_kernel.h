// SPDX-License-Identifier: GPL-2.0-or-later
// Feet over faces in closed form, each over its own, many at a time: as functions on plain numbers, compiled
// once for each instruction set that simd_level.h knows.  All find the same digits, those of
// brep::Face::project, as nothing is fused.
#pragma once

#include "nurbs/simd_level.h"

namespace brep {
struct Face;
}

namespace contact {

/// What a face is, in numbers: those of a line's meridian (cylinder, cone), of a circle's (sphere, torus).
struct FaceNumbers {
  enum Of {
    origin = 0,
    x = 3,
    y = 6,
    z = 9,
    cos = 12,       // of half the angle of a cone; a cylinder is one of angle 0 ...
    sin,            //
    radius,         // ... that is so far from its axis
    ring,           // radius of a torus' circle, 0 of a sphere [length]
    tube,           // of the tube, of a sphere [length]
    least,          // nearer to the axis there is no foot [length]
    least_of_cone,  // the same of the height along it
    low,            // of the range of xi
    high = low + 2,
    is_plane = high + 2,  // else 0
    is_circle,
    count
  };
  double value[count] = {};

  /// Not of kind nurbs.
  static FaceNumbers of(const brep::Face& face);
};

/// Centres in the wall's frame and their feet, number by number.
struct FaceBlock {
  static constexpr int kCapacity = 64;
  using Lanes = double[kCapacity + 8];

  int count = 0;
  alignas(64) Lanes face[FaceNumbers::count] = {};
  Lanes centre[3] = {};
  Lanes sign = {};         // of their height over the face
  Lanes touch_reach = {};  // [length]
  Lanes room = {};         // as FeetBlock::room: at most what it was
  Lanes delta[3] = {};     // from the foot to the centre
  Lanes distance = {}, xi[2] = {};
};

using FaceKernel = void (*)(FaceBlock& block);
/// Throws std::invalid_argument if this machine does not have the instruction set.
FaceKernel face_kernel(nurbs::SimdLevel level);

}  // namespace contact
