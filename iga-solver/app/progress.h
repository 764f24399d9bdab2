// SPDX-License-Identifier: GPL-2.0-or-later
// How far a run is, and how long it will still take: on a terminal a line that is written over, in a log a
// line now and then.
#pragma once

#include <chrono>
#include <string>

namespace app {

/// "3 min 20 s", of seconds.
std::string duration_text(double seconds);

class Progress {
 public:
  /// Of a run of so many steps, from now on.  In a log a line comes every `log_interval` seconds.
  Progress(long steps, double log_interval);
  /// After each step; `time` is that of the run.  Looks at the clock, and seldom prints.
  void tell(long step, double time);

 private:
  using Clock = std::chrono::steady_clock;

  long steps_;
  bool on_terminal_;
  double interval_;        // [s]
  std::size_t width_ = 0;  // of the line that is written over
  Clock::time_point start_, last_;
};

}  // namespace app
