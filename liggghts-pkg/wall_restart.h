// SPDX-License-Identifier: GPL-2.0-or-later
// What a wall leaves in restart files and takes from them: the structure's state with what it belongs to
// (wall_state.h), the surface fields.  Contact memory restarts with its fix property/atom.
#ifndef LMP_WALL_RESTART_H
#define LMP_WALL_RESTART_H

#include <cstdio>
#include <string>
#include <vector>

#include "coupling/structure_solver.h"
#include "coupling/surface_exchange.h"
#include "lammps.h"
#include "state_blocks.h"
#include "wall_messages.h"
#include "wall_output.h"
#include "wall_state.h"

namespace liggghts_pkg {

class WallRestart {
 public:
  /// `file`: of the wall, for messages.
  WallRestart(LAMMPS_NS::LAMMPS* lmp, const std::string& id, const std::string& file,
              coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange)
      : lmp_(lmp),
        id_(id),
        file_(file),
        structure_(structure),
        exchange_(exchange),
        messages_(lmp, id),
        blocks_(*lmp->modify, id) {}

  /// Collective.  Throws std::exception on every rank if the file cannot be written.
  void write(std::FILE* file, const WallState::Origin& origin, const WallOutput* output);
  /// Makes room for it, which LIGGGHTS wants to know beforehand.
  void reserve(const WallState::Origin& origin, const WallOutput* output);
  void remove() { blocks_.remove(); }
  /// Of the bytes that LIGGGHTS read.  Throws std::exception if they belong to something else.
  void read(const char* buffer, const WallState::Origin& origin, WallOutput* output);

  /// LIGGGHTS hands a state to the fix of the same ID, and to nobody if there is none: notes which walls of
  /// this style are in the restart file, and warns before the first run if theirs was meant.
  void note_walls_in_file(const char* style);
  void warn_of_state_not_taken();

 private:
  std::vector<double> fields(const WallOutput* output) const;

  LAMMPS_NS::LAMMPS* lmp_;
  std::string id_, file_;
  coupling::StructureSolver& structure_;
  coupling::SurfaceExchange& exchange_;
  WallMessages messages_;
  StateBlocks blocks_;
  bool taken_ = false;
  std::vector<std::string> walls_in_file_;  // until the first run
};

}  // namespace liggghts_pkg

#endif
