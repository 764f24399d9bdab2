// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_nurbs_state.h"

#include <exception>

#include "coupling/fingerprint.h"
#include "error.h"
#include "wall_messages.h"
#include "wall_state.h"

using namespace LAMMPS_NS;

FixWallNurbsState::FixWallNurbsState(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg != 3) error->all(FLERR, "Fix wall/nurbs/state belongs to fix wall/nurbs, which defines it itself");
  restart_global = 1;
}

void FixWallNurbsState::write_restart(FILE* file) {
  std::vector<double> numbers = {static_cast<double>(block.size())};
  numbers.insert(numbers.end(), block.begin(), block.end());
  block = {};
  try {
    liggghts_pkg::write_block(world, file, numbers);
  } catch (const std::exception& problem) {
    liggghts_pkg::WallMessages(lmp, id).fail(problem.what());
  }
}

void FixWallNurbsState::restart(char* buffer) {
  const auto* const numbers = reinterpret_cast<const double*>(buffer);
  const std::size_t size = coupling::saved_size(numbers[0], liggghts_pkg::kMostInOneBlock);
  block.assign(numbers + 1, numbers + 1 + size);
}
