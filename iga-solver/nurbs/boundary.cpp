// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/boundary.h"

#include <stdexcept>

namespace nurbs {
namespace {

constexpr const char* kFaceNames[] = {"xi-", "xi+", "eta-", "eta+", "zeta-", "zeta+"};

}  // namespace

const char* face_name(Face face) { return kFaceNames[static_cast<int>(face)]; }

Face face_from_name(const std::string& name) {
  for (int face = 0; face < 6; ++face)
    if (name == kFaceNames[face]) return static_cast<Face>(face);
  throw std::invalid_argument("unknown face '" + name + "', expected xi-, xi+, eta-, eta+, zeta- or zeta+");
}

BoundarySurface boundary_surface(const Space<3>& volume, Face face) {
  const int normal = static_cast<int>(face) / 2;  // direction that is constant on the face
  const bool plus = static_cast<int>(face) % 2 == 1;
  const int u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;

  std::array<int, 3> index{};
  index[normal] = plus ? volume.control_point_count(normal) - 1 : 0;
  std::vector<int> volume_control_point;
  std::vector<double> weights;
  for (index[v] = 0; index[v] < volume.control_point_count(v); ++index[v])
    for (index[u] = 0; index[u] < volume.control_point_count(u); ++index[u]) {
      const int a =
          index[0] + volume.control_point_count(0) * (index[1] + volume.control_point_count(1) * index[2]);
      volume_control_point.push_back(a);
      if (volume.rational()) weights.push_back(volume.weight(a));
    }

  const int cross =
      normal == 1 ? -1 : 1;  // u x v in rising order points along the rising normal, except xi x zeta
  return {Space<2>({volume.knots(u), volume.knots(v)}, std::move(weights)), std::move(volume_control_point),
          plus ? cross : -cross};
}

}  // namespace nurbs
