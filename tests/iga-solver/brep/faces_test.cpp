// SPDX-License-Identifier: GPL-2.0-or-later
// Faces in closed form against a search on a grid of their parameters; borders of several.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "brep/summary.h"
#include "face_grid.h"
#include "mixed_trial.h"

namespace brep {
namespace {

using trials::face_of;
using trials::feet;
using trials::Grid;
using trials::point_on;

class OneFace : public testing::TestWithParam<int> {};

TEST_P(OneFace, HasTheMinimaThatAGridHas) {
  const Frame frame = frame_at({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0}, {1.0, 0.3, 0.0});
  const Face faces[] = {
      face_of(Kind::plane, frame, 0.0, 0.0, {-0.5, 0.2}, {1.0, 1.5}),
      face_of(Kind::cylinder, frame, 1.0, 0.0, {0.0, -0.5}, {2.0 * nurbs::kPi, 0.8}),
      face_of(Kind::cylinder, frame, 1.0, 0.0, {0.4, -0.5}, {2.0, 0.8}),
      face_of(Kind::cylinder, frame, 1.0, 0.0, {0.4, -0.5}, {5.0, 0.8}),
      face_of(Kind::cone, frame, 0.0, 0.6, {-1.0, 0.0}, {2.0 * nurbs::kPi - 1.0, 1.2}),
      face_of(Kind::cone, frame, 0.0, 0.6, {0.2, 0.3}, {1.7, 1.2}),
      face_of(Kind::cone, frame, 0.0, 1.1, {0.2, 0.0}, {4.0, 1.2}),
      face_of(Kind::sphere, frame, 1.0, 0.0, {0.0, -0.5 * nurbs::kPi}, {2.0 * nurbs::kPi, 0.5 * nurbs::kPi}),
      face_of(Kind::sphere, frame, 1.0, 0.0, {0.3, -0.4}, {2.0, 1.1}),
      face_of(Kind::sphere, frame, 1.0, 0.0, {0.3, 0.1}, {2.5, 0.5 * nurbs::kPi}),
      face_of(Kind::torus, frame, 1.0, 0.4, {0.0, 0.0}, {2.0 * nurbs::kPi, 2.0 * nurbs::kPi}),
      face_of(Kind::torus, frame, 1.0, 0.4, {0.3, -1.0}, {2.3, 2.0}),
      face_of(Kind::torus, frame, 1.0, 0.4, {0.0, 1.0}, {2.0 * nurbs::kPi, 2.9}),
  };
  const Face& face = faces[GetParam()];
  const Surface surface = from_faces({face});
  const Grid grid(face);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.6, 1.6), share(0.0, 1.0);
  int count = 0;
  for (int k = 0; k < 60; ++k) {
    Vector3 d;  // one number after the other: compilers differ in the order of arguments
    for (double& x : d) x = uniform(random);
    d += frame.origin;
    if (k % 2 == 0) {
      Parameter<2> xi;
      for (int i = 0; i < 2; ++i) xi[i] = face.low[i] + share(random) * (face.high[i] - face.low[i]);
      const double length = 0.3 * uniform(random);
      d = point_on(face, xi[0], xi[1]) + length * trials::random_direction(random);
    }
    const double reach = 0.3 + share(random);
    const auto expected = grid.minima(d, reach);
    const auto found = feet(surface, d, reach);
    EXPECT_GE(found.size(), expected.size()) << "d = " << d.transpose();
    for (const auto& [x, xi] : expected) {
      double nearest = 1.0;
      for (const Foot& foot : found) nearest = std::min(nearest, (x - foot.point).norm());
      EXPECT_LT(nearest, 1e-6) << "d = " << d.transpose() << ", minimum " << x.transpose();
    }
    for (const Foot& foot : found) {
      // the grid may be too coarse for a shallow one
      EXPECT_TRUE(grid.is_lowest_around(d, foot.xi))
          << "d = " << d.transpose() << ", foot " << foot.point.transpose();
      EXPECT_LT((point_on(face, foot.xi[0], foot.xi[1]) - foot.point).norm(), 1e-12);
      EXPECT_NEAR((d - foot.point).norm(), foot.distance, 1e-14);
      if (foot.status == FootStatus::interior) {
        EXPECT_GT(foot.side * face.normal(foot.xi).dot(d - foot.point),
                  (1.0 - 1e-12) * foot.distance - 1e-15);
      }
    }
    count += static_cast<int>(found.size());
  }
  EXPECT_GT(count, 30);
}
INSTANTIATE_TEST_SUITE_P(Faces, OneFace, testing::Range(0, 13));

TEST(Faces, NormalsAndCurvaturesAreThoseOfDifferences) {
  const Frame frame = frame_at({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0}, {1.0, 0.3, 0.0});
  for (const Kind kind : {Kind::plane, Kind::cylinder, Kind::cone, Kind::sphere, Kind::torus}) {
    const Face face = face_of(kind, frame, 1.3, 0.4, {0.0, 0.0}, {1.0, 1.0});
    const Parameter<2> xi{0.7, 0.5};
    const double h = 1e-4;
    const auto at = [&](double a, double b) { return point_on(face, xi[0] + a, xi[1] + b); };
    const Vector3 n = (at(h, 0) - at(-h, 0)).cross(at(0, h) - at(0, -h)).normalized();
    EXPECT_LT((face.normal(xi) - n).norm(), 1e-7);
    EXPECT_LT((face.point(xi) - at(0, 0)).norm(), 1e-14);
    const Parameter<2> curvatures = face.curvatures(xi);
    for (int i = 0; i < 2; ++i) {
      const Vector3 before = i == 0 ? at(-h, 0) : at(0, -h), behind = i == 0 ? at(h, 0) : at(0, h);
      const double curvature =
          (behind + before - 2.0 * at(0, 0)).dot(n) / (0.25 * (behind - before).squaredNorm());
      EXPECT_NEAR(curvatures[i], curvature, 1e-5);
    }
  }
}

TEST(Faces, WhereAllPointsAreEquallyFarThereIsOneFoot) {
  const Frame frame;
  const Surface pipe =
      from_faces({face_of(Kind::cylinder, frame, 1.0, 0.0, {0.0, -1.0}, {2.0 * nurbs::kPi, 1.0})});
  EXPECT_EQ(feet(pipe, {0.0, 0.0, 0.2}, 1.5).size(), 1u);
  const Surface part = from_faces({face_of(Kind::cylinder, frame, 1.0, 0.0, {1.0, -1.0}, {2.0, 1.0})});
  EXPECT_EQ(feet(part, {0.0, 0.0, 0.2}, 1.5).size(), 1u);
  const Surface ball = from_faces({face_of(Kind::sphere, frame, 1.0, 0.0, {0.0, -0.5 * nurbs::kPi},
                                           {2.0 * nurbs::kPi, 0.5 * nurbs::kPi})});
  EXPECT_EQ(feet(ball, {0.0, 0.0, 0.0}, 1.5).size(), 1u);
  EXPECT_EQ(feet(ball, {0.0, 0.0, 0.5}, 1.5).size(), 1u);
  const Surface ring =
      from_faces({face_of(Kind::torus, frame, 1.0, 0.3, {0.0, 0.0}, {2.0 * nurbs::kPi, 2.0 * nurbs::kPi})});
  EXPECT_EQ(feet(ring, {1.0, 0.0, 0.0}, 1.5).size(), 1u);
}

// A rounded edge: a plane, a quarter of a cylinder, a plane.
std::vector<Face> rounded_edge(double radius) {
  const Frame low = frame_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0});
  const Frame side = frame_at({radius, 0.0, radius}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  const Frame axis = frame_at({0.0, 0.0, radius}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0});
  return {face_of(Kind::plane, low, 0.0, 0.0, {-1.0, -1.0}, {0.0, 0.0}),
          face_of(Kind::cylinder, axis, radius, 0.0, {0.0, 0.0}, {0.5 * nurbs::kPi, 1.0}),
          face_of(Kind::plane, side, 0.0, 0.0, {0.0, 0.0}, {1.0, 1.0})};
}

TEST(Faces, AcrossSmoothEdgesThereIsOneFootThroughout) {
  const double radius = 0.2, ball = 0.1, overlap = 0.003;
  const Surface surface = from_faces(rounded_edge(radius));
  const Summary summary = summary_of(surface);
  EXPECT_EQ(summary.smooth, 2);
  EXPECT_EQ(surface.sheet_count, 1);  // both sides, over the free edges
  for (const double far : {ball - overlap, -(ball - overlap)}) {
    double last = 0.0;
    for (int k = 0; k <= 4000; ++k) {
      // Along the offset: the plane below, the arc, the plane at the side.
      const double s = -0.3 + 0.0002 * k, bent = 0.5 * nurbs::kPi * radius;
      Vector3 d(s, 0.4, -far), n(0.0, 0.0, -1.0);
      if (s > 0.0) {
        const double angle = std::min(s, bent) / radius;
        n = Vector3(std::sin(angle), 0.0, -std::cos(angle));
        d = Vector3(0.0, 0.4, radius) + (radius + far) * n + std::max(0.0, s - bent) * Vector3(0.0, 0.0, 1.0);
      }
      const auto found = feet(surface, d, ball);
      ASSERT_EQ(found.size(), 1u) << "s = " << s << ", " << far;
      EXPECT_NEAR(found[0].distance, ball - overlap, 1e-12);
      EXPECT_LT(std::abs(n.dot((d - found[0].point).normalized()) - (far > 0.0 ? 1.0 : -1.0)), 1e-12);
      last = s;
    }
    EXPECT_GT(last, 0.49);
  }
}

// In the plane through the axis and a straight side of a pipe's part: the side is what is nearest, or, for a
// point beyond the axis, what is farthest along the pipe.
TEST(Faces, ASideThatIsFarthestIsNoFoot) {
  const Face pipe = face_of(Kind::cylinder, Frame(), 1.0, 0.0, {0.0, 0.0}, {3.8, 1.0});
  const Face plate = face_of(Kind::plane, frame_at({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}), 0.0,
                             0.0, {0.0, 0.0}, {1.0, 1.0});
  for (const double z : {0.0, 0.5, 1.0}) {  // the ends of the side, too
    const auto before = feet(from_faces({pipe}), {0.3, 0.0, z}, 1.2);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_LT((before[0].point - Vector3(1.0, 0.0, z)).norm(), 1e-12);
    const auto beyond = feet(from_faces({pipe}), {-0.1, 0.0, z}, 1.2);
    ASSERT_EQ(beyond.size(), 1u);
    EXPECT_LT((beyond[0].point - Vector3(-1.0, 0.0, z)).norm(), 1e-12);
    EXPECT_EQ(feet(from_faces({pipe, plate}), {-0.1, 0.0, z}, 1.2).size(), 2u) << "and the plate's edge";
  }
}

TEST(Faces, CirclesOfFacesRoundOneAxisAreOneEdge) {
  const Frame frame = frame_at({0.1, 0.2, 0.3}, {0.0, 0.6, 0.8}, {1.0, 0.0, 0.0});
  const Frame turned = frame_at({0.1, 0.2, 0.3}, {0.0, 0.6, 0.8}, {0.3, 0.8, -0.6});
  Frame tip = turned;
  tip.origin -= 1.0 / std::tan(0.5) * tip.z;
  const Surface silo =
      from_faces({face_of(Kind::cylinder, frame, 1.0, 0.0, {0.0, 0.0}, {2.0 * nurbs::kPi, 2.0}),
                  face_of(Kind::cone, tip, 0.0, 0.5, {0.0, 0.4}, {2.0 * nurbs::kPi, 1.0 / std::sin(0.5)})});
  const Summary summary = summary_of(silo);
  EXPECT_EQ(summary.free, 2);
  EXPECT_EQ(summary.convex, 1);
  EXPECT_EQ(silo.edges.size(), 3u);
  EXPECT_NEAR(summary.area,
              2.0 * nurbs::kPi * 2.0 + nurbs::kPi * std::sin(0.5) * (std::pow(1.0 / std::sin(0.5), 2) - 0.16),
              1e-9);
  // Inside, over the concave edge: the cylinder's foot and the cone's.
  const auto found = feet(silo, frame.origin + 0.9 * frame.x + 0.1 * frame.z, 0.3);
  EXPECT_EQ(found.size(), 2u);
}

TEST(Trials, RandomMixedWallsAgreeWithTheirJudge) {
  long count = 0;
  for (int index = 0; index < 24; ++index) {
    trials::MixedTrial trial(4, index);
    ASSERT_EQ(trial.try_sheets(), "") << index;
    for (int k = 0; k < 24; ++k) EXPECT_EQ(trial.try_point(k, count), "") << index << ", point " << k;
  }
  EXPECT_GT(count, 500);
}

TEST(Faces, AreRefusedWithTheirNumber) {
  const auto refused = [](const Face& face) -> std::string {
    try {
      from_faces({face_of(Kind::plane, Frame(), 0.0, 0.0, {0.0, 0.0}, {1.0, 1.0}), face});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refused(face_of(Kind::cylinder, Frame(), 0.0, 0.0, {0.0, 0.0}, {1.0, 1.0})),
              testing::HasSubstr("face 1 (cylinder): radius 0"));
  EXPECT_THAT(refused(face_of(Kind::torus, Frame(), 1.0, 1.5, {0.0, 0.0}, {1.0, 1.0})),
              testing::HasSubstr("tube"));
  EXPECT_THAT(refused(face_of(Kind::cylinder, Frame(), 1.0, 0.0, {0.0, 0.0}, {7.0, 1.0})),
              testing::HasSubstr("more than a whole turn"));
}

// Whichever way their axes look, round-off in them included: a circle has two.
TEST(CoaxialFaces, MeetInOneSmoothEdge) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vector3 axes[] = {
      {0.8, -0.6, 0.0}, {-4.0, 3.0, 0.0}, {0.0, 5.0, -3.0}, {-20.0, 0.0, 9.0}, {1.0, 1.0, 1.0}};
  for (const Vector3& axis : axes)
    for (int k = 0; k < 8; ++k) {
      const Vector3 origin(uniform(random), uniform(random), uniform(random)), z = axis.normalized();
      const Vector3 x = axis.unitOrthogonal();
      const Frame below = frame_at(origin, z, x), above = frame_at(origin + 0.5 * z, z, x);
      const Frame turned = frame_at(origin + 0.8 * z, -z, x);  // to meet the lower one from above
      const double turn = 2.0 * nurbs::kPi;
      const Face lower = face_of(Kind::cylinder, below, 0.2, 0.0, {0.0, 0.0}, {turn, 0.5});
      for (const Face& upper : {face_of(Kind::cylinder, above, 0.2, 0.0, {0.0, 0.0}, {turn, 0.3}),
                                face_of(Kind::cylinder, turned, 0.2, 0.0, {0.0, 0.0}, {turn, 0.3})}) {
        const Surface surface = from_faces({lower, upper});
        EXPECT_EQ(surface.edges.size(), 3u) << axis.transpose();
        EXPECT_EQ(feet(surface, origin + 0.5 * z + 0.25 * x, 0.1).size(), 1u) << axis.transpose();
      }
    }
}

}  // namespace
}  // namespace brep
