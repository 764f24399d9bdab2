// SPDX-License-Identifier: GPL-2.0-or-later
// Elements that an image of the wall has where the wall itself has others: what is asked of each to find out.
#include "coupling/contact/repeated_elements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "coupling/contact/feet_tracker.h"

namespace {

using nurbs::Vector3;

/// A strip of elements of length 1 along x from 0 on; knows how often each was asked for its points.
class Strip final : public contact::WallShape {
 public:
  explicit Strip(int elements) : asked(elements, 0) {}
  mutable std::vector<int> asked;

  search::Box bounds() const override { return {{0, 0, 0}, {static_cast<double>(asked.size()), 1, 0}}; }
  void near(const Vector3& point, double reach, std::vector<int>& elements) const override {
    for (int e = 0; e < static_cast<int>(asked.size()); ++e)
      if (point.x() >= e - reach && point.x() <= e + 1 + reach) elements.push_back(e);
  }
  void points_of(int element, std::vector<Vector3>& points) const override {
    ++asked[element];
    points.clear();
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0}) points.emplace_back(element + x, y, 0);
  }
  void changed() override {}
  void begin_list(bool /*moved*/) override {}
  std::unique_ptr<contact::FeetTracker> track(const contact::CandidateList& /*candidates*/,
                                              contact::SearchMethod /*method*/,
                                              contact::SearchCounts& /*counts*/) const override {
    return nullptr;
  }
  Vector3 normal_at(const search::Foot& /*foot*/) const override { return Vector3::UnitZ(); }
  nurbs::SurfaceShape shape_near(const search::Foot& /*foot*/) const override { return {}; }
  int outward_sign(int /*patch*/) const override { return 0; }
};

std::vector<int> numbers(int first, int count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), first);
  return all;
}

constexpr double kReach = 0.4, kBox = 8.0;

TEST(RepeatedElements, AreThoseThatLieOnOthers) {
  const Strip longer(12);
  contact::RepeatedElements repeated(longer);
  const Vector3 shift(kBox, 0, 0), d(1.5, 0.5, 0.1);
  const std::vector<int> near_d = numbers(0, 3);
  EXPECT_TRUE(repeated.all(shift, d, kReach, near_d.data(), 3)) << "0 to 2 lie on 8 to 10";
  EXPECT_FALSE(repeated.all(-shift, d, kReach, near_d.data(), 3)) << "there is nothing";
  const Vector3 half(kBox + 0.5, 0, 0);
  EXPECT_FALSE(repeated.all(half, d, kReach, near_d.data(), 3)) << "each lies on halves of two";
  const std::vector<int> beyond = numbers(4, 2);
  EXPECT_TRUE(repeated.all(shift, d, kReach, beyond.data(), 2)) << "nothing, but out of reach";
}

// Fine walls in a periodic box are asked for all elements along their rims, and for each image.
TEST(RepeatedElements, OfWallsThatEndWithTheBoxEachIsAskedOnce) {
  const Strip strip(8);
  contact::RepeatedElements repeated(strip);
  const std::vector<int> all = numbers(0, 8);
  const Vector3 images[] = {{-kBox, 0, 0}, {kBox, 0, 0}, {kBox, kBox, 0}};
  for (const double x : {0.1, 4.0, 7.9})
    for (const Vector3& image : images)
      EXPECT_FALSE(repeated.all(image, {x, 0.5, 0.1}, kReach, all.data(), 8)) << x;
  for (const int times : strip.asked) EXPECT_LE(times, 1);
}

}  // namespace
