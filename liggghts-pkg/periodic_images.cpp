// SPDX-License-Identifier: GPL-2.0-or-later
#include "periodic_images.h"

#include <mpi.h>

#include "domain.h"

namespace liggghts_pkg {

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

std::vector<Vector3> periods(const LAMMPS_NS::Domain& domain) {
  const int periodic[3] = {domain.xperiodic, domain.yperiodic, domain.zperiodic};
  std::vector<Vector3> result;
  for (int d = 0; d < 3; ++d)
    if (periodic[d]) result.push_back((domain.boxhi[d] - domain.boxlo[d]) * Vector3::Unit(d));
  return result;
}

std::vector<Vector3> wall_images(const LAMMPS_NS::Domain& domain, const Box& wall,
                                 const coupling::RigidFrame& frame, double reach) {
  Box near_domain{Vector3::Map(domain.boxlo), Vector3::Map(domain.boxhi)};
  near_domain.inflate(reach);
  const Box in_space = box_in_space(wall, frame);
  std::vector<Vector3> images = {Vector3::Zero()};
  for (const Vector3& period : periods(domain)) {
    const size_t count = images.size();
    for (size_t k = 0; k < count; ++k)
      for (const double sign : {1.0, -1.0}) images.push_back(images[k] + sign * period);
  }
  const auto out_of_reach = [&](const Vector3& image) {
    return !image.isZero(0.0) && !near_domain.overlaps({in_space.low + image, in_space.high + image});
  };
  images.erase(std::remove_if(images.begin(), images.end(), out_of_reach), images.end());
  return images;
}

}  // namespace liggghts_pkg
