// SPDX-License-Identifier: GPL-2.0-or-later
// Something that must not happen to a particle: counted over one run, reported once after it.
#pragma once

#include <mpi.h>

#include "nurbs/types.h"

namespace contact {

/// The first of those ranks where it is (collective).
inline int rank_of_largest(double value, MPI_Comm world) {
  struct {
    double value;
    int rank;
  } mine{value, 0}, largest;
  MPI_Comm_rank(world, &mine.rank);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  return largest.rank;
}

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
    const int fastest = rank_of_largest(speed, world);
    RunAlarm all = *this;
    MPI_Bcast(&all.speed, 1, MPI_DOUBLE, fastest, world);
    MPI_Bcast(&all.radius, 1, MPI_DOUBLE, fastest, world);
    MPI_Bcast(&all.tag, 1, MPI_LONG, fastest, world);
    MPI_Allreduce(&count, &all.count, 1, MPI_LONG, MPI_SUM, world);
    return all;
  }
};

/// The same of a contact and the elements below it.
struct MeshAlarm {
  long count = 0;
  // Of the worst contact:
  double value = 0.0;  ///< [-]
  double size = 0.0;   ///< of the element [length]
  double share = 0.0;  ///< of its force that is corrected [-]
  nurbs::Vector3 foot = nurbs::Vector3::Zero();
  long tag = 0;

  void raise(long of_tag, const nurbs::Vector3& at, double of_size, double of_value, double of_share = 0.0) {
    ++count;
    if (of_value > value) value = of_value, size = of_size, share = of_share, foot = at, tag = of_tag;
  }

  /// Over all ranks (collective).
  MeshAlarm of_all_ranks(MPI_Comm world) const {
    const int worst = rank_of_largest(value, world);
    MeshAlarm all = *this;
    double numbers[] = {value, size, share, foot[0], foot[1], foot[2]};
    MPI_Bcast(numbers, 6, MPI_DOUBLE, worst, world);
    all.value = numbers[0], all.size = numbers[1], all.share = numbers[2];
    all.foot = {numbers[3], numbers[4], numbers[5]};
    MPI_Bcast(&all.tag, 1, MPI_LONG, worst, world);
    MPI_Allreduce(&count, &all.count, 1, MPI_LONG, MPI_SUM, world);
    return all;
  }
};

}  // namespace contact
