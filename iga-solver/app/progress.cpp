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

constexpr double kTerminalInterval = 0.2, kUsualInterval = 60.0, kShortInterval = 5.0;  // [s] between lines

}  // namespace

Progress::Progress(long steps, Talk talk)
    : steps_(steps),
      on_terminal_(is_terminal()),
      interval_(on_terminal_         ? kTerminalInterval
                : talk == Talk::more ? kShortInterval
                                     : kUsualInterval),
      start_(Clock::now()),
      last_(start_) {}

bool Progress::is_due(bool ends) {
  const Clock::time_point now = Clock::now();
  const bool due = std::chrono::duration<double>(now - last_).count() >= interval_ || (ends && on_terminal_);
  if (due) last_ = now;
  return due;
}

std::string Progress::time_left(long step, long steps) const {
  const double spent = std::chrono::duration<double>(last_ - start_).count();
  return duration_text(spent / static_cast<double>(step) * static_cast<double>(steps - step)) + " left";
}

void Progress::print(const std::string& line, bool ends) {
  if (on_terminal_)
    fmt::print("\r{:<{}}{}", line, width_, ends ? "\n" : "");
  else
    fmt::print("{}\n", line);
  width_ = std::max(width_, line.size());
  std::fflush(stdout);
}

void Progress::tell(long step, double time) {
  const bool ends = step == steps_;
  if (!is_due(ends)) return;
  const std::string in_all = duration_text(std::chrono::duration<double>(last_ - start_).count()) + " in all";
  print(fmt::format("  step {} of {}, time {:.6g}, {}", step, steps_, time,
                    ends ? in_all : time_left(step, steps_)),
        ends);
}

void Progress::tell_at_least(const char* what, long step, long steps) {
  if (!is_due(false)) return;
  print(step < steps
            ? fmt::format("  {} {} of {} or more, {} or more", what, step, steps, time_left(step, steps))
            : fmt::format("  {} {}, more until all is exact", what, step),
        false);
}

void Progress::end() {
  if (on_terminal_ && width_ > 0) fmt::print("\r{:<{}}\r", "", width_);
}

}  // namespace app
