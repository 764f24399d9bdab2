// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/primitives.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <stdexcept>

namespace nurbs {
namespace {

// Greville abscissae mapped to [0, 1]: control points placed there make the patch affine (linear precision).
std::vector<double> relative_greville(const KnotVector& knots) {
  std::vector<double> t = knots.greville();
  for (double& abscissa : t) abscissa = (abscissa - knots.front()) / (knots.back() - knots.front());
  return t;
}

}  // namespace

Volume box(const Vector3& origin, const Vector3& size, const std::array<KnotVector, 3>& knots) {
  if (!(size.minCoeff() > 0.0))
    throw std::invalid_argument(
        fmt::format("size is [{}, {}, {}], expected 3 numbers > 0", size.x(), size.y(), size.z()));
  Volume volume{Space<3>(knots), {}};
  volume.control_points.resize(3, volume.space.control_point_count());
  const std::vector<double> x = relative_greville(knots[0]), y = relative_greville(knots[1]),
                            z = relative_greville(knots[2]);
  int a = 0;
  for (double tz : z)
    for (double ty : y)
      for (double tx : x) volume.control_points.col(a++) = origin + size.cwiseProduct(Vector3(tx, ty, tz));
  return volume;
}

Surface plane(const Vector3& origin, const Vector3& edge_u, const Vector3& edge_v,
              const std::array<KnotVector, 2>& knots) {
  constexpr double kLeastSine =
      1e-9;  // of the angle between the edges; below it round-off decides the normal
  if (!(edge_u.cross(edge_v).norm() > kLeastSine * edge_u.norm() * edge_v.norm()))
    throw std::invalid_argument(
        fmt::format("edges [{}, {}, {}] and [{}, {}, {}] are zero or parallel, "
                    "expected two different directions",
                    edge_u.x(), edge_u.y(), edge_u.z(), edge_v.x(), edge_v.y(), edge_v.z()));
  Surface surface{Space<2>(knots), {}};
  surface.control_points.resize(3, surface.space.control_point_count());
  const std::vector<double> u = relative_greville(knots[0]), v = relative_greville(knots[1]);
  int a = 0;
  for (double tv : v)
    for (double tu : u) surface.control_points.col(a++) = origin + tu * edge_u + tv * edge_v;
  return surface;
}

}  // namespace nurbs
