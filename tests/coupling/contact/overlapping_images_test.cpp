// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that are longer than a periodic box, so that their images lie on themselves, or beside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "balls.h"
#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "walls.h"

namespace {

using coupling::RigidSurface;
using nurbs::KnotVector;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;
using test::wall_of;

constexpr double kPressed = 1e-3, kBeside = 0.6 * (kRadius - kPressed), kAbove = 0.8 * (kRadius - kPressed),
                 kRise = 0.02, kPeriod = 6.0;
const contact::PeriodicBox kShortBox{{-3, -9, -9}, {3, 9, 9}, {true, false, false}};

/// How far a wall reaches along x, to both sides, and in how many elements: some lie on others, some do not,
/// as they are no whole number to a period; of some the rim is within a ball's reach from the box.
const std::pair<double, int> kLong[] = {{4.0, 8}, {4.0, 5}, {3.1, 5}, {7.0, 14}};

/// A strip from x = -4 to 4 that rises by `slope`, and at its end, if that is above 0, a wall of this height.
RigidSurface long_strip(double slope, double height) {
  nurbs::NodalVectors points(3, 6);
  points << -4, 4, 4, -4, 4, 4,  //
      -4, -4, -4, 4, 4, 4,       //
      -4 * slope, 4 * slope, 4 * slope + height, -4 * slope, 4 * slope, 4 * slope + height;
  if (height > 0.0) return wall_of(points, {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4});
  return wall_of(points, {0, 1, 3, 1, 4, 3});
}

RigidSurface closed_forms(const std::vector<nurbs::Surface>& patches) {
  brep::FacedPatches faced = brep::closed_forms(patches, brep::kEdgeAngle).value();
  return RigidSurface(patches, {}, std::make_shared<brep::FacedPatches>(std::move(faced)));
}

/// About the x axis, from x = -end to end, so many degrees to both sides of z = -radius.
RigidSurface long_trough(double radius, double end, double degrees) {
  return closed_forms({nurbs::cylinder(nurbs::frame({-end, 0, 0}, {1, 0, 0}, Vector3(0, 0, -1)), radius,
                                       2.0 * end, nurbs::arc(-degrees, degrees), KnotVector::uniform(1, 1))});
}

/// A smooth patch with waves along x, three elements each, that repeats itself with the box: x is its
/// parameter.
nurbs::Surface waves() {
  constexpr int kElements = 24;
  const KnotVector across = KnotVector::uniform(2, 1);
  nurbs::Surface patch =
      nurbs::plane({0, -4, 0}, {kElements, 0, 0}, {0, 8, 0}, {KnotVector::uniform(2, kElements), across});
  const int n = patch.space.knots(0).control_point_count();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < across.control_point_count(); ++j)
      patch.control_points(2, i + n * j) = 1.6 * std::cos(2.0 * M_PI / kPeriod * i);
  return patch;
}

/// A floor with a slope at each side, in triangles of so many rows along x.
RigidSurface channel(double end, int rows) {
  nurbs::NodalVectors points(3, 4 * (rows + 1));
  std::vector<int> triangles;
  for (int i = 0; i <= rows; ++i) {
    const double x = -end + 2.0 * end * i / rows;
    points.middleCols<4>(4 * i) << x, x, x, x, -4, -1, 1, 4, 3, 0, 0, 3;
    for (int k = 4 * i; i < rows && k < 4 * i + 3; ++k)
      for (const int corner : {k, k + 4, k + 1, k + 4, k + 5, k + 1}) triangles.push_back(corner);
  }
  return wall_of(points, triangles);
}

/// Closed, its top at z = 0.
RigidSurface block(double end) {
  nurbs::NodalVectors points(3, 8);
  for (int k = 0; k < 8; ++k)
    points.col(k) << (k % 2 ? end : -end), (k / 2 % 2 ? 4.0 : -4.0), (k / 4 ? 0.0 : -3.0);
  std::vector<int> triangles;
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},  //
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}})
    for (const int corner : {a, b, c, a, c, d}) triangles.push_back(corner);
  return wall_of(points, triangles);
}

/// Flat, of so many pieces, with gaps between them if they are shorter than a period.
RigidSurface plates(double length, int count) {
  nurbs::NodalVectors points(3, 4 * count);
  std::vector<int> triangles;
  for (int k = 0; k < count; ++k) {
    const double x = (k - count / 2) * kPeriod, half = 0.5 * length;
    points.middleCols<4>(4 * k) << x - half, x + half, x - half, x + half, -4, -4, 4, 4, 0, 0, 0, 0;
    for (const int corner : {0, 1, 3, 0, 3, 2}) triangles.push_back(4 * k + corner);
  }
  return wall_of(points, triangles);
}

/// A row of so many arches, each as wide as the box, or of gutters.
RigidSurface arches(int count, bool are_gutters) {
  std::vector<nurbs::Surface> patches;
  for (int k = 0; k < count; ++k)
    patches.push_back(nurbs::cylinder(
        nurbs::frame({(k - count / 2) * kPeriod, -4, 0}, {0, 1, 0}, Vector3(0, 0, are_gutters ? -1 : 1)),
        kPeriod, 8.0, nurbs::arc(-30.0, 30.0), KnotVector::uniform(1, 1)));
  return closed_forms(patches);
}

/// Triangles in strips across x, which go up and down three times in the length of the box.
RigidSurface zigzag(double end, int strips) {
  nurbs::NodalVectors points(3, 2 * (strips + 1));
  std::vector<int> triangles;
  for (int i = 0; i <= strips; ++i) {
    const double x = -end + 2.0 * end * i / strips, z = 0.3 * std::abs(std::remainder(x, 2.0));
    points.middleCols<2>(2 * i) << x, x, -4, 4, z, z;
    for (int k = 2 * i; i < strips && k < 2 * i + 1; ++k)
      for (const int corner : {k, k + 2, k + 1, k + 2, k + 3, k + 1}) triangles.push_back(corner);
  }
  return wall_of(points, triangles);
}

/// z = -(y / 4)^2 / 2 for y < 0 and a slope beyond, which meet in an edge: faces without a closed form.
RigidSurface ridge(double end, int elements) {
  const KnotVector along = KnotVector::uniform(2, elements), across = KnotVector::uniform(2, 1);
  std::vector<nurbs::Surface> patches{
      nurbs::plane({-end, -4, 0}, {2 * end, 0, 0}, {0, 4, 0}, {along, across}),
      nurbs::plane({-end, 0, 0}, {2 * end, 0, 0}, {0, 4, -2}, {along, across})};
  for (int i = 0; i < along.control_point_count(); ++i) patches[0].control_points(2, i) = -0.5;
  return wall_of(patches);
}

/// A ball whose centre is centre(x), x = 0.1, 0.102, ... over all rims of the wall's images: one contact,
/// which keeps its slot.
template <class Centre>
void expect_one_contact(RigidSurface& wall, const Centre& centre) {
  constexpr double kStep = 2e-3;
  Balls balls(2, 1);
  balls.add(centre(0.1), kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 2; step <= 4000; ++step) {
    const double x = 0.1 + kStep * step, shift = std::floor((x + 3.0) / kPeriod) * kPeriod;
    scene.balls.centre(0) = centre(x) - shift * Vector3::UnitX();
    if (step % 50 == 0 || scene.balls.x[0] < -3.0 + kStep) scene.build_list();
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), 1u) << x;
    EXPECT_NEAR(scene.balls.force(0).norm(), kPressed, 1e-10) << x;
    EXPECT_EQ(scene.spring.seen[0].history[0], step) << x;
  }
}
/// The same of a wall that is straight along x.
void expect_no_end(RigidSurface wall, double y, double z) {
  expect_one_contact(wall, [=](double x) { return Vector3(x, y, z); });
}

TEST(OverlappingImages, OfAPlaneAddNothing) { expect_no_end(long_strip(0.0, 0.0), 0.1, kRadius - kPressed); }
TEST(OverlappingImages, OfAPipeAddNothing) {
  expect_no_end(long_trough(2.0, 4.0, 180.0), 2.0 - kRadius + kPressed, 0.0);
}

TEST(OverlappingImages, OfTrianglesAddNothing) {
  for (const auto& [end, rows] : kLong) expect_no_end(channel(end, rows), 0.2, kRadius - kPressed);
}

TEST(OverlappingImages, OfPatchesWithAnEdgeAddNothing) {
  for (const auto& [end, elements] : kLong)
    for (const double y : {-2.0, 2.0}) {
      const Vector3 foot(0.1, y, y < 0.0 ? -0.125 : -1.0),
          n = Vector3(0.0, y < 0.0 ? -0.125 : 0.5, 1.0).normalized();
      const Vector3 centre = foot + (kRadius - kPressed) * n;
      expect_no_end(ridge(end, elements), centre[1], centre[2]);
    }
}

/// On waves: `wall_of` makes one of the patch and its range.  Above where eta is so; beside their rim, at
/// eta = 0, off their plane.
template <class WallOf>
void expect_no_end_of_waves(double eta, const WallOf& wall_of) {
  constexpr double kMiddle = 12.0;
  const nurbs::Surface all = waves();
  for (const auto& [begin, end] :
       {std::pair{8.0, 16.0}, std::pair{8.3, 15.9}, std::pair{8.9, 15.1}, std::pair{5.0, 19.0}}) {
    nurbs::Surface part = nurbs::part_between(all, 0, begin / 24.0, end / 24.0);
    part.control_points.row(0).array() -= kMiddle;
    RigidSurface wall = wall_of(part);
    expect_one_contact(wall, [&](double x) {
      const double in_first = x - std::floor((x + 3.0) / kPeriod) * kPeriod;
      const auto at = nurbs::shape_near(all.space, all.control_points, {(in_first + kMiddle) / 24.0, eta});
      Vector3 up = at.normal[2] < 0.0 ? Vector3(-at.normal) : at.normal;
      if (eta == 0.0) up = 0.8 * up - 0.6 * Vector3::UnitY();
      return Vector3(at.point + (kRadius - kPressed) * up + (x - in_first - kMiddle) * Vector3::UnitX());
    });
  }
}

TEST(OverlappingImages, OfASmoothPatchAddNothing) {
  for (const double eta : {0.5, 0.0})
    expect_no_end_of_waves(eta, [](const nurbs::Surface& patch) { return RigidSurface({patch}); });
}

// Beyond the edge it goes down.
TEST(OverlappingImages, OfWavesWithAnEdgeAddNothing) {
  for (const double eta : {0.5, 0.0})
    expect_no_end_of_waves(eta, [](const nurbs::Surface& patch) {
      std::vector<nurbs::Surface> patches{patch, patch};
      nurbs::NodalVectors& points = patches[1].control_points;
      for (int k = 0; k < points.cols(); ++k) points(2, k) -= points(1, k) + 4.0;
      points.row(1).array() += 8.0;
      return wall_of(patches);
    });
}

/// Contacts: their number, what they sum to, and how long they last.
struct Seen {
  explicit Seen(const BallsOnWall& scene) : count(scene.spring.seen.size()), force(scene.balls.force(0)) {
    for (const contact::Contact& contact : scene.spring.seen) steps += contact.history[0];
  }
  std::size_t count;
  Vector3 force;
  double steps = 0.0;
};

/// A ball that goes along x, from there, feels what it feels on a longer wall without a periodic box; the
/// most contacts it has.
std::size_t expect_as_on_longer(RigidSurface wall, RigidSurface longer, const Vector3& from) {
  Balls balls(4, 1), others(4, 1);
  balls.add(from, kRadius), others.add(from, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox),
      reference(longer, others, 1.0, 1.0, {{-20, -9, -9}, {20, 9, 9}, {}});
  std::size_t most = 0;
  for (int step = 2; step <= 5000; ++step) {
    double &x = scene.balls.x[0], &further = reference.balls.x[0];
    further += 2e-3;
    x = std::remainder(further, kPeriod);
    if (step % 50 == 0 || std::abs(x + 3.0) < 2e-3) scene.build_list(), reference.build_list();
    scene.evaluate(), reference.evaluate();
    const Seen seen(scene), there(reference);
    EXPECT_EQ(seen.count, there.count) << further;
    EXPECT_LT((seen.force - there.force).norm(), 1e-10) << further;
    EXPECT_EQ(seen.steps, there.steps) << further;
    if (testing::Test::HasFailure()) break;
    most = std::max(most, seen.count);
  }
  return most;
}

TEST(OverlappingImages, OfAFoldedSheetAddNothing) {  // up and down
  for (const auto& [end, strips] : {std::pair{4.0, 8}, std::pair{4.0, 16}, std::pair{3.5, 14}})
    EXPECT_EQ(expect_as_on_longer(zigzag(end, strips), zigzag(14.0, 28), {-0.9, 0.3, kRadius}), 2u) << end;
}

// The wall itself ends in the box.
TEST(OverlappingImages, OfAPatchToOneSideAddNothing) {
  const KnotVector across = KnotVector::uniform(2, 1);
  const nurbs::Surface patch =
      nurbs::plane({-2, -4, 0}, {7, 0, 0}, {0, 8, 0}, {KnotVector::uniform(2, 7), across});
  expect_no_end(RigidSurface({patch}), 0.1, kRadius - kPressed);
  expect_no_end(RigidSurface({patch}), 4.0 + kBeside, kAbove);
}

TEST(OverlappingImages, OfABlockHideItsEnds) {
  for (const double end : {3.0, 3.1, 4.0, 6.0, 7.0}) {
    expect_no_end(block(end), 0.2, kRadius - kPressed);
    expect_no_end(block(end), 4.0 + kBeside, kAbove);
  }
}

TEST(OverlappingImages, OfAShorterPlateLeaveAGap) {
  EXPECT_EQ(expect_as_on_longer(plates(5.9, 1), plates(5.9, 5), {-0.9, 0.3, 0.8 * kRadius}), 2u);
}

// Between arches both touch, as long as both are in reach; the edge between gutters is touched once.
TEST(OverlappingImages, MeetInEdges) {
  const double rise = kPeriod * std::cos(M_PI / 6.0);
  EXPECT_EQ(expect_as_on_longer(arches(1, false), arches(5, false), {-0.9, 0.3, rise + 0.5 * kRadius}), 2u);
  EXPECT_EQ(expect_as_on_longer(arches(1, true), arches(5, true), {-0.9, 0.3, -rise + 0.8 * kRadius}), 1u);
}

// Rims along the box are met, and once, wherever images begin and end.
TEST(OverlappingImages, HaveTheRimsOfThePlane) {
  expect_no_end(long_strip(0.0, 0.0), 4.0 + kBeside, kAbove);
  expect_no_end(long_strip(0.0, 0.0), -4.0 - kBeside, kAbove);
  for (const double length : {6.0, 6.2, 8.0, 12.0, 14.0})
    expect_no_end(plates(length, 1), 4.0 + kBeside, kAbove);
}
TEST(OverlappingImages, HaveTheRimsOfTriangles) {
  const double slope = std::sqrt(0.5);
  for (const auto& [end, rows] : kLong)
    expect_no_end(channel(end, rows), 4.0 - 0.2 * (kRadius - kPressed) * slope,
                  3.0 + 1.4 * (kRadius - kPressed) * slope);
}
TEST(OverlappingImages, HaveTheLipsOfATrough) {
  for (const double end : {3.0, 3.1, 4.0, 6.0, 7.0})
    expect_no_end(long_trough(2.0, end, 90.0), -2.0 + kAbove, kBeside);
}
// Of a groove in which a ball rests on both, one nearer than the other.
TEST(OverlappingImages, HaveBothLipsOfAGroove) {
  for (const double end : {3.0, 3.1, 4.0, 7.0})
    EXPECT_EQ(
        expect_as_on_longer(long_trough(0.4, end, 90.0), long_trough(0.4, 14.0, 90.0), {-0.9, 0.05, 0.15}),
        2u);
}
TEST(OverlappingImages, HaveTheRimsOfPatches) {
  const double across = std::sqrt(1.25);
  for (const auto& [end, elements] : kLong)
    expect_no_end(ridge(end, elements), 4.0 + (0.8 * 0.5 + 0.6) / across * (kRadius - kPressed),
                  -2.0 + (0.8 - 0.6 * 0.5) / across * (kRadius - kPressed));
}

// Of two that lie one above the other a ball feels both.
TEST(OverlappingImages, OfASlopeCountBesideIt) {
  RigidSurface wall = long_strip(kRise, 0.0);
  Balls balls(3, 1);
  const double up = 1.0 / std::hypot(1.0, kRise), below = kPeriod * kRise * up;
  balls.add(Vector3(2.5, 0.0, 2.5 * kRise) + (kRadius - 0.2) * up * Vector3(-kRise, 0, 1), kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 0; step < 5; ++step) {
    ASSERT_EQ(scene.spring.seen.size(), 2u);
    EXPECT_NEAR(scene.balls.force(0).norm(), 0.2 + (0.2 - below), 1e-12);
    scene.evaluate();
  }
}

// What stands on the end of the floor stands in the box, too.
TEST(OverlappingImages, OfAWallOnTheFloorStandThere) {
  RigidSurface wall = long_strip(0.0, 2.0);
  Balls balls(3, 1);
  balls.add({-2.0 - kRadius + 0.1, 0.3, kRadius - kPressed}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 0; step < 5; ++step) {
    ASSERT_EQ(scene.spring.seen.size(), 2u);
    EXPECT_LT((scene.balls.force(0) - Vector3(-0.1, 0, kPressed)).norm(), 1e-12);
    scene.evaluate();
  }
}

}  // namespace
