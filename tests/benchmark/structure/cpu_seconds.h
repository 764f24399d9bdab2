// SPDX-License-Identifier: GPL-2.0-or-later
// What a piece of work takes of this thread's time: what else the machine does changes little.
#pragma once

#include <ctime>

namespace benchmarks {

inline double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double cpu_seconds(Work work) {
  const double start = thread_seconds();
  work();
  return thread_seconds() - start;
}

}  // namespace benchmarks
