// SPDX-License-Identifier: GPL-2.0-or-later
// nurbs-read-step [TOLERANCE]: a STEP or IGES file as version 2 of our schema, lengths in mm; surfaces of
// offset are fitted within TOLERANCE [mm].  Others start it to be safe from what OpenCASCADE does with a
// damaged file (reader_process.h); nobody else needs it.
#include <cstdlib>

#include "geometry_io/cad_hdf5.h"
#include "geometry_io/reader_main.h"
#include "geometry_io/step_reader.h"

int main(int argc, char** argv) {
  geometry_io::StepOptions options;
  if (argc > 1) options.offset_tolerance = std::strtod(argv[1], nullptr);
  return geometry_io::answer_with(15, 50000, [&](const std::string& bytes) {
    geometry_io::Hdf5Builder file;
    add_cad_file(geometry_io::read_step(bytes, options), "mm-g-ms", file);
    return encoded(file.contents());
  });
}
