// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded, it makes LIGGGHTS' own timers (modify_timing) count this thread's CPU time: what else the
// machine does then changes little.
#include <ctime>

extern "C" double MPI_Wtime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
