// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/periodic_images.h"

#include <algorithm>

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

std::vector<Vector3> wall_images(const PeriodicBox& box, const Box& wall, const coupling::RigidFrame& frame,
                                 double reach) {
  Box near_box{box.low, box.high};
  near_box.inflate(reach);
  const Box in_space = box_in_space(wall, frame);
  std::vector<Vector3> images = {Vector3::Zero()};
  for (const Vector3& period : periods(box)) {
    const size_t count = images.size();
    for (size_t k = 0; k < count; ++k)
      for (const double sign : {1.0, -1.0}) images.push_back(images[k] + sign * period);
  }
  const auto out_of_reach = [&](const Vector3& image) {
    return !image.isZero(0.0) && !near_box.overlaps({in_space.low + image, in_space.high + image});
  };
  images.erase(std::remove_if(images.begin(), images.end(), out_of_reach), images.end());
  return images;
}

}  // namespace contact
