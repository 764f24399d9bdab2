// SPDX-License-Identifier: GPL-2.0-or-later
// Feet over planes and cylinders, many at a time, as functions on plain numbers: they are compiled once for
// each instruction set that simd_level.h knows.  All find the same digits, those of brep::PlaneTriangle and
// brep::Face, as nothing is fused.
#pragma once

#include "nurbs/simd_level.h"

namespace contact {

/// Centres and their feet, number by number.  Lengths have one unit throughout; `xi` is the patch's.
struct FeetBlock {
  static constexpr int kCapacity = 64;
  using Lanes = double[kCapacity + 8];

  int count = 0;
  alignas(64) Lanes centre[3] = {};                       // in space; then in the wall's frame
  Lanes squared_speed = {};                               // in space
  Lanes before[3] = {};                                   // where they were looked at, in the frame
  Lanes touch_reach = {}, margin = {};                    // how far it touches; how far it may move
  Lanes sign = {};                                        // of their height over the face
  Lanes origin[3] = {}, x[3] = {}, y[3] = {};             // of their planes
  Lanes scale[2] = {}, shift[2] = {};                     // from the face's to the patch's parameters
  Lanes cos = {}, sin = {}, length = {}, from_axis = {};  // of cylinders
  Lanes room = {};                                        // > 0: the foot is what it was kept as, and touches
  Lanes delta[3] = {};                                    // from the foot to the centre
  Lanes distance = {}, xi[2] = {};
};

/// The plane that all are over.
struct PlaneNumbers {
  double origin[3], x[3], y[3], normal[3];
  double scale[2], shift[2];
};

/// Or the cylinder: nearer to its axis than `least` there is no foot.
struct CylinderNumbers {
  double origin[3], x[3], y[3], z[3];
  double radius, least;
};

/// What a step leaves of contacts that need no second look: a centre stays farther from its foot than it and
/// the wall move in the step, whose squared way is at most `squared_time` v^2 + `squared_way`; than half of
/// what it reaches; and than `resolution` [length].
struct StepNumbers {
  double squared_time, squared_way, resolution;
};

/// R is a rotation, by rows.
struct FeetKernel {
  /// centre: from space into the frame, R^T (centre - origin), R null if it is not turned.
  void (*into_frame)(FeetBlock& block, const double* origin, const double* R);
  /// delta: R delta.
  void (*into_space)(FeetBlock& block, const double* R);
  /// room: how far they may still move until other faces matter, squared.
  void (*room_to_move)(FeetBlock& block);
  void (*over_one_plane)(FeetBlock& block, const PlaneNumbers& plane);
  void (*over_planes)(FeetBlock& block);
  /// All but xi, of which cos, sin and length are found.
  void (*over_one_cylinder)(FeetBlock& block, const CylinderNumbers& cylinder);
  /// room: also that the step is one of those.
  void (*stay_outside)(FeetBlock& block, const StepNumbers& step);
  /// Whether any of `count` values is above its limit: what is asked of all particles in each step.
  bool (*any_above)(const double* values, const double* limits, int count);
};

/// Throws std::invalid_argument if this machine does not have the instruction set.
FeetKernel feet_kernel(nurbs::SimdLevel level);

}  // namespace contact
