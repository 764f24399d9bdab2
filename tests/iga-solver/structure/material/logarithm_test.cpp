// SPDX-License-Identifier: GPL-2.0-or-later
// ln J beside long double, for numbers and for the words of every instruction set.
#include "structure/material/logarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "logarithm_words.h"
#include "nurbs/simd_level.h"

namespace {

using nurbs::SimdLevel;

void of_numbers(int words, const double* J, const double* J_minus_1, double* value, double* excess,
                double* inverse) {
  for (int i = 0; i < 8 * words; ++i) {
    const structure::Logarithm<double> ln = structure::logarithm(J[i], J_minus_1[i]);
    value[i] = ln.value, excess[i] = ln.excess, inverse[i] = ln.inverse;
  }
}

std::vector<test::Logarithms> all_ways() {
  std::vector<test::Logarithms> ways{of_numbers, test::portable::logarithms};
#ifdef NURBS_X86_64
  if (nurbs::available(SimdLevel::avx2)) ways.push_back(test::avx2::logarithms);
  if (nurbs::available(SimdLevel::avx512)) ways.push_back(test::avx512::logarithms);
#endif
  return ways;
}

struct Logs {
  std::vector<double> value, excess, inverse;
};
Logs run(test::Logarithms way, const std::vector<double>& J, const std::vector<double>& J_minus_1) {
  Logs r{J, J, J};
  way(static_cast<int>(J.size() / 8), J.data(), J_minus_1.data(), r.value.data(), r.excess.data(),
      r.inverse.data());
  return r;
}

TEST(Logarithm, IsRightForVolumeRatiosFromAMillionthToAMillion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  std::vector<double> J, x;
  for (int i = 0; i < 80000; ++i) {
    J.push_back(i < 8 ? std::pow(10.0, i % 2 ? 6.0 : -6.0) : std::pow(10.0, exponent(random)));
    x.push_back(J.back() - 1.0);
  }
  for (const test::Logarithms way : all_ways()) {
    const Logs r = run(way, J, x);
    for (std::size_t i = 0; i < J.size(); ++i) {
      const long double ln = std::log(static_cast<long double>(J[i]));
      ASSERT_NEAR(r.value[i], ln, 1e-15 * std::max(1.0L, std::abs(ln))) << J[i];
      ASSERT_NEAR(r.excess[i], J[i] - 1.0L - ln, 1e-15 * std::max<long double>(J[i], 1.0L + std::abs(ln)))
          << J[i];
      ASSERT_NEAR(r.inverse[i] * J[i], 1.0, 1e-15) << J[i];
    }
  }
}

// J - 1 from 1 down to 1e-300, of both signs: all digits, of the excess x^2/2 - x^3/3 ..., too.
TEST(Logarithm, LosesNoDigitsWhereVolumesHardlyChange) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-16.0, -0.33);
  std::vector<double> J, x;
  for (int i = 0; i < 80000; ++i) {
    const double size = i < 8 ? std::pow(10.0, -15.0 * i) : std::pow(10.0, exponent(random));
    x.push_back(i % 2 ? -std::min(size, 0.5) : size);
    J.push_back(1.0 + x.back());
  }
  for (const test::Logarithms way : all_ways()) {
    const Logs r = run(way, J, x);
    for (std::size_t i = 0; i < J.size(); ++i) {
      const long double X = x[i], ln = std::log1p(X);
      ASSERT_NEAR(r.value[i], ln, 2e-15 * std::abs(ln)) << x[i];
      const long double series = X * X * (0.5L - X * (1.0L / 3.0L - X * (0.25L - X * 0.2L)));
      const long double excess = std::abs(X) < 1e-4L ? series : X - ln;
      ASSERT_NEAR(r.excess[i], excess, 3e-15 * std::abs(excess)) << x[i];
    }
  }
}

TEST(Logarithm, IsNoNumberWhereThereIsNoVolumeLeft) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> J{0.0, -0.0, -1e-9, -1.0, -1e6, -infinity, nan, 2.0};
  std::vector<double> x;
  for (const double value : J) x.push_back(value - 1.0);
  for (const test::Logarithms way : all_ways()) {
    const Logs r = run(way, J, x);
    for (int i = 0; i < 7; ++i)
      EXPECT_TRUE(std::isnan(r.value[i]) && std::isnan(r.excess[i]) && std::isnan(r.inverse[i])) << J[i];
    EXPECT_EQ(r.inverse[7], 0.5) << "its neighbours are left alone";
  }
}

}  // namespace
