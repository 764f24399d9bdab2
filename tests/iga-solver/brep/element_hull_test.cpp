// SPDX-License-Identifier: GPL-2.0-or-later
// What encloses an element of a patch of a high degree: all of it, and little more.
#include "brep/element_hull.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "brep/patch_faces.h"
#include "nurbs/primitives.h"

namespace brep {
namespace {

constexpr double kRing = 3.0, kTube = 1.0;

// A part of a torus, turned, of degree 2 x 14, as fillets have.
nurbs::Surface fillet() {
  const nurbs::Frame at = nurbs::frame({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0});
  return nurbs::torus(at, kRing, kTube, nurbs::arc(0.0, 90.0),
                      nurbs::refined(nurbs::arc(100.0, 170.0), 1, 14));
}

// f(number, its hull, S at places of it) of each element.
template <class Function>
void for_elements(const PatchFaces& faces, Function f) {
  constexpr int kSteps = 8;
  const nurbs::Surface& patch = faces.patch(0);
  for (int e = 0; e < patch.space.element_count(); ++e) {
    const nurbs::Indices<2> at = patch.space.element_indices(e);
    std::vector<Vector3> points;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const int step[2] = {i, j};
        Parameter<2> xi;
        for (int k = 0; k < 2; ++k) {
          const double* knot = &patch.space.knots(k).breaks()[at[k]];
          xi[k] = knot[0] + (knot[1] - knot[0]) * step[k] / kSteps;
        }
        points.push_back(faces.point(0, xi));
      }
    f(e, faces.hull(0, e), points);
  }
}

TEST(ElementHull, HoldsItsElement) {
  const PatchFaces faces({fillet()}, 0.0);
  ASSERT_GE(faces.patch(0).space.element_count(), 256);
  for_elements(faces, [](int e, const ElementHull& hull, const std::vector<Vector3>& points) {
    for (const Vector3& S : points) {
      EXPECT_EQ(hull.squared_distance(S), 0.0) << e;
      EXPECT_EQ(hull.box().squared_distance(S), 0.0) << e;
      EXPECT_LE((S - hull.centre()).norm(), hull.radius()) << e;
    }
  });
}

// Tangents of an arc meet above it as far, nearly, as its chord is below it: the hull is twice that thick at
// most along each of two directions.
TEST(ElementHull, IsAsThinAsItsElementIsBent) {
  const PatchFaces faces({fillet()}, 0.0);
  const double turns[2] = {90.0 / 16.0, 70.0 / 16.0}, radii[2] = {kRing, kTube};
  double thickness = 0.0, longest = 0.0;
  for (int k = 0; k < 2; ++k) {
    const double most = 2.0 * turns[k] * nurbs::kPi / 180.0;  // rational arcs run at uneven speed
    thickness += radii[k] * (1.0 / std::cos(0.5 * most) - std::cos(0.5 * most));
    longest = std::max(longest, radii[k] * most);
  }
  for_elements(faces, [&](int e, const ElementHull& hull, const std::vector<Vector3>& points) {
    const Vector3 normal = faces.normal(0, faces.patch(0).space.element_centre(e));
    const Vector3 &middle = points[points.size() / 2], way = points.front() - points.back();
    EXPECT_GE(std::sqrt(hull.squared_distance(middle + longest * normal)), longest - thickness) << e;
    EXPECT_GE(std::sqrt(hull.squared_distance(middle - longest * normal)), longest - thickness) << e;
    EXPECT_LE(hull.radius(), 0.6 * way.norm()) << e;
  });
}

TEST(ElementHull, IsNeverFartherThanItsElement) {
  const PatchFaces faces({fillet()}, 0.0);
  for_elements(faces, [&](int e, const ElementHull& hull, const std::vector<Vector3>& points) {
    for (int k = 0; k < 20; ++k) {
      const Vector3 d =
          hull.centre() + 0.7 * Vector3(std::sin(e + k), std::cos(3.0 * e + k), std::sin(2.0 * k));
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3& S : points) least = std::min(least, (S - d).norm());
      EXPECT_LE(std::sqrt(hull.squared_distance(d)), least) << e;
      EXPECT_LE(std::sqrt(hull.box().squared_distance(d)), least) << e;
    }
  });
}

// At a pole there may be no normal.
TEST(ElementHull, HasAxesWhereThereIsNoNormal) {
  const nurbs::Surface patch = fillet();
  for (const Vector3& none : {Vector3(0.0, 0.0, 0.0), Vector3(NAN, 0.0, 0.0)}) {
    const ElementHull hull(patch, 0, none);
    EXPECT_EQ(hull.squared_distance(nurbs::interpolate(patch.space, patch.control_points, {0.5, 0.5})), 0.0);
    EXPECT_TRUE(hull.centre().allFinite());
  }
}

}  // namespace
}  // namespace brep
