// SPDX-License-Identifier: GPL-2.0-or-later
// Feet of blocks over faces in closed form beside brep::Face, with each instruction set that this machine
// has; angles beside the library's.
#include "coupling/contact/face_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "brep/angle.h"
#include "brep/face.h"

namespace {

using brep::Kind;
using contact::FaceBlock;
using contact::FaceNumbers;
using Eigen::Vector3d;
using nurbs::kPi;

struct Numbers {
  std::mt19937 engine{11};
  double operator()(double low = -1.0, double high = 1.0) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  Vector3d vector() { return {(*this)(), (*this)(), (*this)()}; }
};

brep::Face random_face(Numbers& random, Kind kind) {
  brep::Face face;
  face.kind = kind;
  face.frame = brep::frame_at(0.1 * random.vector(), random.vector(), random.vector());
  face.R = random(0.3, 0.9);
  face.r = kind == Kind::cone ? random(0.1, 1.4) : 0.5 * face.R;
  face.low = {random(-7.0, 7.0), kind == Kind::sphere ? -0.5 * kPi : random(-7.0, 7.0)};
  face.high = {face.low[0] + random(1.0, 6.0), face.low[1] + (kind == Kind::sphere ? kPi : 6.0)};
  return face;
}

TEST(FaceKernel, FeetAreThoseOfFaces) {
  Numbers random;
  for (const auto level : {nurbs::SimdLevel::portable, nurbs::SimdLevel::avx2, nurbs::SimdLevel::avx512}) {
    if (!nurbs::available(level)) continue;
    int there = 0;
    for (int run = 0; run < 50; ++run) {
      FaceBlock block;
      block.count = 61;  // not a whole number of words
      std::vector<brep::Face> faces;
      for (int k = 0; k < block.count; ++k) {
        faces.push_back(random_face(random, static_cast<Kind>(k % 5)));
        const FaceNumbers numbers = FaceNumbers::of(faces[k]);
        for (int i = 0; i < FaceNumbers::count; ++i) block.face[i][k] = numbers.value[i];
        const Vector3d centre = random.vector();
        for (int d = 0; d < 3; ++d) block.centre[d][k] = centre[d];
        block.sign[k] = random() > 0.0 ? 1.0 : -1.0;
        block.touch_reach[k] = random(0.2, 0.8), block.room[k] = random(-0.2, 1.0);
      }
      const FaceBlock given = block;
      contact::face_kernel(level)(block);
      for (int k = 0; k < block.count; ++k) {
        const Vector3d d(given.centre[0][k], given.centre[1][k], given.centre[2][k]);
        const brep::Projection foot = faces[k].project(d);
        const double distance = given.sign[k] * foot.height;
        constexpr double kSame = 4e-15;
        EXPECT_NEAR(block.distance[k], distance, kSame) << k;
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(block.xi[i][k], foot.xi[i], kSame) << k << ' ' << i;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(block.delta[i][k], (d - foot.point)[i], kSame) << k;
        const bool is_there = given.room[k] > 0.0 && distance > 0.0 && distance < given.touch_reach[k];
        EXPECT_EQ(block.room[k] > 0.0, is_there) << k;
        EXPECT_LE(block.room[k], given.room[k]);
        there += is_there;
      }
    }
    EXPECT_GT(there, 300);
  }
}

// Who is on an axis, or in the circle of a torus, has no foot of his own.
TEST(FaceKernel, NoFootFromWhereThereAreMany) {
  Numbers random;
  for (const Kind kind : {Kind::cylinder, Kind::cone, Kind::sphere, Kind::torus}) {
    const brep::Face face = random_face(random, kind);
    const FaceNumbers numbers = FaceNumbers::of(face);
    FaceBlock block;
    block.count = 1;
    for (int i = 0; i < FaceNumbers::count; ++i) block.face[i][0] = numbers.value[i];
    Vector3d d = face.frame.origin;
    if (kind == Kind::torus) d += face.R * face.frame.x;
    if (kind == Kind::cone || kind == Kind::cylinder) d += 0.5 * face.frame.z;
    for (int i = 0; i < 3; ++i) block.centre[i][0] = d[i];
    block.sign[0] = face.project(d).height < 0.0 ? -1.0 : 1.0;
    block.touch_reach[0] = 2.0, block.room[0] = 1.0;
    contact::face_kernel(nurbs::SimdLevel::portable)(block);
    EXPECT_FALSE(block.room[0] > 1e-14) << static_cast<int>(kind);
  }
}

TEST(FaceKernel, AnglesAreThoseOfTheLibrary) {
  constexpr int kAngles = 100003;
  double worst = 0.0;
  for (int k = 0; k <= kAngles; ++k) {
    const double angle = kPi * (2.0 * k / kAngles - 1.0), length = std::exp2(k % 61 - 30);
    const double cos = length * std::cos(angle), sin = length * std::sin(angle);
    worst = std::max(worst, std::abs(brep::angle_of(cos, sin) - std::atan2(sin, cos)));
  }
  EXPECT_LT(worst, 3e-16 * kPi);
  EXPECT_EQ(brep::angle_of(1.0, 0.0), 0.0);
  EXPECT_EQ(brep::angle_of(0.0, 1.0), 0.5 * kPi);
  EXPECT_EQ(brep::angle_of(0.0, -2.0), -0.5 * kPi);
  EXPECT_EQ(brep::angle_of(-1.0, 0.0), kPi);
  EXPECT_EQ(brep::angle_of(1.0, 1.0), 0.25 * kPi);
}

}  // namespace
