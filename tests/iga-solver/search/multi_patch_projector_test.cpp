// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/multi_patch_projector.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "nurbs/boundary.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

// On all elements of the surface and its images.
std::vector<Foot> minima(const MultiPatchProjector& projector, const Vector3& d, double reach,
                         const std::vector<Vector3>& images = {Vector3::Zero()}) {
  std::vector<int> elements(projector.surface().element_count());
  std::iota(elements.begin(), elements.end(), 0);
  std::vector<Foot> feet;
  for (const Vector3& image : images)
    projector.add_minima(d, image, reach, 1e-7, elements.data(), static_cast<int>(elements.size()), feet);
  return feet;
}

// On a closed surface a foot within round-off of the seam, of one patch or between two, is one minimum:
// neither two nor none, and not on the seam where it is beside it.
TEST(MultiPatchProjector, MinimaAtASeam) {
  for (const Frame& place : {frame({0, 0, 0}, {0, 0, 1}), frame({0.1, 0.2, 0.3}, {1, 2, 2})}) {
    const auto part = [&place](double from, double to) {
      return sphere(place, 1.0, refined(arc(from, to), 8, 2), refined(arc(-90, 0), 4, 2));
    };
    for (const PatchedSurface& ball : {join({part(0, 360)}), join({part(0, 180), part(180, 360)})}) {
      const MultiPatchProjector projector(ball.topology, ball.control_points);
      for (const double off : {0.0, 1e-19, 1e-17, 1e-16, 2e-16, 3e-16, 1e-15, 1e-13, 1e-9})
        for (const double y : {-off, off})
          for (int k = 1; k < 200; ++k) {
            const double latitude = -1.57 * k / 200.0;
            const Vector3 direction(std::cos(latitude), y / 0.9, std::sin(latitude));
            const auto feet = minima(projector, place.origin + 0.9 * place.axes * direction, 0.11);
            ASSERT_EQ(feet.size(), 1U) << "y = " << y << ", latitude " << latitude;
            EXPECT_NEAR(feet[0].distance, 0.1, 1e-13);
            EXPECT_LT((feet[0].point - place.origin - place.axes * direction.normalized()).norm(), 1e-11);
          }
    }
  }
}

PatchedSurface ball_of(int per_quarter, int meridians = 4, int patches_of_half = 4) {
  std::vector<Surface> patches;
  const double width = 360.0 / meridians;
  for (const double height : {-90.0, 0.0})
    for (int k = 0; k < patches_of_half; ++k)
      patches.push_back(sphere(frame({0, 0, 0}, {0, 0, 1}), 1.0,
                               refined(arc(width * k, width * (k + 1)), per_quarter, 2),
                               refined(arc(height, height + 90), per_quarter, 2)));
  return join(patches);
}

// A pole that patches share is a minimum only if no patch around it leads downhill; on an open ball (a wedge
// is missing) also from both of its ends.
TEST(MultiPatchProjector, MinimaAtASharedPole) {
  for (const int meridians : {4, 12})
    for (const int open : {0, 1}) {
      const PatchedSurface ball = ball_of(2, meridians, meridians - open);
      const MultiPatchProjector projector(ball.topology, ball.control_points);
      for (const double pole : {-1.0, 1.0})
        for (const double distance : {0.92, 0.999, 1.001, 1.08})
          for (int k = 0; k < 40; ++k) {
            const double polar = 0.2 * (k + 1) / 40.0, longitude = 0.123 + 0.61 * k;
            const double covered = 2.0 * M_PI * (meridians - open) / meridians;
            if (std::fmod(longitude, 2.0 * M_PI) > covered - 0.02) continue;
            const Vector3 d =
                distance * Vector3(std::sin(polar) * std::cos(longitude),
                                   std::sin(polar) * std::sin(longitude), pole * std::cos(polar));
            const std::vector<Foot> feet = minima(projector, d, 0.4);
            ASSERT_GE(feet.size(), 1U) << meridians << " patches, open " << open << ", d " << d.transpose();
            EXPECT_NEAR(feet[0].distance, std::abs(distance - 1.0), 1e-13);
            // The edges of a wedge that is missing have feet of their own, but not the pole.
            if (open == 0) {
              EXPECT_EQ(feet.size(), 1U) << meridians << " patches, d " << d.transpose();
            }
            for (size_t i = 1; i < feet.size(); ++i)
              EXPECT_GT((feet[i].point - Vector3(0.0, 0.0, pole)).norm(), 1e-6) << d.transpose();
          }
    }
}

// Half of a ball lies on one side of a periodic box, half on the other: its pole, too, has several images.
TEST(MultiPatchProjector, MinimaAtAPoleOnAPeriodicFace) {
  const Vector3 period(4, 0, 0);
  const auto half = [](const Vector3& centre, double from) {
    return sphere(frame(centre, {0, 0, 1}), 1.0, refined(arc(from, from + 180), 4, 2), arc(-90, 90));
  };
  const std::vector<Surface> halves = {half({0, 0, 0}, -90), half(period, 90)};
  PatchedSurface ball = join(halves);
  ball.topology.set_borders(find_borders(halves, 1e-9, {period}));
  const MultiPatchProjector projector(ball.topology, ball.control_points);
  for (const double pole : {-1.0, 1.0})
    for (const double distance : {0.92, 1.08})
      for (int k = 0; k < 40; ++k) {
        const double polar = 0.2 * (k + 1) / 40.0, longitude = 0.61 * k;
        const Vector3 direction(std::sin(polar) * std::cos(longitude), std::sin(polar) * std::sin(longitude),
                                pole * std::cos(polar));
        const std::vector<Foot> feet =
            minima(projector, distance * direction, 0.4, {Vector3::Zero(), -period});
        ASSERT_EQ(feet.size(), 1U) << "direction " << direction.transpose();
        EXPECT_LT((feet[0].point - direction).norm(), 1e-13);
      }
}

// Points that circle a ball of eight patches, each in a plane of its own, and an image of it far away: their
// feet, followed together from patch to patch, are where theory has them.
TEST(MultiPatchProjector, FollowsManyAcrossBorders) {
  const PatchedSurface ball = ball_of(3);
  const MultiPatchProjector projector(ball.topology, ball.control_points);
  constexpr int kPoints = 150, kSteps = 60;  // more than are taken at a time
  const Vector3 images[2] = {Vector3::Zero(), Vector3(40.0, -30.0, 20.0)};
  std::vector<Vector3> d(kPoints);
  std::vector<Foot> feet(kPoints);
  std::vector<Foot*> pointers;
  for (Foot& foot : feet) pointers.push_back(&foot);
  const auto direction = [](int k, int step) {
    const Vector3 axis = Vector3(std::cos(k), std::sin(3.0 * k), 0.1 + 0.001 * k).normalized();
    const Vector3 start = axis.cross(Vector3(std::sin(k), 0.3, std::cos(2.0 * k))).normalized();
    return Vector3(Eigen::AngleAxisd(0.1 * step, axis) * start);
  };
  int changes = 0;
  for (int step = 0; step < kSteps; ++step) {
    for (int k = 0; k < kPoints; ++k) d[k] = images[k % 2] + (1.0 + 0.002 * k) * direction(k, step);
    if (step == 0)
      for (int k = 0; k < kPoints; ++k) {
        const std::vector<Foot> all = minima(projector, d[k], 0.4, {images[k % 2]});
        ASSERT_FALSE(all.empty()) << "point " << k;
        feet[k] = all[0];
      }
    std::vector<int> before;
    std::vector<Foot> alone;
    for (int k = 0; k < kPoints; ++k) {
      before.push_back(feet[k].patch);
      alone.push_back(projector.follow(d[k], feet[k].at(), feet[k].image));
    }
    projector.follow(d.data(), pointers.data(), kPoints);
    for (int k = 0; k < kPoints; ++k) {
      changes += feet[k].patch != before[k];
      ASSERT_NEAR(feet[k].distance, 0.002 * k, 1e-13) << "point " << k << ", step " << step;
      ASSERT_LT((feet[k].point - images[k % 2] - direction(k, step)).norm(), 1e-13);
      ASSERT_EQ(feet[k].image, images[k % 2]);
      ASSERT_EQ(feet[k].point, alone[k].point);  // to the last bit
      ASSERT_EQ(feet[k].xi, alone[k].xi);
    }
  }
  EXPECT_GT(changes, 2 * kPoints);  // a turn crosses four octants or more
}

// Outside a cube the foot is on a face, on an edge of two patches or on a corner of three: one, as far as the
// sides opposite are out of reach.
TEST(MultiPatchProjector, OneFootOutsideACube) {
  const KnotVector knots = KnotVector::uniform(2, 3);
  const Volume solid = box({0, 0, 0}, {1, 1, 1}, {knots, knots, knots});
  std::vector<Surface> faces;
  for (const Face name :
       {Face::xi_minus, Face::xi_plus, Face::eta_minus, Face::eta_plus, Face::zeta_minus, Face::zeta_plus}) {
    const BoundarySurface face = boundary_surface(solid.space, name);
    faces.push_back({face.space, solid.control_points(Eigen::all, face.volume_control_point)});
  }
  const PatchedSurface surface = join(faces);
  const MultiPatchProjector projector(surface.topology, surface.control_points);
  shapes::Random random(61);
  int on_faces_edges_corners[4] = {};
  for (int k = 0; k < 1000; ++k) {
    const Vector3 d = Vector3::NullaryExpr([&] { return shapes::uniform(random, -0.5, 1.5); });
    const Vector3 foot = d.cwiseMax(0.0).cwiseMin(1.0);
    if (foot == d) continue;
    const std::vector<Foot> feet = minima(projector, d, 1.0);
    ASSERT_EQ(feet.size(), 1U) << "d " << d.transpose();
    EXPECT_LT((feet[0].point - foot).norm(), 1e-14) << "d " << d.transpose();
    ++on_faces_edges_corners[(foot.array() != d.array()).count()];
  }
  for (const int kind : {1, 2, 3}) EXPECT_GT(on_faces_edges_corners[kind], 100);
}

// A point that goes on and on over a floor of two patches, one turned round, that fills a periodic box: the
// foot is below it, on one image after the other, and one alone even on the edges of images.
TEST(MultiPatchProjector, FootOnAPeriodicFloor) {
  const Vector3 period_x(2, 0, 0), period_y(0, 1, 0), up(0, 0, 0.25);
  const std::array<KnotVector, 2> knots = {KnotVector::uniform(2, 3), KnotVector::uniform(1, 2)};
  const std::vector<Surface> patches = {plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, knots),
                                        plane({2, 1, 0}, {-1, 0, 0}, {0, -1, 0}, knots)};
  PatchedSurface floor = join(patches);
  floor.topology.set_borders(find_borders(patches, 1e-9, {period_x, period_y}));
  const MultiPatchProjector projector(floor.topology, floor.control_points);
  for (const double way : {-1.0, 1.0}) {
    SurfacePoint at{0, {0.5, 0.5}};
    Vector3 image = Vector3::Zero();
    for (int step = 0; step < 64; ++step) {
      const Vector3 below(0.5 + way * step / 8.0, 0.5 + way * step / 16.0, 0.0);
      const Foot foot = projector.follow(below + up, at, image);
      ASSERT_LT((foot.point - below).norm(), 1e-14) << "step " << step;
      std::vector<Vector3> images;
      for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0}) images.push_back(foot.image + x * period_x + y * period_y);
      const std::vector<Foot> feet = minima(projector, below + up, 0.3, images);
      ASSERT_EQ(feet.size(), 1U) << "step " << step;
      EXPECT_LT((feet[0].point - below).norm(), 1e-14) << "step " << step;
      at = foot.at(), image = foot.image;
    }
  }
}

}  // namespace
}  // namespace search
