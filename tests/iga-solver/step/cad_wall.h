// SPDX-License-Identifier: GPL-2.0-or-later
// The wall of a CAD file, by the project's own reader.
#pragma once

#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "brep/builder.h"
#include "geometry_io/step_reader.h"

namespace step_parts {

inline brep::CadModel model_of(const std::string& file) {
  std::stringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return geometry_io::read_step(bytes.str());
}

inline brep::Surface wall_of(const brep::CadModel& model) {
  std::vector<int> all(model.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return brep::from_cad(model, all);
}

}  // namespace step_parts
