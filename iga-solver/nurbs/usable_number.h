// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers that users may give.
#pragma once

#include <cmath>

namespace nurbs {

/// Larger numbers mean nothing, in any units, and the squares and products that are made of them overflow.
constexpr double kLargestNumber = 1e100;

/// So do smaller ones where one is divided by them.
constexpr double kSmallestNumber = 1.0 / kLargestNumber;

/// Finite, and at most kLargestNumber in size.
inline bool is_usable(double x) { return std::abs(x) <= kLargestNumber; }

}  // namespace nurbs
