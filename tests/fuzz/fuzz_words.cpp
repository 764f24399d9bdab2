// SPDX-License-Identifier: GPL-2.0-or-later
// The words behind `fix ID group wall/nurbs`, without LIGGGHTS.  A variable exists if its name is one letter
// long.
#include <sstream>
#include <stdexcept>

#include "fuzz_target.h"
#include "wall_nurbs_options.h"

namespace {

coupling::Value variable(const std::string& name) {
  if (name.size() != 1) throw std::invalid_argument("there is no variable " + name);
  return coupling::Value([] { return 1.0; });
}

}  // namespace

void fuzz_one(const std::string& input) {
  std::istringstream stream(input);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  const liggghts_pkg::WallNurbsOptions options = liggghts_pkg::parse_wall_nurbs(words, variable);
  check_that(options.atom_type >= 1 && !options.file.empty() && !options.surface.empty() &&
             options.slots >= 1);
}
