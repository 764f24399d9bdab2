// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and energy of a ball that is pressed on a wall and moved over its edges and vertices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "trial_walls.h"

namespace brep {
namespace {

// Springs of stiffness 1 along every foot's normal.
struct Pressed {
  Vector3 force = Vector3::Zero();
  double energy = 0.0;
  int contacts = 0;
};

class Roller {
 public:
  Roller(const trials::Wall& wall, double radius)
      : surface_(from_triangles(wall.coordinates(), wall.corners())), search_(surface_), radius_(radius) {}

  Pressed at(const Vector3& d) {
    near_.clear(), feet_.clear();
    search_.near(d, radius_, near_);
    search_.feet(d, radius_, near_.data(), static_cast<int>(near_.size()), feet_);
    Pressed sum;
    for (const Foot& foot : feet_) {
      const double overlap = radius_ - foot.distance;
      sum.force += overlap / foot.distance * (d - foot.point);
      sum.energy += 0.5 * overlap * overlap;
      ++sum.contacts;
    }
    return sum;
  }

  // Greatest change of force per length, and of energy against work, on a straight way.
  struct Way {
    double slope = 0.0, energy_lost = 0.0;
    int most = 0, least = 100;
  };
  Way along(const Vector3& from, const Vector3& to, int steps) {
    Way way;
    const Pressed start = at(from);
    Pressed last = start;
    double work = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      const Pressed now = at((1.0 - s) * from + s * to);
      way.slope = std::max(way.slope, (now.force - last.force).norm() * steps / (to - from).norm());
      work += 0.5 * (now.force + last.force).dot(to - from) / steps;
      way.most = std::max(way.most, now.contacts);
      way.least = std::min(way.least, now.contacts);
      last = now;
    }
    way.energy_lost = std::abs(last.energy - start.energy + work);
    return way;
  }

 private:
  Surface surface_;
  FootSearch search_;
  double radius_;
  std::vector<int> near_;
  std::vector<Foot> feet_;
};

// A jump of the force by F in one of `steps` steps of a way L would be a slope of F * steps / L.
TEST(Rolling, OverEdgesOfAnyAngleForceIsContinuousAndEnergyKept) {
  for (const double turned : {0.5, 2.0, 5.0, 30.0, 90.0})
    for (const double sign : {-1.0, 1.0}) {
      // Over the edge of two plates, pressed by 5 % of the radius, on the convex and the concave side.
      const double bend = turned * nurbs::kPi / 180.0, radius = 0.1;
      Roller roller(trials::plates({0.0, nurbs::kPi - sign * bend}), radius);
      const Vector3 middle(0.0, 0.95 * radius, 0.5);
      const double end = turned == 90.0 && sign > 0.0 ? 0.05 : -0.05;  // not through the other plate
      const auto way = roller.along(middle + Vector3(0.15, 0.0, 0.0), middle + Vector3(end, 0.0, 0.1), 6000);
      const bool smooth = bend < 0.02;
      const bool convex = sign < 0.0;
      if (!smooth || convex) {
        EXPECT_LT(way.slope, 20.0) << turned << (convex ? " convex" : " concave");
        EXPECT_LT(way.energy_lost, 1e-7) << turned;
      } else {
        EXPECT_LT(way.slope * 0.22 / 6000.0, 1.5 * bend * 0.05 * radius)
            << "a jump by the edge's angle at most";
      }
      EXPECT_GE(way.least, bend < 0.1 ? 1 : 0);
      EXPECT_EQ(way.most, convex || smooth ? 1 : 2) << turned;
    }
}

TEST(Rolling, OverEdgesAndVerticesOfACubeAndInsideAnOpenBox) {
  std::mt19937 random(5);
  for (const bool inside : {false, true}) {
    Roller roller(inside ? trials::open_box() : trials::cube(), 0.2);
    for (int k = 0; k < 60; ++k) {
      // Round a corner, never through the wall.
      const auto beside = [&]() -> Vector3 {
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const Vector3 x(share(random), share(random), share(random));
        return inside ? Vector3(0.1 + 0.2 * x[0], 0.1 + 0.2 * x[1], 0.1 + 0.2 * x[2])
                      : Vector3(1.05 + 0.15 * x[0], 0.85 + 0.3 * x[1], 0.85 + 0.3 * x[2]);
      };
      const auto way = roller.along(beside(), beside(), 500);
      EXPECT_LT(way.slope, 10.0);
      EXPECT_LT(way.energy_lost, 1e-6);
      EXPECT_LE(way.most, inside ? 3 : 1);
    }
  }
}

}  // namespace
}  // namespace brep
