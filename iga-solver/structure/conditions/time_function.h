// SPDX-License-Identifier: GPL-2.0-or-later
// How a load or the motion of a support changes in time: a factor [-] of its value.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace structure {

/// Of the time t; none stands for 1 at all times.  Calls do not allocate.
using TimeFunction = std::function<double(double t)>;

/// 0 until `from`, then in proportion to the time, 1 from `to` on.  Throws std::invalid_argument unless
/// from < to.
TimeFunction ramp(double from, double to);
/// sin(2 pi frequency t + phase), the phase in radians.
TimeFunction sine(double frequency, double phase = 0.0);
/// Straight lines between rows [t, value]; the first value before them, the last behind.  Throws
/// std::invalid_argument unless there is a row and times rise.
TimeFunction table(std::vector<std::array<double, 2>> rows);

inline double value_at(const TimeFunction& factor, double t) { return factor ? factor(t) : 1.0; }

}  // namespace structure
