// SPDX-License-Identifier: GPL-2.0-or-later
// Opens the plug-in of oscillator.c, whose path is the argument, and kicks it.  Exit code 0 if it swings as
// it must.
#include <cmath>
#include <cstdio>

#include "coupling/open_structure.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  bool good = false;
  {
    const auto opened = coupling::open_plugin_structure(MPI_COMM_WORLD, argv[1], "", "top");
    coupling::StructureSolver& plate = *opened.solver;
    constexpr double kStep = 1e-5, kForce = 1.0;
    coupling::NodalVectors f = coupling::NodalVectors::Zero(3, 5);
    f(2, 0) = kForce;
    plate.set_time_step(kStep);
    plate.initialise_forces(coupling::NodalForces(f));
    for (int step = 0; step < 100; ++step) {
      plate.begin_step();
      plate.end_step(coupling::NodalForces(f));
    }
    // f/k (1 - cos(omega t)), omega = 1000, t = 1e-3
    const double expected = kForce / 1e3 * (1.0 - std::cos(1.0)), found = plate.positions()(2, 0);
    const double work = plate.work().contacts;
    std::printf("z %.9g, expected %.9g, work %.9g\n", found, expected, work);
    good = std::abs(found / expected - 1.0) < 1e-4 && std::abs(work / (kForce * expected) - 1.0) < 1e-4;
  }
  MPI_Finalize();
  return good ? 0 : 1;
}
