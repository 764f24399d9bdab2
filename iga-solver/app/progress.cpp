// SPDX-License-Identifier: GPL-2.0-or-later
#include "progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace app {

std::string duration_text(double seconds) {
  constexpr long kMinute = 60, kHour = 60 * kMinute, kDay = 24 * kHour;
  if (seconds < 1.0) return "less than 1 s";
  if (!(seconds < 1000.0 * kDay)) return "more than 1000 days";
  const long s = std::lround(seconds);
  if (s < kMinute) return fmt::format("{} s", s);
  if (s < kHour) return fmt::format("{} min {} s", s / kMinute, s % kMinute);
  if (s < kDay) return fmt::format("{} h {} min", s / kHour, s % kHour / kMinute);
  return fmt::format("{} d {} h", s / kDay, s % kDay / kHour);
}

namespace {

/// What mpiexec puts in front of a program looks like a terminal, too, but is of no size.
bool is_terminal() {
  winsize size{};
  return isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
}

}  // namespace

Progress::Progress(long steps, double log_interval)
    : steps_(steps),
      on_terminal_(is_terminal()),
      interval_(on_terminal_ ? 0.2 : log_interval),
      start_(Clock::now()),
      last_(start_) {}

void Progress::tell(long step, double time) {
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const Clock::time_point now = Clock::now();
  const bool ends = step == steps_;
  if (seconds(now - last_) < interval_ && !(ends && on_terminal_)) return;
  last_ = now;
  const double spent = seconds(now - start_), left = spent / static_cast<double>(step) * (steps_ - step);
  const std::string line = fmt::format("  step {} of {}, time {:.6g}, {} {}", step, steps_, time,
                                       duration_text(ends ? spent : left), ends ? "in all" : "left");
  if (on_terminal_)
    fmt::print("\r{:<{}}{}", line, width_, ends ? "\n" : "");
  else
    fmt::print("{}\n", line);
  width_ = std::max(width_, line.size());
  std::fflush(stdout);
}

}  // namespace app
