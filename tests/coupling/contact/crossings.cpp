// SPDX-License-Identifier: GPL-2.0-or-later
#include "crossings.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "brep/edge_uses.h"

namespace test {
namespace {

Vector3 curvature_of(const brep::Surface& wall, const brep::Edge& edge, double part) {
  constexpr double kBeside = 1e-4;
  const brep::EdgePoint a = at_part(wall, edge, part - kBeside), b = at_part(wall, edge, part + kBeside);
  return (b.tangent - a.tangent) / (b.point - a.point).norm();
}

}  // namespace

std::vector<Crossing> crossings(const brep::Surface& wall, int number, double part) {
  const brep::Edge& edge = wall.edges[number];
  const brep::EdgePoint at = at_part(wall, edge, part);
  const brep::Across axes = edge.spline() ? brep::across(at.tangent) : brep::across(edge, at.point);
  const brep::Uses uses = edge.varies ? local_uses(wall, edge, at, axes) : uses_of(wall, edge);
  std::vector<Crossing> found;
  for (const brep::EdgeUse& use : uses) {
    const brep::EdgeUse& next = uses.next(use);
    if (wall.faces[use.face].outward == -use.side || wall.faces[next.face].outward == next.side)
      continue;  // inside of a body
    Crossing crossing{at.point,
                      axes.u,
                      axes.v,
                      std::atan2(use.conormal[1], use.conormal[0]),
                      std::atan2(next.conormal[1], next.conormal[0]),
                      {use.face, next.face},
                      use.wedge,
                      std::max(wall.slack_of_edge(number), 1e-9 * wall.size),
                      curvature_of(wall, edge, part)};
    if (crossing.to <= crossing.from + 1e-9) crossing.to += 2.0 * M_PI;
    found.push_back(crossing);
  }
  return found;
}

}  // namespace test
