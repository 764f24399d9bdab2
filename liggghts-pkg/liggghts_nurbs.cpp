// SPDX-License-Identifier: GPL-2.0-or-later
// liggghts-nurbs: the stock LIGGGHTS executable plus fix wall/nurbs and the penalty laws.  It does what
// LIGGGHTS' own main does; the additions come from being linked first against libliggghts_wall_nurbs
// (register_styles.h).
#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

namespace {

/// Ctrl-C and SIGTERM (which is what mpirun makes of it) end a run in an orderly way, SIGUSR1 writes a
/// restart file.
void install_signal_handlers() {
  struct sigaction quit = {}, write_restart = {};
  quit.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  write_restart.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGINT, &quit, nullptr);
  sigaction(SIGTERM, &quit, nullptr);
  sigaction(SIGUSR1, &write_restart, nullptr);
}

void run(int argc, char** argv) {
  LAMMPS_NS::LAMMPS liggghts(argc, argv, MPI_COMM_WORLD);
  liggghts.input->file();
}

}  // namespace

int main(int argc, char** argv) {
  install_signal_handlers();
  MPI_Init(&argc, &argv);
  try {
    run(argc, argv);
  } catch (const std::exception&
               problem) {  // LIGGGHTS throws nothing; a rank that stops alone must stop the others
    std::fprintf(stderr, "ERROR: %s\n", problem.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}
