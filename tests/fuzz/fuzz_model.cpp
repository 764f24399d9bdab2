// SPDX-License-Identifier: GPL-2.0-or-later
// Model files of solids; small ones are also made a solver of.
#include "fuzz_target.h"
#include "io/model_file.h"

void fuzz_one(const std::string& input) {
  io::ModelFile model = io::parse_model_file(input, "plate.yaml", [](const std::string& path) -> std::string {
    throw geometry_io::InputError(path + ": there is one file only");
  });
  for (const auto& surface : model.geometry.surfaces)
    geometry_io::named_surface(model.geometry, surface.first, "plate.yaml");
  constexpr int kSmall = 200;  // control points
  if (model.nodes.node_count() <= kSmall) io::build_solver(model);
}
