// SPDX-License-Identifier: GPL-2.0-or-later
// How far a run is, and how long it will still take: on a terminal a line that is written over, in a log a
// line now and then.
#pragma once

#include <chrono>
#include <string>

#include "solve_options.h"

namespace app {

/// "3 min 20 s", of seconds.
std::string duration_text(double seconds);

class Progress {
 public:
  /// Of a run of so many steps, from now on.  In a log a line comes every minute, or more often.
  Progress(long steps, Talk talk);
  /// After each step; `time` is that of the run.  Looks at the clock, and seldom prints.
  void tell(long step, double time);
  /// After each of `what`, where the number of steps is the least there are.
  void tell_at_least(const char* what, long step, long steps);
  /// Takes the line off the terminal.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_due(bool ends);
  std::string time_left(long step, long steps) const;
  void print(const std::string& line, bool ends);

  long steps_;
  bool on_terminal_;
  double interval_;        // [s]
  std::size_t width_ = 0;  // of the line that is written over
  Clock::time_point start_, last_;
};

}  // namespace app
