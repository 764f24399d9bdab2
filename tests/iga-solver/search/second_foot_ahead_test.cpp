// SPDX-License-Identifier: GPL-2.0-or-later
// Where no second foot can appear until the next list, against the principal curvatures of simple shapes in
// closed form and the distances of their edges, kinks and poles.
#include "search/multi_patch_projector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"

namespace search {
namespace {

using namespace nurbs;

// A surface, at the moment of a new list; the element by the parameters of a point in it.
class Watched {
 public:
  explicit Watched(PatchedSurface surface)
      : surface_(std::move(surface)), projector_(surface_.topology, surface_.control_points) {
    projector_.begin_list();
  }
  bool excluded(const Vector3& d, double reach, const Parameter<2>& xi, int patch = 0) const {
    const int element =
        surface_.topology.first_element(patch) + surface_.topology.patch(patch).element_at(xi);
    return projector_.excludes_second_foot(d, reach, element);
  }
  void move(const NodalVectors& points, double edge_angle = 0.0) {
    surface_.control_points = points;
    projector_.surface_moved();
    projector_.begin_list(edge_angle);
  }

 private:
  PatchedSurface surface_;
  MultiPatchProjector projector_;
};

std::array<KnotVector, 2> knots(int n, int m) {
  return {KnotVector::uniform(2, n), KnotVector::uniform(2, m)};
}

// Inside a tube of radius R the reach must be below R / 2; outside it bends away, and any reach will do.
TEST(SecondFootAhead, OfATubeEndsAtHalfItsRadius) {
  constexpr double kRadius = 3.0;
  for (const bool inwards : {false, true}) {
    Surface tube = cylinder(frame({0, 0, 0}, {0, 0, 1}), kRadius, 20.0, refined(arc(0, 360), 16, 2),
                            KnotVector::uniform(2, 5));
    if (inwards) {  // the normal points to the axis
      for (Eigen::Index a = 0; a < tube.control_points.cols(); ++a)
        tube.control_points(2, a) = 20.0 - tube.control_points(2, a);
    }
    const Watched subject(join({tube}));
    for (const double xi : {0.03, 0.4}) {
      const Vector3 S = interpolate(tube.space, tube.control_points, {xi, 0.5});
      const Vector3 out(S[0] / kRadius, S[1] / kRadius, 0.0);
      EXPECT_TRUE(subject.excluded(S - 1.0 * out, 0.49 * kRadius, {xi, 0.5}));
      EXPECT_FALSE(subject.excluded(S - 1.0 * out, 0.51 * kRadius, {xi, 0.5}));
      EXPECT_TRUE(subject.excluded(S + 1.0 * out, 2.0 * kRadius, {xi, 0.5}));
      // Beside the element neither side is the clear one: the stronger curvature counts.
      EXPECT_FALSE(subject.excluded(S + Vector3(0, 0, 5.0), 0.51 * kRadius, {xi, 0.5}));
    }
  }
}

// On a torus both curvatures have their say: that of the tube outwards of its inner side, of the ring there.
TEST(SecondFootAhead, OfATorus) {
  constexpr double kRing = 4.0, kTube = 1.0;
  const Surface torus = nurbs::torus(frame({0, 0, 0}, {0, 0, 1}), kRing, kTube, refined(arc(0, 360), 32, 2),
                                     refined(arc(0, 360), 32, 2));
  const Watched subject(join({torus}));
  const Parameter<2> inner{0.01, 0.51};
  const Vector3 S = interpolate(torus.space, torus.control_points, inner);
  const double rho = std::hypot(S[0], S[1]);
  const Vector3 out = Vector3(S[0], S[1], 0.0) / rho;
  // Towards the axis the ring bends to the point, with 1 / rho (rho = 3, and a little more off the middle).
  EXPECT_TRUE(subject.excluded(S - 0.5 * out, 0.49 * (kRing - kTube), inner));
  EXPECT_FALSE(subject.excluded(S - 0.5 * out, 0.53 * (kRing - kTube), inner));
  // Inside the tube, the tube.
  EXPECT_TRUE(subject.excluded(S + 0.3 * out, 0.49 * kTube, inner));
  EXPECT_FALSE(subject.excluded(S + 0.3 * out, 0.51 * kTube, inner));
}

// A cylinder whose parameters are sheared along its axis has the same curvatures, and is as regular.
TEST(SecondFootAhead, OfShearedParametersIsThatOfTheShape) {
  const Surface straight =
      cylinder(frame({0, 0, 0}, {0, 0, 1}), 3.0, 20.0, refined(arc(0, 180), 8, 2), KnotVector::uniform(2, 5));
  Surface sheared = straight;
  const int n = straight.space.control_point_count(0);
  for (int a = 0; a < straight.control_points.cols(); ++a) sheared.control_points(2, a) += 1.5 * (a % n);
  Watched subject(join({straight}));
  for (const NodalVectors& points :
       {straight.control_points, sheared.control_points, straight.control_points}) {
    subject.move(points);
    const Parameter<2> xi{0.55, 0.5};
    const Vector3 S = interpolate(straight.space, points, xi), out = Vector3(S[0], S[1], 0.0) / 3.0;
    EXPECT_TRUE(subject.excluded(S - out, 0.49 * 3.0, xi));
    EXPECT_FALSE(subject.excluded(S - out, 0.52 * 3.0, xi));
  }
}

// Free edges, and the seams of patches that meet at an angle, are not regular within reach of them; welds
// that are smooth are no matter.
TEST(SecondFootAhead, EndsAtEdgesAndKinks) {
  const Surface left = plane({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, knots(4, 4));
  for (const double slope : {0.0, 0.01, 1.0}) {
    const Surface right = plane({4, 0, 0}, {4, 0, 4 * slope}, {0, 4, 0}, knots(4, 4));
    for (const bool welded : {true, false}) {
      const Watched subject(
          welded ? join({left, right})
                 : PatchedSurface{MultiPatch({left.space, right.space}), join({left, right}).control_points});
      const Vector3 d(3.3, 1.5, 0.1);  // 0.7 from the seam, 1.5 from the edge y = 0
      EXPECT_TRUE(subject.excluded(d, 0.69, {0.8, 0.4}));
      EXPECT_EQ(subject.excluded(d, 0.72, {0.8, 0.4}), welded && slope == 0.0);
      EXPECT_TRUE(subject.excluded(d, 3.0, {0.6, 0.4})) << "an element that has no such side";
    }
    const Watched subject(join({left, right}));
    const Vector3 low(1.5, 0.5, 0.1);  // above an element on the edge y = 0
    EXPECT_TRUE(subject.excluded(low, 0.5, {0.4, 0.1}));
    EXPECT_FALSE(subject.excluded(low, 0.52, {0.4, 0.1}));
    const Vector3 high(1.5, 3.5, 0.1);
    EXPECT_TRUE(subject.excluded(high, 0.5, {0.4, 0.9}));
    EXPECT_FALSE(subject.excluded(high, 0.52, {0.4, 0.9}));
  }
}

// A C0 line inside a patch is a kink only while the sheet is bent there: the shape changes from step to step.
TEST(SecondFootAhead, OfACreaseChangesWithTheShape) {
  const Surface sheet = insert_knot(plane({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, knots(4, 4)), 0, 0.5, 1);
  Watched subject(join({sheet}));
  NodalVectors bent = sheet.control_points;
  for (Eigen::Index a = 0; a < bent.cols(); ++a) bent(2, a) = std::max(0.0, bent(0, a) - 2.0);
  NodalVectors folded = sheet.control_points;  // flat, back on itself
  for (Eigen::Index a = 0; a < bent.cols(); ++a) folded(0, a) = 2.0 - std::abs(folded(0, a) - 2.0);
  const Vector3 d(1.5, 1.5, 0.1);  // 0.5 from the crease at x = 2
  for (int turn = 0; turn < 3; ++turn) {
    subject.move(sheet.control_points);
    EXPECT_TRUE(subject.excluded(d, 1.2, {0.4, 0.4}));
    subject.move(bent);
    EXPECT_FALSE(subject.excluded(d, 1.2, {0.4, 0.4}));
    EXPECT_TRUE(subject.excluded(d, 0.49, {0.4, 0.4}));
    EXPECT_FALSE(subject.excluded({2.5, 1.5, 0.4}, 1.2, {0.6, 0.4})) << "from the other side";
    subject.move(folded);
    EXPECT_FALSE(subject.excluded(d, 1.2, {0.4, 0.4}));
  }
}

// A weld keeps places alone: two patches that were flat, or one with a crease, are bent there by their loads,
// and are smooth as long as they turn by less than the edge angle.
TEST(SecondFootAhead, OfAWeldAndACreaseEndsWhereTheyTurnByTheEdgeAngle) {
  const Surface left = plane({0, 0, 0}, {2, 0, 0}, {0, 4, 0}, knots(2, 4)),
                right = plane({2, 0, 0}, {2, 0, 0}, {0, 4, 0}, knots(2, 4)),
                creased = insert_knot(plane({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, knots(4, 4)), 0, 0.5, 1),
                turned = plane({4, 4, 0}, {0, -4, 0}, {-2, 0, 0}, knots(4, 2));  // right, otherwise numbered
  const Vector3 d(1.5, 1.5, 0.1);
  for (const std::vector<Surface>& sheet : {std::vector<Surface>{left, right}, {creased}, {left, turned}}) {
    const PatchedSurface flat = join(sheet);
    const double middle = sheet.size() == 1 ? 0.4 : 0.8;
    Watched subject(flat);
    EXPECT_TRUE(subject.excluded(d, 1.2, {middle, 0.4}));
    for (const double angle : {0.019, -0.019, 0.021, -0.021, 0.0}) {
      NodalVectors bent = flat.control_points;
      for (Eigen::Index a = 0; a < bent.cols(); ++a)
        bent(2, a) = std::tan(angle) * std::max(0.0, bent(0, a) - 2.0);
      subject.move(bent, 0.02);
      EXPECT_EQ(subject.excluded(d, 1.2, {middle, 0.4}), std::abs(angle) < 0.02) << angle;
      subject.move(bent);
      EXPECT_EQ(subject.excluded(d, 1.2, {middle, 0.4}), angle == 0.0) << angle;
    }
  }
}

// A sheet rolled up tighter and unrolled: curvatures and the places of edges follow.
TEST(SecondFootAhead, FollowsAChangingShape) {
  const Surface sheet = plane({-1, 0, 0}, {2, 0, 0}, {0, 4, 0}, knots(16, 4));
  Watched subject(join({sheet}));
  const std::vector<double> u = sheet.space.knots(0).greville();
  for (const double radius : {10.0, 1.0, 3.0, 0.7, 100.0}) {
    // Nearly a circle about (0, y, radius): control points on it.
    NodalVectors points = sheet.control_points;
    for (Eigen::Index a = 0; a < points.cols(); ++a) {
      const double angle = (2.0 * u[a % u.size()] - 1.0) / radius;
      points(0, a) = radius * std::sin(angle);
      points(2, a) = radius * (1.0 - std::cos(angle));
    }
    subject.move(points);
    const Vector3 above(0.01, 1.5, 0.1);
    EXPECT_TRUE(subject.excluded(above, std::min(0.45 * radius, 1.4), {0.51, 0.4})) << radius;
    EXPECT_EQ(subject.excluded(above, std::min(0.55 * radius, 1.4), {0.51, 0.4}), radius > 2.6) << radius;
    const Vector3 end = interpolate(sheet.space, points, {0.99, 0.4});
    EXPECT_FALSE(subject.excluded(end, 0.1, {0.99, 0.4})) << radius;
  }
}

TEST(SecondFootAhead, EndsAtAPole) {
  const Surface dome =
      sphere(frame({0, 0, 0}, {0, 0, 1}), 5.0, refined(arc(0, 360), 8, 2), refined(arc(0, 90), 8, 2));
  const Watched subject(join({dome}));
  const Vector3 d(0.5, 0.0, 5.4);  // outside, where the dome bends away
  EXPECT_TRUE(subject.excluded(d, 0.55, {0.01, 0.99}));
  EXPECT_FALSE(subject.excluded(d, 0.70, {0.01, 0.99}));
  EXPECT_TRUE(subject.excluded({0.6, 0.0, 6.0}, 0.55, {0.01, 0.8})) << "the next element has no pole";
}

}  // namespace
}  // namespace search
