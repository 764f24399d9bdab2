// SPDX-License-Identifier: GPL-2.0-or-later
// STL files, ASCII and binary.  What is read are meshes as their header says, and
// become walls.
#include <algorithm>
#include <array>
#include <set>

#include "brep/builder.h"
#include "brep/summary.h"
#include "fuzz_target.h"
#include "geometry_io/geometry_io.h"

namespace {

using geometry_io::TriangleMesh;

void check_mesh(const TriangleMesh& mesh) {
  check_that(mesh.count() > 0 && mesh.triangles.size() == 3 * mesh.place.size());
  check_that(mesh.points.allFinite());
  std::set<std::array<int, 3>> seen;
  std::set<int> used;
  for (int t = 0; t < mesh.count(); ++t) {
    std::array<int, 3> corners{};
    std::copy_n(&mesh.triangles[3 * t], 3, corners.begin());
    std::sort(corners.begin(), corners.end());
    check_that(corners[0] >= 0 && corners[0] < corners[1] && corners[1] < corners[2]);
    check_that(corners[2] < mesh.points.cols());
    check_that(seen.insert(corners).second);
    used.insert(corners.begin(), corners.end());
  }
  check_that(static_cast<int>(used.size()) == mesh.points.cols());
}

}  // namespace

void fuzz_one(const std::string& input) {
  const geometry_io::GeometryFile geometry =
      geometry_io::read_geometry("part.stl", [&](const std::string&) { return input; });
  for (const geometry_io::Shape& patch : geometry.patches) check_mesh(std::get<TriangleMesh>(patch));
  for (const auto& surface : geometry.surfaces) {
    const geometry_io::JoinedMesh all = geometry_io::named_triangles(geometry, surface.first, "part.stl");
    check_mesh(all.mesh);
    check_that(all.part.size() == all.mesh.place.size());
    geometry_io::gaps_of(all.mesh);
    geometry_io::overlaps_of(all.mesh);
    const brep::Summary wall = summary_of(brep::from_triangles(all.mesh.points, all.mesh.triangles));
    check_that(wall.area > 0.0);
  }
}
