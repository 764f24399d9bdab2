// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_messages.h"

#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <cstdlib>

#include "comm.h"
#include "error.h"
#include "lammps.h"

namespace liggghts_pkg {

std::string wall_message(const std::string& id, const std::string& what) {
  return fmt::format("Fix wall/nurbs (id {}): {}", id, what);
}

void WallMessages::fail(const std::string& message) const {
  lmp_->error->all(FLERR, wall_message(id_, message).c_str());
  std::abort();  // error->all does not return, but is not declared so
}

// error->one aborts before what it printed has left its buffer.
void WallMessages::fail_on_this_rank(const std::string& message) const {
  for (std::FILE* file : {lmp_->screen ? lmp_->screen : stderr, lmp_->logfile}) {
    if (!file) continue;
    std::fprintf(file, "ERROR on proc %d: %s\n", lmp_->comm->me, wall_message(id_, message).c_str());
    std::fflush(file);
  }
  MPI_Abort(lmp_->world, 1);
  std::abort();  // MPI_Abort does not return, but is not declared so
}

void WallMessages::warn(const std::string& message) const {
  if (lmp_->comm->me == 0) lmp_->error->warning(FLERR, wall_message(id_, message).c_str());
}

// The screen or the log file may be switched off.
void WallMessages::print(const std::string& message) const {
  for (std::FILE* file : {lmp_->screen, lmp_->logfile})
    if (lmp_->comm->me == 0 && file) std::fprintf(file, "%s\n", wall_message(id_, message).c_str());
}

}  // namespace liggghts_pkg
