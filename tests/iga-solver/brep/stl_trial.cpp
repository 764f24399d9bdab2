// SPDX-License-Identifier: GPL-2.0-or-later
#include "stl_trial.h"

#include "geometry_io/geometry_io.h"
#include "stl_files.h"

namespace brep::trials {

std::unique_ptr<Trial> stl_trial(unsigned seed, int index) {
  std::mt19937 random = seeded(seed, index);
  Wall meant = random_wall(random, index % kFamilies);
  cut_finely(meant, random);
  const std::string file = stl_file(meant, random);
  const geometry_io::TriangleMesh mesh =
      geometry_io::named_triangles(
          geometry_io::read_geometry("trial.stl", [&](const std::string&) { return file; }), "all",
          "trial.stl")
          .mesh;
  return std::make_unique<TriangleTrial>(meant, from_triangles(mesh.points, mesh.triangles), true, random);
}

}  // namespace brep::trials
