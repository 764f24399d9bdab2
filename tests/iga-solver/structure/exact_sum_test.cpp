// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using structure::ExactSum;

double sum(const std::vector<double>& terms) {
  ExactSum all;
  for (const double term : terms) all.add(term);
  return all.value();
}

TEST(ExactSum, OneTermComesBack) {
  constexpr double kMin = std::numeric_limits<double>::min();
  for (const double x :
       {0.0, 1.0, -1.0, 0.1, -1e300, 1e-300, kMin, kMin / 8, -5e-324, 1.7976931348623157e308})
    EXPECT_EQ(sum({x}), x);
}

TEST(ExactSum, LosesNothing) {
  EXPECT_EQ(sum({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(sum({1e308, 1e308, -1e308, -1e308, 5e-324}), 5e-324);
  EXPECT_EQ(sum({1.0, 1e-17, 1e-17, -1.0}), 2e-17);
  EXPECT_EQ(sum({-3.0, 1e-40}), -3.0);
}

// 2^53 + 1 lies half way between two doubles: to even, unless there is a little more.
TEST(ExactSum, RoundsOnceToTheNearest) {
  const double big = std::ldexp(1.0, 53);
  EXPECT_EQ(sum({big, 1.0}), big);
  EXPECT_EQ(sum({big, 1.0, 1e-200}), big + 2.0);
  EXPECT_EQ(sum({-big, -1.0, -1e-200}), -big - 2.0);
  EXPECT_EQ(sum({big + 2.0, 1.0}), big + 4.0);
}

TEST(ExactSum, OfIntegersIsTheirSum) {
  std::mt19937_64 generator(3);
  std::vector<double> terms;
  std::int64_t expected = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::int64_t term = static_cast<std::int64_t>(generator() >> 24) - (std::int64_t(1) << 39);
    expected += term;
    terms.push_back(static_cast<double>(term));
  }
  EXPECT_EQ(sum(terms), static_cast<double>(expected));
}

TEST(ExactSum, DependsNeitherOnTheOrderNorOnWhoAdds) {
  std::mt19937 generator(1);
  std::vector<double> terms;
  for (int i = 0; i < 1000; ++i)
    terms.push_back((i % 2 ? 1 : -1) * std::ldexp(generator(), static_cast<int>(generator() % 600) - 300));
  const double all = sum(terms);
  std::shuffle(terms.begin(), terms.end(), generator);
  EXPECT_EQ(sum(terms), all);
  ExactSum parts[3];
  for (std::size_t i = 0; i < terms.size(); ++i) parts[i % 3].add(terms[i]);
  for (int p = 1; p < 3; ++p)
    for (int k = 0; k < ExactSum::kWords; ++k) parts[0].words()[k] += parts[p].words()[k];
  EXPECT_EQ(parts[0].value(), all);
}

TEST(ExactSum, IsNotFiniteIfATermIsNot) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sum({1.0, inf}), inf);
  EXPECT_EQ(sum({1.0, -inf}), -inf);
  EXPECT_TRUE(std::isnan(sum({inf, -inf})));
  EXPECT_TRUE(std::isnan(sum({1.0, std::nan("")})));
}

TEST(ExactSum, ThatOverflowsIsInfinite) {
  EXPECT_EQ(sum({1.7e308, 1.7e308}), std::numeric_limits<double>::infinity());
}

}  // namespace
