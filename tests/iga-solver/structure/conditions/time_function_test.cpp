// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/time_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

TEST(TimeFunction, IsOneWithoutAny) { EXPECT_EQ(structure::value_at({}, 3.0), 1.0); }

TEST(TimeFunction, RampGoesFromZeroToOne) {
  const structure::TimeFunction ramp = structure::ramp(2.0, 4.0);
  EXPECT_EQ(ramp(-1.0), 0.0);
  EXPECT_EQ(ramp(2.0), 0.0);
  EXPECT_EQ(ramp(2.5), 0.25);
  EXPECT_EQ(ramp(4.0), 1.0);
  EXPECT_EQ(ramp(5.0), 1.0);
  EXPECT_THROW(structure::ramp(1.0, 1.0), std::invalid_argument);
}

TEST(TimeFunction, SineHasAFrequencyAndAPhase) {
  const structure::TimeFunction sine = structure::sine(50.0, 0.5);
  EXPECT_DOUBLE_EQ(sine(0.0), std::sin(0.5));
  EXPECT_NEAR(sine(0.005), std::cos(0.5), 1e-14) << "a quarter of a period later";
}

TEST(TimeFunction, TableIsStraightBetweenItsRows) {
  const structure::TimeFunction table = structure::table({{0.0, 1.0}, {1.0, 3.0}, {3.0, -1.0}});
  EXPECT_EQ(table(-1.0), 1.0);
  EXPECT_EQ(table(0.5), 2.0);
  EXPECT_EQ(table(1.0), 3.0);
  EXPECT_EQ(table(2.0), 1.0);
  EXPECT_EQ(table(9.0), -1.0);
  EXPECT_THROW(structure::table({}), std::invalid_argument);
  EXPECT_THROW(structure::table({{1.0, 0.0}, {0.5, 0.0}}), std::invalid_argument);
}

}  // namespace
