// SPDX-License-Identifier: GPL-2.0-or-later
// Feet over planes and cylinders, many at a time, as functions on plain numbers: they are compiled once for
// each instruction set that simd_level.h knows.  All find the same digits, those of brep::PlaneTriangle and
// brep::Face, as nothing is fused.
#pragma once

#include "brep/chart_numbers.h"
#include "nurbs/simd_level.h"

namespace contact {

constexpr int kFeetCapacity = 32;  // with their contacts they stay in the first cache
using FeetLanes = double[kFeetCapacity + 8];

/// A centre that is nearer to the surface than that, of its reach, is looked at by itself: it may be about to
/// pass the surface, or be behind a skin.
constexpr double kDeepInReach = 0.5;

/// What feet have been kept with, number by number: it is read in place in each step.  Feet last as long as
/// the centre reaches `margin` less than `reach` and has not moved by more; lines without a foot have a
/// margin < 0.
struct KeptFeet {
  alignas(64) FeetLanes centre[3] = {};  // where it was looked at, in the frame
  FeetLanes reach = {}, margin = {};
  FeetLanes sign = {};  // of its height over the face
  // Of the planes below, and from their parameters to the patch's; of edges start, direction, and from the
  // way along them; else they may hold anything.
  FeetLanes origin[3] = {}, x[3] = {}, y[3] = {};
  FeetLanes scale[2] = {}, shift[2] = {};
};

/// Centres and their feet, likewise.  Lengths have one unit throughout; `xi` is the patch's.
struct FeetBlock {
  static constexpr int kCapacity = kFeetCapacity;
  using Lanes = FeetLanes;

  int count = 0;
  alignas(64) Lanes centre[3] = {};       // in space; then in the wall's frame
  Lanes squared_speed = {};               // in space
  Lanes touch_reach = {};                 // how far it touches
  Lanes cos = {}, sin = {}, length = {};  // of cylinders
  Lanes room = {};                        // > 0: the foot is what it was kept as, and touches
  Lanes delta[3] = {};                    // from the foot to the centre
  Lanes distance = {}, xi[2] = {};
};

/// The plane that all are over.
struct PlaneNumbers {
  double origin[3], x[3], y[3], normal[3];
  double scale[2], shift[2];
};

/// Or the cylinder: nearer to its axis than `least` there is no foot.  Its patch around it and along it.
struct CylinderNumbers {
  double origin[3], x[3], y[3], z[3];
  double radius, least;
  brep::ChartNumbers around, along;
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
  void (*room_to_move)(FeetBlock& block, const KeptFeet& kept);
  void (*over_one_plane)(FeetBlock& block, const KeptFeet& kept, const PlaneNumbers& plane);
  void (*over_planes)(FeetBlock& block, const KeptFeet& kept);
  void (*over_one_cylinder)(FeetBlock& block, const KeptFeet& kept, const CylinderNumbers& cylinder);
  /// room: also that the step is one of those.
  void (*stay_outside)(FeetBlock& block, const StepNumbers& step);
  /// Whether any of `count` values is above its limit: what is asked of all particles in each step.
  bool (*any_above)(const double* values, const double* limits, int count);
};

/// Throws std::invalid_argument if this machine does not have the instruction set.
FeetKernel feet_kernel(nurbs::SimdLevel level);

}  // namespace contact
