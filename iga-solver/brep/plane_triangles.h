// SPDX-License-Identifier: GPL-2.0-or-later
// What most searches need of a triangle, together in two cache lines: is a point over it, or too far?
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "brep/surface.h"

namespace brep {

/// Where a point is from a triangle.
struct OverTriangle {
  enum class Where : std::int8_t { over, beside, too_far };
  Where where;
  Vector3 normal;   ///< of the face
  double height;    ///< along it [length]
  Parameter<2> xi;  ///< of the foot on the plane
};

class alignas(64) PlaneTriangle {
 public:
  PlaneTriangle() = default;
  /// `piece`: of `surface`; if it is no triangle, neither is this.
  PlaneTriangle(const Surface& surface, const Piece& piece);

  bool exists() const { return face_ >= 0; }
  int face() const { return face_; }

  /// Of the face's frame; the last is worked out.
  const Vector3& origin() const { return origin_; }
  const Vector3& x() const { return x_; }
  const Vector3& y() const { return y_; }
  Vector3 normal() const { return x_.cross(y_); }
  /// `place` where that is over the triangle for certain.
  OverTriangle over(const Vector3& d) const {
    const Vector3 from = d - origin_, n = normal();
    return {OverTriangle::Where::over, n, n.dot(from), {x_.dot(from), y_.dot(from)}};
  }
  /// Of a point from the triangle, at least, and by no more than twice the corners' distance from the plane
  /// too little [length].
  double least_distance(const Vector3& d) const;
  /// Least distance of a point's foot on the plane from those sides of this piece where the face ends;
  /// infinite if none does [length].
  double from_border(const Vector3& d, const Piece& piece) const;

  /// Of the space round the triangle, where one part of it is the nearest: its inside, a side or a corner.
  struct Region {
    double room;    ///< how far a point may move at least until it is in another one; sides inside the face
                    ///< do not count [length]
    double beside;  ///< of its foot on the plane from the triangle; 0: it is over it [length]
  };
  Region region(const Vector3& d, const Piece& piece) const;

  /// Too far is what is not nearer than `reach` for certain; over it is what is not farther than `slack`
  /// beyond a side [length].
  OverTriangle place(const Vector3& d, double reach, double slack) const;

 private:
  // Squared, from side i in the plane.
  double squared_distance_from_side(int i, const Parameter<2>& xi) const {
    const double *a = corner_[i], *b = corner_[(i + 1) % 3];
    const double way[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {xi[0] - a[0], xi[1] - a[1]};
    const double along = from[0] * way[0] + from[1] * way[1], length2 = way[0] * way[0] + way[1] * way[1];
    const double t = std::clamp(along / length2, 0.0, 1.0);
    const double off[2] = {from[0] - t * way[0], from[1] - t * way[1]};
    return off[0] * off[0] + off[1] * off[1];
  }
  // > 0: on the inner side of side i.
  double in_of_side(int i, const Parameter<2>& xi) const {
    const double *a = corner_[i], *b = corner_[(i + 1) % 3];
    return (b[0] - a[0]) * (xi[1] - a[1]) - (b[1] - a[1]) * (xi[0] - a[0]);
  }

  Vector3 origin_, x_, y_;  // of the face's frame
  double corner_[3][2];     // in that frame
  std::int32_t face_ = -1;
  float leeway_ = 0.0f;  // the corners' distance from the plane, at most [length]
};

inline OverTriangle PlaneTriangle::place(const Vector3& d, double reach, double slack) const {
  using Where = OverTriangle::Where;
  OverTriangle at = over(d);
  const double height = at.height, u = at.xi[0], v = at.xi[1];
  const double far = reach + static_cast<double>(leeway_), left = far * far - height * height;
  if (std::abs(height) >= reach) at.where = Where::too_far;
  for (int i = 0; i < 3 && at.where != Where::too_far; ++i) {
    const double *a = corner_[i], *b = corner_[(i + 1) % 3];
    const double way[2] = {b[0] - a[0], b[1] - a[1]};
    const double in = way[0] * (v - a[1]) - way[1] * (u - a[0]);
    if (in >= 0.0) continue;
    const double length2 = way[0] * way[0] + way[1] * way[1];
    if (in * in > left * length2)
      at.where = Where::too_far;
    else if (in * in > slack * slack * length2)
      at.where = Where::beside;
  }
  return at;
}

inline double PlaneTriangle::least_distance(const Vector3& d) const {
  const OverTriangle at = over(d);
  double beside2 = std::numeric_limits<double>::infinity();
  bool is_over = true;
  for (int i = 0; i < 3; ++i) {
    if (in_of_side(i, at.xi) >= 0.0) continue;
    is_over = false;
    beside2 = std::min(beside2, squared_distance_from_side(i, at.xi));
  }
  const double off2 = is_over ? 0.0 : beside2;
  return std::max(std::sqrt(at.height * at.height + off2) - static_cast<double>(leeway_), 0.0);
}

/// Of all pieces, by their numbers.
std::vector<PlaneTriangle> plane_triangles(const Surface& surface);

}  // namespace brep
