// SPDX-License-Identifier: GPL-2.0-or-later
// Something that must not happen to a particle: counted over one run, reported once after it.
#pragma once

#include <mpi.h>

namespace contact {

struct RunAlarm {
  long count = 0;
  // Of the worst of these particles:
  double speed = 0.0;   ///< [length/time]; of a stiff contact its frequency [1/time]
  double radius = 0.0;  ///< [length]
  long tag = 0;

  void raise(long of_tag, double of_radius, double at_speed) {
    ++count;
    if (at_speed >= speed) speed = at_speed, radius = of_radius, tag = of_tag;
  }

  /// Over all ranks (collective).
  RunAlarm of_all_ranks(MPI_Comm world) const {
    struct {
      double speed;
      int rank;
    } mine{speed, 0}, fastest;
    MPI_Comm_rank(world, &mine.rank);
    MPI_Allreduce(&mine, &fastest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
    RunAlarm all = *this;
    MPI_Bcast(&all.speed, 1, MPI_DOUBLE, fastest.rank, world);
    MPI_Bcast(&all.radius, 1, MPI_DOUBLE, fastest.rank, world);
    MPI_Bcast(&all.tag, 1, MPI_LONG, fastest.rank, world);
    MPI_Allreduce(&count, &all.count, 1, MPI_LONG, MPI_SUM, world);
    return all;
  }
};

}  // namespace contact
