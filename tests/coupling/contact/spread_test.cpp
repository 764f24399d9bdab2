// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts whose force is spread over the net about the foot, as elements are small beside their disc.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "coupling/contact/spread_weight.h"
#include "rippled_sheet.h"

namespace {

using contact::SpreadLaw;
using contact::SpreadWeight;
using nurbs::Vector3;
using ripples::kK;
using ripples::kRadius;
using ripples::Scene;
using ripples::Sheet;

SpreadLaw law_with(double c, double above = 0.0) { return {kK, kRadius, c, -0.5 * c, 0.4 * c, 0.001, above}; }

// From its weight alone, by differences.
TEST(SpreadLaw, KnowsHowItsWeightAndItsOverlapChange) {
  const double c = 2e-4;
  for (const double s : {0.52, 0.6, 0.68, 0.75, 1.2}) {
    const double x = std::pow(s / (1.5 * kK * c), 2), step = 1e-4;
    const SpreadLaw law = law_with(c, 1e-3);
    const auto w = [&](double at) { return law.weight(at).w; };
    const SpreadWeight weight = law.weight(x);
    const double up = w(x * std::exp(step)), down = w(x * std::exp(-step));
    EXPECT_NEAR(weight.by_log, (up - down) / (2.0 * step), 1e-5) << s;
    EXPECT_NEAR(weight.by_log_twice, (up - 2.0 * weight.w + down) / (step * step), 1e-4) << s;
    const auto by = [&](double SpreadLaw::*number) {
      SpreadLaw more = law, less = law;
      more.*number *= 1.0 + step, less.*number *= 1.0 - step;
      return (more.weight(x).w - less.weight(x).w) / (2.0 * step);
    };
    EXPECT_NEAR(weight.by_c * c, by(&SpreadLaw::c), 1e-5) << s;
    EXPECT_NEAR(weight.by_moment * law.moment, by(&SpreadLaw::moment), 1e-5) << s;
    const double by_log =
        (law.at(x * std::exp(step)).overlap - law.at(x * std::exp(-step)).overlap) / (2.0 * step);
    EXPECT_NEAR((1.0 - law.at(x).s) * x, by_log, 1e-6 * x) << s;
  }
}

TEST(SpreadLaw, IsThatOfAPointForceUpToHalf) {
  const SpreadLaw law = law_with(2e-4, 1e-3);
  const double x = std::pow(0.49 / (1.5 * kK * law.c), 2);
  EXPECT_EQ(law.weight(x).w, 0.0);
  EXPECT_DOUBLE_EQ(law.at(x).overlap, x - law.c * kK * x * std::sqrt(x));
  EXPECT_NEAR(law.at(x).s, 0.49, 1e-12);
}

TEST(SpreadLaw, FindsTheOverlapItIsAskedFor) {
  for (const double s : {0.51, 0.6, 0.7, 0.9, 1.3}) {
    const SpreadLaw law = law_with(2e-4, 2e-4);
    const double x = std::pow(s / (1.5 * kK * law.c), 2);
    for (const double from : {0.0, 0.9 * x, x, 1.2 * x}) {
      const SpreadLaw::State state = law.solve(law.at(x).overlap, from, 0.9);
      EXPECT_NEAR(state.x, x, 1e-12 * x) << s;
      EXPECT_LT(state.s, 0.9);
      EXPECT_GT(state.weight.w, 0.0);
    }
  }
}

// At rest the displacement that is met by R + w Z is less by that of the mesh's own answer to it: the force
// is that of a point force whose mesh gives way by c, whatever is spread.
TEST(SpreadLaw, AtRestSpreadingChangesNoForce) {
  const double c = 2.2e-4;
  for (const double s : {0.55, 0.65, 0.8, 0.95}) {
    const double x = std::pow(s / (1.5 * kK * c), 2), F = kK * x * std::sqrt(x);
    SpreadLaw law = law_with(c);
    const double w = law.weight(x).w, body = 0.7 * F;  // what a body gives way, and the mesh by c more
    law.above = -F * (law.one + w * law.both);
    const double dent = body + F * (c + w * law.one), overlap = x + body - dent;
    EXPECT_NEAR(law.at(x).overlap, overlap, 1e-12 * x) << s;
    EXPECT_NEAR(law.at(x).mismatch, 0.0, 1e-18);
  }
}

/// Ripples of all that spreading needs, and of different phases.
class Swells final : public coupling::LocalCompliance {
 public:
  Swells(double c, double bend) : c_(c), height_(0.6 * bend) {
    const int side = static_cast<int>(ripples::kSide) + 2;  // control points of degree 2
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uneven(0.145, 0.155);
    for (int j = 1; j + 1 < side; ++j)
      for (int i = 1; i + 1 < side; ++i) {
        const int here = i + side * j;
        double sum = 0.0;
        for (const int to : {here - side, here - 1, here + 1, here + side}) {
          shares_.push_back({here, to, uneven(random)});
          sum += shares_.back().share;
        }
        shares_.push_back({here, here, -sum});
      }
  }
  void find(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>&, bool, Value& value) override {
    value = {wave(foot, c_, 0.1, 0.0), {}, 0.0};
  }
  std::vector<Share> shares() const override { return shares_; }
  void find_spread(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>&, Spread& spread) override {
    spread = {};
    spread.one = wave(foot, -0.5 * c_, 0.2, 1.0);
    spread.both = wave(foot, 0.4 * c_, 0.2, 2.0);
    spread.moment = wave(foot, 0.02, 0.3, 3.0);
    spread.height = wave(foot, 0.001, 0.9, 4.0);
    spread.height.c += height_;
  }

 private:
  static Component wave(const nurbs::SurfacePoint& foot, double mean, double ripple, double phase) {
    const double k = nurbs::kTwoPi * ripples::kSide, x = k * foot.xi[0] + phase,
                 y = k * foot.xi[1] - 0.7 * phase;
    return {mean * (1.0 + ripple * std::sin(x) * std::cos(y)),
            {mean * ripple * k * std::cos(x) * std::cos(y), -mean * ripple * k * std::sin(x) * std::sin(y)}};
  }
  double c_, height_;
  std::vector<Share> shares_;
};

// As a ball slides while it bounces, all that its force depends on changes below it.
TEST(SpreadForces, ASlidingContactIsConservative) {
  const std::map<Sheet, double> give = {
      {Sheet::plane, 3.2e-4}, {Sheet::rational, 3.2e-4}, {Sheet::hill, 4e-4}, {Sheet::hollow, 2.5e-4}};
  for (const auto& [kind, c] : give) {
    double largest = 0.0;
    for (const double at : {-1.0, -0.3, 0.4}) {
      const double bend = kind == Sheet::hill ? -0.125 : kind == Sheet::hollow ? 0.125 : 0.0;
      Swells compliance(c, bend);
      const double height = bend * (at * at + 0.25) + (bend > 0.0 ? 1.3 : 1.05) * kRadius;
      Scene scene(compliance, {at, -0.5, height}, {3, 1, -1}, 1e-5, kind);
      scene.begin();
      for (const bool before : {true, false})
        while (scene.loop->contacts().empty() == before && scene.step_number < 40000) {
          scene.step();
          for (const coupling::ContactForce& force : scene.loop->forces_on_body())
            largest = std::max(largest, std::abs(force.spread[2] / force.F[2]));
        }
      ASSERT_LT(scene.step_number, 40000);
      EXPECT_NEAR(scene.balls.velocity(0).squaredNorm(), 11.0, 1e-6) << at;
    }
    EXPECT_GT(largest, 0.1) << c;  // of w
  }
}

}  // namespace
