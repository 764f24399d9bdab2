// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/periodic_images.h"

#include <algorithm>
#include <cmath>

namespace contact {

using nurbs::Vector3;
using search::Box;

namespace {

// Axis-aligned box in space around a box of the frame.
Box box_in_space(const Box& box, const coupling::RigidFrame& frame) {
  const Vector3 half = 0.5 * (box.high - box.low);
  const Vector3 centre = frame.to_space(box.low + half), extent = frame.rotation.cwiseAbs() * half;
  return {centre - extent, centre + extent};
}

}  // namespace

std::vector<Vector3> periods(const PeriodicBox& box) {
  std::vector<Vector3> result;
  for (int d = 0; d < 3; ++d)
    if (box.periodic[d]) result.push_back((box.high[d] - box.low[d]) * Vector3::Unit(d));
  return result;
}

// A wall that moves may have left the box on one side long ago: what counts is its image that is nearest.
std::vector<Vector3> wall_images(const PeriodicBox& box, const Box& wall, const coupling::RigidFrame& frame,
                                 double reach) {
  Box near_box{box.low, box.high};
  near_box.inflate(reach);
  const Box in_space = box_in_space(wall, frame);
  std::vector<Vector3> images = {Vector3::Zero()};
  for (int d = 0; d < 3; ++d) {
    if (!box.periodic[d]) continue;
    const double period = box.high[d] - box.low[d],
                 off = 0.5 * (box.low[d] + box.high[d] - in_space.low[d] - in_space.high[d]),
                 nearest = std::nearbyint(off / period);
    const std::vector<Vector3> before = std::move(images);
    images.clear();
    for (const Vector3& image : before)
      for (const double further : {0.0, 1.0, -1.0})
        images.push_back(image + (nearest + further) * period * Vector3::Unit(d));
  }
  const auto is_left_out = [&](const Vector3& image) {
    return image.isZero(0.0) || !near_box.overlaps({in_space.low + image, in_space.high + image});
  };
  images.erase(std::remove_if(images.begin(), images.end(), is_left_out), images.end());
  images.insert(images.begin(), Vector3::Zero());
  return images;
}

}  // namespace contact
