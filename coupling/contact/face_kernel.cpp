// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, as in feet_kernel.cpp.
#include "coupling/contact/face_kernel.h"

#include "brep/angle.h"

namespace contact {
namespace {

using Of = FaceNumbers;

[[gnu::always_inline]] inline double least_of(double a, double b) { return b < a ? b : a; }

// The turn of an angle that is in the range, or nearest to it.
[[gnu::always_inline]] inline double into_range(double angle, double low, double high) {
  constexpr double kTurn = 2.0 * 3.14159265358979323846;
  angle += kTurn * __builtin_ceil((low - angle) / kTurn);
  const bool is_nearer_below = angle > high && low + kTurn - angle < angle - high;
  return is_nearer_below ? angle - kTurn : angle;
}

// In the order in which brep::Face adds up.
void over_faces(FaceBlock& block) {
  const int count = block.count;
  for (int k = 0; k < count; ++k) {
    const auto of = [&](int number) { return block.face[number][k]; };
    const double from[3] = {block.centre[0][k] - of(Of::origin), block.centre[1][k] - of(Of::origin + 1),
                            block.centre[2][k] - of(Of::origin + 2)};
    const auto along = [&](int axis) {
      return of(axis) * from[0] + of(axis + 1) * from[1] + of(axis + 2) * from[2];
    };
    const double x = along(Of::x), y = along(Of::y), z = along(Of::z);
    const double rho = __builtin_sqrt(x * x + y * y), inverse = 1.0 / rho;
    const double cos = inverse * x, sin = inverse * y;
    // Meridians are lines
    const double length = z * of(Of::cos) + rho * of(Of::sin);
    const double over_line = (rho * of(Of::cos) - z * of(Of::sin)) - of(Of::radius);
    // or circles.
    const double off = rho - of(Of::ring), apart = __builtin_sqrt(off * off + z * z);
    const double cos1 = off / apart, sin1 = z / apart;
    const double over_circle = apart - of(Of::tube);
    const bool is_circle = of(Of::is_circle) != 0.0, is_plane = of(Of::is_plane) != 0.0;
    const double height = is_plane ? z : is_circle ? over_circle : over_line;
    for (int d = 0; d < 3; ++d) {
      const double e = cos * of(Of::x + d) + sin * of(Of::y + d), o = of(Of::origin + d);
      const double on_line =
          (o + of(Of::radius) * e) + length * (of(Of::cos) * of(Of::z + d) + of(Of::sin) * e);
      const double on_circle = (o + of(Of::ring) * e) + of(Of::tube) * (cos1 * e + sin1 * of(Of::z + d));
      const double on_plane = block.centre[d][k] - height * of(Of::z + d);
      const double point = is_plane ? on_plane : is_circle ? on_circle : on_line;
      block.delta[d][k] = block.centre[d][k] - point;
    }
    const double angle = into_range(brep::angle_of(cos, sin), of(Of::low), of(Of::high));
    const double second = into_range(brep::angle_of(cos1, sin1), of(Of::low + 1), of(Of::high + 1));
    block.xi[0][k] = is_plane ? x : angle;
    block.xi[1][k] = is_plane ? y : is_circle ? second : length;
    const double distance = block.sign[k] * height;
    block.distance[k] = distance;
    double room = least_of(block.room[k], least_of(distance, block.touch_reach[k] - distance));
    const double from_axis = rho - of(Of::least) - of(Of::least_of_cone) * __builtin_fabs(z);
    const double from_focus = least_of(from_axis, is_circle ? apart - of(Of::least) : room);
    room = is_plane ? room : least_of(room, from_focus);
    block.room[k] = room;
  }
}

}  // namespace

namespace NURBS_SIMD_LEVEL {

FaceKernel face_kernel() { return over_faces; }

}  // namespace NURBS_SIMD_LEVEL
}  // namespace contact
