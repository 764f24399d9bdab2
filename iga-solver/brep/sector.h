// SPDX-License-Identifier: GPL-2.0-or-later
// The sector of a face at a vertex as a cone of directions: plane, part of the tip of a cone, or that of all
// ways that lead off the pole of a patch.
#pragma once

#include "brep/surface.h"

namespace brep {

class Sector {
 public:
  Sector(const Surface& surface, const Vertex& vertex, const Corner& corner);

  /// Greatest w . g over the unit vectors g of the sector off its rays, or `rays` if w is not over it.
  double steepest(const Vector3& w, double rays) const;
  /// Whether w is over the sector, nearest to a direction inside it.
  bool over(const Vector3& w) const;
  /// +1 or -1: the side of the face that looks to w, which is over the sector.
  int side(const Vector3& w) const { return height(w) > 0.0 ? 1 : -1; }
  /// How far w is from the sector, which it is over, on side +.
  double height(const Vector3& w) const;
  /// Off side +: the normal of a plane, the axis of a tip.
  const Vector3& axis() const { return axis_; }
  const Vector3& ray(int k) const { return ray_[k]; }

 private:
  double steepest_off_pole(const Vector3& w, double rays, double& part) const;

  const Surface& surface_;
  const Pole* pole_ = nullptr;
  Vector3 axis_;  // counterclockwise about it from ray to ray
  Vector3 ray_[2];
  double cos_ = 0.0, sin_ = 1.0;  // of the angle between -axis and the sector
  bool whole_, reflex_;
};

/// Direction of an edge off its end that is at this ray.
Vector3 ray_direction(const Surface& surface, int ray);

}  // namespace brep
