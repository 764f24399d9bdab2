// SPDX-License-Identifier: GPL-2.0-or-later
#include "advised_size.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

using liggghts_pkg::rounded_down, liggghts_pkg::rounded_up;

namespace {

double shown(double size) { return std::strtod(fmt::format("{:.3g}", size).c_str(), nullptr); }

}  // namespace

TEST(AdvisedSize, ReadsLargerOrSmallerThanTheGivenOne) {
  for (const double size : {1e-3, 9.996e-4, 1.004e-3, 9.99e-4, 2.499e-7, 0.37, 5.0, 999.6})
    for (const double factor : {1.0 + 1e-9, 1.001, 1.04, 1.7}) {
      const double more = rounded_up(size * factor), less = rounded_down(size / factor);
      EXPECT_GT(shown(more), shown(size)) << size << " " << factor;
      EXPECT_LT(shown(less), shown(size)) << size << " " << factor;
      EXPECT_GE(more, size * factor);
      EXPECT_LE(less, size / factor);
      EXPECT_NEAR(more, size * factor, 0.0152 * more);
      EXPECT_NEAR(less, size / factor, 0.0152 * size);
    }
}
