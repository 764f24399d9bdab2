// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all (tests/iga-solver/check_symbols.py).
#include "coupling/contact/feet_kernel.h"

namespace contact {
namespace {

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }

void into_frame(FeetBlock& block, const double* origin, const double* R) {
  for (int d = 0; d < 3; ++d) {
    const double o = origin[d];
    for (int k = 0; k < block.count; ++k) block.centre[d][k] -= o;
  }
  if (!R) return;
  for (int k = 0; k < block.count; ++k) {
    const double x = block.centre[0][k], y = block.centre[1][k], z = block.centre[2][k];
    block.centre[0][k] = R[0] * x + R[3] * y + R[6] * z;
    block.centre[1][k] = R[1] * x + R[4] * y + R[7] * z;
    block.centre[2][k] = R[2] * x + R[5] * y + R[8] * z;
  }
}

void into_space(FeetBlock& block, const double* R) {
  for (int k = 0; k < block.count; ++k) {
    const double x = block.delta[0][k], y = block.delta[1][k], z = block.delta[2][k];
    block.delta[0][k] = R[0] * x + R[1] * y + R[2] * z;
    block.delta[1][k] = R[3] * x + R[4] * y + R[5] * z;
    block.delta[2][k] = R[6] * x + R[7] * y + R[8] * z;
  }
}

// A particle may have grown or shrunk since.
void room_to_move(FeetBlock& __restrict block, const KeptFeet& __restrict kept) {
  for (int k = 0; k < block.count; ++k) {
    const double margin = least(kept.reach[k] - block.touch_reach[k], kept.margin[k]);
    const double x = block.centre[0][k] - kept.centre[0][k], y = block.centre[1][k] - kept.centre[1][k],
                 z = block.centre[2][k] - kept.centre[2][k];
    block.room[k] = margin * __builtin_fabs(margin) - (x * x + y * y + z * z);
  }
}

struct OnePlane {
  const PlaneNumbers& of;
  double origin(int d, int) const { return of.origin[d]; }
  double x(int d, int) const { return of.x[d]; }
  double y(int d, int) const { return of.y[d]; }
  double normal(int d, int) const { return of.normal[d]; }
  double scale(int i, int) const { return of.scale[i]; }
  double shift(int i, int) const { return of.shift[i]; }
};

struct EachItsPlane {
  const KeptFeet& of;
  double origin(int d, int k) const { return of.origin[d][k]; }
  double x(int d, int k) const { return of.x[d][k]; }
  double y(int d, int k) const { return of.y[d][k]; }
  double normal(int d, int k) const {
    const int i = (d + 1) % 3, j = (d + 2) % 3;
    return x(i, k) * y(j, k) - x(j, k) * y(i, k);
  }
  double scale(int i, int k) const { return of.scale[i][k]; }
  double shift(int i, int k) const { return of.shift[i][k]; }
};

// In the order in which brep::PlaneTriangle adds up.
template <class Planes>
[[gnu::always_inline]] inline void find_over(FeetBlock& __restrict block, const KeptFeet& __restrict kept,
                                             const Planes planes) {
  const int count = block.count;
  for (int k = 0; k < count; ++k) {
    const double x = block.centre[0][k] - planes.origin(0, k), y = block.centre[1][k] - planes.origin(1, k),
                 z = block.centre[2][k] - planes.origin(2, k);
    const auto along = [=](double a, double b, double c) { return a * x + b * y + c * z; };
    const double n[3] = {planes.normal(0, k), planes.normal(1, k), planes.normal(2, k)};
    const double height = along(n[0], n[1], n[2]);
    const double u = along(planes.x(0, k), planes.x(1, k), planes.x(2, k)),
                 v = along(planes.y(0, k), planes.y(1, k), planes.y(2, k));
    for (int d = 0; d < 3; ++d) block.delta[d][k] = block.centre[d][k] - (block.centre[d][k] - height * n[d]);
    block.xi[0][k] = u * planes.scale(0, k) + planes.shift(0, k);
    block.xi[1][k] = v * planes.scale(1, k) + planes.shift(1, k);
    const double distance = kept.sign[k] * height;
    block.distance[k] = distance;
    block.room[k] = least(block.room[k], least(distance, block.touch_reach[k] - distance));
  }
}

void over_one_plane(FeetBlock& block, const KeptFeet& kept, const PlaneNumbers& plane) {
  const PlaneNumbers own = plane;  // which no store changes
  find_over(block, kept, OnePlane{own});
}

void over_planes(FeetBlock& block, const KeptFeet& kept) { find_over(block, kept, EachItsPlane{kept}); }

// As brep::Face::polar_foot and brep::Chart::place have it.
void over_one_cylinder(FeetBlock& __restrict block, const KeptFeet& __restrict kept,
                       const CylinderNumbers& cylinder) {
  const CylinderNumbers c = cylinder;
  for (int k = 0; k < block.count; ++k) {
    const double x = block.centre[0][k] - c.origin[0], y = block.centre[1][k] - c.origin[1],
                 z = block.centre[2][k] - c.origin[2];
    const auto along = [=](const double* a) { return a[0] * x + a[1] * y + a[2] * z; };
    const double cos = along(c.x), sin = along(c.y);
    block.length[k] = along(c.z);
    const double from_axis = __builtin_sqrt(cos * cos + sin * sin), inverse = 1.0 / from_axis;
    block.cos[k] = cos * inverse, block.sin[k] = sin * inverse;
    const double distance = kept.sign[k] * (from_axis - c.radius);
    block.distance[k] = distance;
    block.room[k] = least(block.room[k], least(distance, block.touch_reach[k] - distance));
    block.room[k] = least(block.room[k], from_axis - c.least);
  }
  for (int k = 0; k < block.count; ++k) {
    const brep::OnChart around = brep::place_angle(c.around, block.cos[k], block.sin[k]),
                        along = brep::place_length(c.along, block.length[k]);
    block.xi[0][k] = around.on_patch, block.xi[1][k] = along.on_patch;
    block.room[k] = least(block.room[k], least(around.inside, along.inside));
  }
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < block.count; ++k)
      block.delta[d][k] =
          block.centre[d][k] - (c.origin[d] + c.radius * (block.cos[k] * c.x[d] + block.sin[k] * c.y[d]) +
                                block.length[k] * c.z[d]);
}

void stay_outside(FeetBlock& block, const StepNumbers& step) {
  const StepNumbers s = step;
  for (int k = 0; k < block.count; ++k) {
    const double distance = block.distance[k], way2 = s.squared_time * block.squared_speed[k] + s.squared_way;
    const double outside = least(distance * distance - way2, distance - kDeepInReach * block.touch_reach[k]);
    block.room[k] = least(block.room[k], least(outside, distance - s.resolution));
  }
}

bool any_above(const double* values, const double* limits, int count) {
  long above = 0;  // as wide as what is compared: else it is not vectorised
  for (int i = 0; i < count; ++i) above += values[i] > limits[i];
  return above > 0;
}

}  // namespace

namespace NURBS_SIMD_LEVEL {

FeetKernel feet_kernel() {
  return {into_frame,  into_space,        room_to_move, over_one_plane,
          over_planes, over_one_cylinder, stay_outside, any_above};
}

}  // namespace NURBS_SIMD_LEVEL
}  // namespace contact
