// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded, it makes LIGGGHTS' own timers (modify_timing) count this thread's CPU time: a machine that is busy with
// other things then changes little.
#include <time.h>

double MPI_Wtime(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
