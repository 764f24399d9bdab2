// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs/state: one further block of a wall's state in a restart file (state_blocks.h).  Walls define
// and delete such fixes; decks have no use for them.
#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/nurbs/state,FixWallNurbsState)
// clang-format on
#else

#ifndef LMP_FIX_WALL_NURBS_STATE_H
#define LMP_FIX_WALL_NURBS_STATE_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

class FixWallNurbsState : public Fix {
 public:
  FixWallNurbsState(class LAMMPS*, int, char**);
  int setmask() override { return 0; }
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

  std::vector<double> block;  ///< to be written next, or just read
};

}  // namespace LAMMPS_NS

#endif
#endif
