// SPDX-License-Identifier: GPL-2.0-or-later
// nurbs-convert: prints what a geometry file holds, and writes it in another format.
#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <vector>

#include "command.h"
#include "geometry_io/geometry_io.h"
#include "geometry_io/geometry_summary.h"

namespace {

using geometry_io::GeometryFile;

struct Options {
  std::string in, out, surface;
  std::optional<std::string> units;
  double tolerance = 0.0;
};

// The patches of one named surface, as a geometry of its own; faces of volumes become surfaces.
GeometryFile only(const GeometryFile& geometry, const std::string& surface, const std::string& file) {
  GeometryFile kept{geometry.units, {}, {}};
  for (const geometry_io::SurfacePiece& piece : pieces_of(geometry, surface, file)) {
    kept.surfaces[surface].push_back({static_cast<int>(kept.patches.size()), std::nullopt});
    const geometry_io::Shape& patch = geometry.patches[piece.patch];
    kept.patches.push_back(is_triangles(patch) ? patch : extract(piece, geometry.patches).surface);
  }
  return kept;
}

std::string patches_text(const GeometryFile& geometry) {
  const size_t count = geometry.patches.size();
  return geometry.cad ? "" : fmt::format(", {} patch{}", count, count == 1 ? "" : "es");
}

void run(const Options& options) {
  std::vector<std::string> inputs;
  const auto read_and_note = [&](const std::string& path) {
    inputs.push_back(path);
    return options.tolerance > 0.0 ? geometry_io::read_fitted(path, options.tolerance)
                                   : geometry_io::read_file(path);
  };
  const geometry_io::Units units = geometry_io::units_from_name(options.units.value_or("si"));
  GeometryFile geometry = geometry_io::read_geometry(options.in, read_and_note, units);
  if (options.units && geometry.units != units)
    fmt::print(stderr, "warning: {} says that its units are {}; --units {} is for files that say nothing\n",
               options.in, geometry_io::units_name(geometry.units), *options.units);
  if (!options.surface.empty()) geometry = only(geometry, options.surface, options.in);
  fmt::print("{}: units {}{}\n{}", options.in, geometry_io::units_name(geometry.units),
             patches_text(geometry), geometry_io::summary(geometry));
  if (!options.out.empty())
    fmt::print("written to {} ({})\n", options.out,
               geometry_io::write_geometry_file(geometry, options.out, inputs));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App command("Prints what a geometry file holds, and writes it in another format.");
  command
      .add_option(
          "input", options.in,
          "geometry file: .step, .stp, .iges, .igs (CAD), .h5, .hdf5 (HDF5), .xml (G+Smo), .stl, else YAML")
      ->required();
  command.add_option("output", options.out, "file to write: .yaml, .yml, .h5, .hdf5 or .xml");
  command.add_option("--surface", options.surface, "keep the patches of this named surface only");
  command.add_option("--units", options.units,
                     "units of a file that has none (G+Smo, STL), and those to which CAD is brought: si "
                     "(default), cgs, mm-g-ms or mm-t-s");
  command
      .add_option("--tolerance", options.tolerance,
                  "of STEP and IGES: fit surfaces of offset within so many mm, which are refused without")
      ->check(app::positive_number);
  return app::run_command(command, argc, argv, options.in, [&] { run(options); });
}
