// SPDX-License-Identifier: GPL-2.0-or-later
// Feet of blocks beside the formulas point by point, with each instruction set that this machine has.
#include "coupling/contact/feet_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "brep/chart.h"

namespace {

using contact::FeetBlock;
using contact::KeptFeet;
using Eigen::Vector3d;
using nurbs::SimdLevel;

std::vector<SimdLevel> levels_here() {
  std::vector<SimdLevel> found;
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512})
    if (nurbs::available(level)) found.push_back(level);
  return found;
}

struct Random {
  std::mt19937 engine{7};
  double operator()(double low = -1.0, double high = 1.0) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vector3d vector() { return {(*this)(), (*this)(), (*this)()}; }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d(vector().homogeneous())).normalized().matrix();
  }
};

void set(FeetBlock::Lanes (&lanes)[3], int k, const Vector3d& v) {
  for (int d = 0; d < 3; ++d) lanes[d][k] = v[d];
}
Vector3d get(const FeetBlock::Lanes (&lanes)[3], int k) { return {lanes[0][k], lanes[1][k], lanes[2][k]}; }
void copy(const Vector3d& from, double (&to)[3]) { Vector3d::Map(to) = from; }

// Not a whole number of words.
FeetBlock random_block(Random& random, int count) {
  FeetBlock block;
  block.count = count;
  for (int k = 0; k < count; ++k) {
    set(block.centre, k, random.vector());
    block.touch_reach[k] = random(0.5, 1.0);
    block.squared_speed[k] = random(0.0, 3.0);
  }
  return block;
}

// Some have grown more than their margin, some have none.
KeptFeet kept_feet(Random& random, const FeetBlock& block) {
  KeptFeet kept;
  for (int k = 0; k < block.count; ++k) {
    set(kept.centre, k, get(block.centre, k) + 0.01 * random.vector());
    kept.reach[k] = block.touch_reach[k] + random(-0.01, 0.1);
    kept.margin[k] = random(-0.01, 0.05);
    kept.sign[k] = random() > 0.0 ? 1.0 : -1.0;
  }
  return kept;
}

bool may_move(const FeetBlock& block, const KeptFeet& kept, int k) {
  return (get(block.centre, k) - get(kept.centre, k)).norm() <
         std::min(kept.margin[k], kept.reach[k] - block.touch_reach[k]);
}

constexpr double kRoundOff = 1e-15;

TEST(FeetKernel, CentresComeIntoTheFrameAndDirectionsBack) {
  Random random;
  for (const SimdLevel level : levels_here())
    for (const int count : {1, 13, FeetBlock::kCapacity}) {
      const contact::FeetKernel kernel = contact::feet_kernel(level);
      FeetBlock block = random_block(random, count);
      const FeetBlock given = block;
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = random.rotation();
      const Vector3d origin = random.vector();
      kernel.into_frame(block, origin.data(), R.data());
      for (int k = 0; k < count; ++k) {
        EXPECT_LT((get(block.centre, k) - R.transpose() * (get(given.centre, k) - origin)).norm(),
                  4 * kRoundOff);
        set(block.delta, k, get(block.centre, k));
      }
      kernel.into_space(block, R.data());
      for (int k = 0; k < count; ++k)
        EXPECT_LT((get(block.delta, k) - (get(given.centre, k) - origin)).norm(), 8 * kRoundOff);
      block = given;
      kernel.into_frame(block, origin.data(), nullptr);
      for (int k = 0; k < count; ++k) EXPECT_EQ(get(block.centre, k), get(given.centre, k) - origin);
    }
}

// The last of them, which does not fill a word, and one that is as large as it may be.
TEST(FeetKernel, TellsWhetherAnyIsAboveItsLimit) {
  Random random;
  for (const SimdLevel level : levels_here())
    for (const int count : {1, 8, 13, 61}) {
      const contact::FeetKernel kernel = contact::feet_kernel(level);
      std::vector<double> values(count), limits(count);
      for (int i = 0; i < count; ++i) values[i] = random(), limits[i] = values[i] + random(0.0, 1.0);
      limits[count / 2] = values[count / 2];
      EXPECT_FALSE(kernel.any_above(values.data(), limits.data(), 0));
      EXPECT_FALSE(kernel.any_above(values.data(), limits.data(), count));
      for (int i = 0; i < count; ++i) {
        const double limit = limits[i];
        limits[i] = std::nextafter(values[i], -2.0);
        EXPECT_TRUE(kernel.any_above(values.data(), limits.data(), count)) << i << " of " << count;
        EXPECT_EQ(kernel.any_above(values.data(), limits.data(), i), false);
        limits[i] = limit;
      }
    }
}

// room > 0 where the foot touches, is on its side, and the centre has moved by less than it may.  Those that
// reach nothing have no room.
TEST(FeetKernel, FeetOverPlanes) {
  Random random;
  for (const SimdLevel level : levels_here()) {
    const contact::FeetKernel kernel = contact::feet_kernel(level);
    int there = 0;
    for (int blocks = 0; blocks < 2; ++blocks) {
      FeetBlock block = random_block(random, 29);
      KeptFeet kept = kept_feet(random, block);
      block.touch_reach[17] = -1.0;
      std::vector<contact::PlaneNumbers> planes(block.count);
      for (int k = 0; k < block.count; ++k) {
        const Eigen::Matrix3d axes = random.rotation();
        contact::PlaneNumbers& plane = planes[k];
        copy(0.1 * random.vector(), plane.origin), copy(axes.col(0), plane.x), copy(axes.col(1), plane.y);
        copy(axes.col(0).cross(axes.col(1)), plane.normal);
        for (int i = 0; i < 2; ++i) plane.scale[i] = random(), plane.shift[i] = random();
        for (int d = 0; d < 3; ++d) {
          kept.origin[d][k] = plane.origin[d];
          kept.x[d][k] = plane.x[d], kept.y[d][k] = plane.y[d];
        }
        for (int i = 0; i < 2; ++i) kept.scale[i][k] = plane.scale[i], kept.shift[i][k] = plane.shift[i];
      }
      FeetBlock each = block;
      kernel.room_to_move(each, kept);
      kernel.over_planes(each, kept);
      for (int k = 0; k < block.count; ++k) {
        FeetBlock one = block;
        kernel.room_to_move(one, kept);
        kernel.over_one_plane(one, kept, planes[k]);
        const Vector3d c = get(block.centre, k), n = Vector3d::Map(planes[k].normal),
                       way = c - Vector3d::Map(planes[k].origin);
        const double distance = kept.sign[k] * n.dot(way);
        for (const FeetBlock* found : {&one, &each}) {
          EXPECT_NEAR(found->distance[k], distance, 4 * kRoundOff);
          EXPECT_LT((get(found->delta, k) - n.dot(way) * n).norm(), 8 * kRoundOff);
          EXPECT_NEAR(found->xi[0][k],
                      planes[k].scale[0] * way.dot(Vector3d::Map(planes[k].x)) + planes[k].shift[0],
                      4 * kRoundOff);
          EXPECT_NEAR(found->xi[1][k],
                      planes[k].scale[1] * way.dot(Vector3d::Map(planes[k].y)) + planes[k].shift[1],
                      4 * kRoundOff);
          const bool is_there = distance > 0.0 && distance < block.touch_reach[k] && may_move(block, kept, k);
          EXPECT_EQ(found->room[k] > 0.0, is_there);
          there += is_there;
        }
      }
    }
    EXPECT_GT(there, 10);
  }
}

// Three arcs around it, from `begin` on.
brep::ChartLine around_cylinder(double begin) { return {{begin, begin + 3.5}, {-1.0, 2.0}, 3}; }
brep::ChartLine along_cylinder() { return {{-0.8, 0.7}, {0.5, 3.0}, 0}; }

// Their parameters are to the last bit as each alone has them.
TEST(FeetKernel, FeetOverACylinder) {
  Random random;
  for (const SimdLevel level : levels_here()) {
    const contact::FeetKernel kernel = contact::feet_kernel(level);
    int there = 0;
    for (int blocks = 0; blocks < 2; ++blocks) {
      FeetBlock block = random_block(random, 29);
      const KeptFeet kept = kept_feet(random, block);
      const Eigen::Matrix3d axes = random.rotation();
      const Vector3d origin = 0.1 * random.vector();
      const brep::ChartLine around = around_cylinder(-1.5), along = along_cylinder();
      contact::CylinderNumbers cylinder{{}, {}, {}, {}, 0.7, 0.3, around.numbers(), along.numbers()};
      copy(origin, cylinder.origin), copy(axes.col(0), cylinder.x), copy(axes.col(1), cylinder.y);
      copy(axes.col(2), cylinder.z);
      kernel.room_to_move(block, kept);
      kernel.over_one_cylinder(block, kept, cylinder);
      for (int k = 0; k < block.count; ++k) {
        const Vector3d way = get(block.centre, k) - origin, z = axes.col(2), across = way - way.dot(z) * z;
        const double distance = kept.sign[k] * (across.norm() - 0.7);
        EXPECT_NEAR(block.distance[k], distance, 4 * kRoundOff);
        EXPECT_NEAR(block.length[k], way.dot(z), 4 * kRoundOff);
        EXPECT_NEAR(block.cos[k], across.normalized().dot(axes.col(0)), 8 * kRoundOff);
        EXPECT_NEAR(block.sin[k], across.normalized().dot(axes.col(1)), 8 * kRoundOff);
        EXPECT_LT((get(block.delta, k) - (across - 0.7 * across.normalized())).norm(), 8 * kRoundOff);
        double xi[2];
        const bool is_around = around.place_angle(block.cos[k], block.sin[k], xi[0]),
                   is_along = along.place_length(block.length[k], xi[1]);
        EXPECT_EQ(block.xi[0][k], xi[0]);
        EXPECT_EQ(block.xi[1][k], xi[1]);
        const bool is_there = may_move(block, kept, k) && distance > 0.0 && distance < block.touch_reach[k] &&
                              across.norm() > 0.3 && is_around && is_along;
        EXPECT_EQ(block.room[k] > 0.0, is_there);
        there += is_there;
      }
    }
    EXPECT_GT(there, 3);
  }
}

// A centre that comes too near its foot, or may within the step, has no room.
TEST(FeetKernel, StepsThatNeedASecondLook) {
  Random random;
  for (const SimdLevel level : levels_here()) {
    FeetBlock block = random_block(random, 29);
    for (int k = 0; k < block.count; ++k) {
      block.room[k] = 1.0;
      block.distance[k] = block.touch_reach[k] * random(0.3, 1.0);
    }
    constexpr contact::StepNumbers step{0.1, 0.05, 0.4};
    contact::feet_kernel(level).stay_outside(block, step);
    int there = 0;
    for (int k = 0; k < block.count; ++k) {
      const double way2 = 0.1 * block.squared_speed[k] + 0.05, distance = block.distance[k];
      const bool is_there =
          distance > std::max(0.5 * block.touch_reach[k], 0.4) && distance > std::sqrt(way2);
      EXPECT_EQ(block.room[k] > 0.0, is_there) << k;
      there += is_there;
    }
    EXPECT_GT(there, 10);
    EXPECT_LT(there, 50);
  }
}

// Runs give the same digits on all machines.
TEST(FeetKernel, InstructionSetsAgreeInAllDigits) {
  Random random;
  const FeetBlock given = random_block(random, 31);
  const KeptFeet kept = kept_feet(random, given);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = random.rotation();
  const Vector3d origin = random.vector();
  const auto found_by = [&](SimdLevel level) {
    const contact::FeetKernel kernel = contact::feet_kernel(level);
    FeetBlock block = given;
    const contact::CylinderNumbers cylinder{{0.1, 0.2, 0.3},
                                            {1, 0, 0},
                                            {0, 0.8, 0.6},
                                            {0, -0.6, 0.8},
                                            0.7,
                                            0.01,
                                            around_cylinder(0.3).numbers(),
                                            along_cylinder().numbers()};
    kernel.into_frame(block, origin.data(), R.data());
    kernel.room_to_move(block, kept);
    kernel.over_one_cylinder(block, kept, cylinder);
    kernel.stay_outside(block, {1e-3, 1e-4, 1e-3});
    kernel.into_space(block, R.data());
    std::vector<double> numbers;
    for (int k = 0; k < block.count; ++k)
      for (const double x : {block.room[k], block.distance[k], block.cos[k], block.sin[k], block.xi[0][k],
                             block.xi[1][k], block.delta[0][k], block.delta[1][k], block.delta[2][k]})
        numbers.push_back(x);
    return numbers;
  };
  for (const SimdLevel level : levels_here())
    EXPECT_EQ(found_by(level), found_by(SimdLevel::portable)) << nurbs::name(level);
}

}  // namespace
