// SPDX-License-Identifier: GPL-2.0-or-later
// Patches as faces in closed form: feet, parameters and sides against the search on NURBS.
#include "brep/closed_form.h"
#include "brep/faced_patches.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <random>

#include "brep/foot_search.h"
#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "search/surface_projector.h"
#include "trials.h"

namespace brep {
namespace {

using nurbs::KnotVector;
using nurbs::Surface;

nurbs::Curve arc(double from, double to) { return nurbs::refined(nurbs::arc(from, to), 12, 3); }

nurbs::Frame place() { return nurbs::frame({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0}); }
KnotVector along() { return KnotVector::from_breaks(2, {0.0, 0.1, 0.7, 1.0}); }

Surface turned_over(Surface patch) {  // by the same control points, eta backwards
  const int rows = patch.space.knots(1).control_point_count(),
            row = patch.space.knots(0).control_point_count();
  for (int j = 0; j < rows / 2; ++j)
    for (int i = 0; i < row; ++i)
      patch.control_points.col(i + row * j).swap(patch.control_points.col(i + row * (rows - 1 - j)));
  return patch;
}

struct Case {
  const char* name;
  Kind kind;
  Surface patch;
};

std::vector<Case> cases() {
  const nurbs::Frame at = place();
  const Vector3 x = at.axes.col(0), y = at.axes.col(1);
  return {
      {"plane", Kind::plane,
       nurbs::plane(at.origin, 2.0 * x, -0.7 * y, {along(), KnotVector::uniform(3, 5)})},
      {"pipe", Kind::cylinder, nurbs::cylinder(at, 0.6, 1.5, arc(0, 360), along())},
      {"trough", Kind::cylinder, nurbs::cylinder(at, 0.6, 1.5, arc(-200, -100), along())},
      {"pipe inside out", Kind::cylinder,
       turned_over(nurbs::cylinder(at, 0.6, 1.5, arc(10, 200), KnotVector::uniform(2, 3)))},
      {"hopper", Kind::cone, nurbs::cone(at, {0.2, 0.9}, 1.1, arc(0, 360), along())},
      {"funnel", Kind::cone, nurbs::cone(at, {0.9, 0.2}, 0.4, arc(30, 170), along())},
      {"tip", Kind::cone, nurbs::cone(at, {0.9, 0.0}, 1.0, arc(0, 360), along())},
      {"ball", Kind::sphere, nurbs::sphere(at, 0.8, arc(0, 360), arc(-90, 90))},
      {"bowl", Kind::sphere, nurbs::sphere(at, 0.8, arc(0, 360), arc(-90, -20))},
      {"shell", Kind::sphere, nurbs::sphere(at, 0.8, arc(20, 130), arc(-50, 40))},
      {"ring", Kind::torus, nurbs::torus(at, 1.0, 0.3, arc(0, 360), arc(0, 360))},
      {"bend", Kind::torus, nurbs::torus(at, 1.0, 0.3, arc(0, 90), arc(-45, 200))},
  };
}

class Closed : public testing::TestWithParam<int> {
 protected:
  const Case case_ = cases()[GetParam()];
  const nurbs::Surface& patch_ = case_.patch;
  const std::optional<FacedPatches> forms_ = closed_forms({patch_}, 0.02);

  Vector3 random_point(std::mt19937& random, double most) const {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double u = uniform(random), v = uniform(random), length = most * uniform(random);
    return nurbs::interpolate(patch_.space, patch_.control_points, {u, v}) +
           length * trials::random_direction(random);
  }
};

TEST_P(Closed, FeetAreThoseOnThePatch) {
  ASSERT_TRUE(forms_) << case_.name;
  const brep::Surface& surface = forms_->surface;
  EXPECT_EQ(surface.faces[0].kind, case_.kind) << case_.name;
  const search::SurfaceProjector projector(patch_.space, patch_.control_points);
  const FootSearch search(surface);
  int insides = 0;
  std::mt19937 random(7);
  for (int k = 0; k < 300; ++k) {
    const Vector3 d = random_point(random, 0.25);
    const search::Foot expected = projector.cold(d);
    std::vector<Foot> found;
    for (const Foot& foot : trials::feet(surface, d, 0.5))
      if (found.empty() || foot.distance < found[0].distance) found.assign(1, foot);
    ASSERT_EQ(found.size(), 1u) << case_.name;
    EXPECT_NEAR(found[0].distance, expected.distance, 1e-12) << case_.name << " " << d.transpose();
    EXPECT_LT((found[0].point - expected.point).norm(), 1e-9) << case_.name << " " << d.transpose();
    const nurbs::Parameter<2> xi = forms_->charts[0].to_patch(found[0].xi);
    EXPECT_LT((nurbs::interpolate(patch_.space, patch_.control_points, xi) - found[0].point).norm(), 1e-12)
        << case_.name;
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(forms_->charts[0].to_face(xi)[i], found[0].xi[i], 1e-12) << case_.name;
    search::Foot inside;
    if (found[0].status != FootStatus::interior) continue;
    if (const PlaneTriangle& triangle = search.triangle(0); triangle.exists()) {
      const OverTriangle at = triangle.over(d);
      for (int i = 0; i < 2; ++i)
        inside.xi[i] = at.xi[i] * forms_->charts[0].line[i].scale() + forms_->charts[0].line[i].shift();
      inside.point = d - at.height * at.normal;
      inside.distance = std::abs(at.height);
    } else {
      ASSERT_NE(search.foot_inside_curved(0, d, 0.5, &forms_->charts, inside), 0) << case_.name;
    }
    ++insides;
    EXPECT_LT((inside.point - expected.point).norm(), 1e-9) << case_.name << " " << d.transpose();
    EXPECT_NEAR(inside.distance, expected.distance, 1e-12);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(inside.xi[i], xi[i], 1e-9) << case_.name << " " << d.transpose();
  }
  EXPECT_GT(insides, 50) << case_.name;
}

TEST_P(Closed, NormalsAndCurvaturesAreThoseOfThePatch) {
  ASSERT_TRUE(forms_) << case_.name;
  const Face& face = forms_->surface.faces[0];
  const Chart& chart = forms_->charts[0];
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  for (int k = 0; k < 100; ++k) {
    const double u = uniform(random), v = uniform(random);
    const nurbs::SurfaceShape shape = nurbs::shape_near(patch_.space, patch_.control_points, {u, v});
    const Parameter<2> xi = chart.to_face({u, v}), of_face = face.curvatures(xi);
    EXPECT_LT((chart.side * face.normal(xi) - shape.normal).norm(), 1e-11) << case_.name;
    const double k0 = chart.side * of_face[0], k1 = chart.side * of_face[1];
    EXPECT_NEAR(std::min(k0, k1), shape.curvature[0], 1e-6) << case_.name;
    EXPECT_NEAR(std::max(k0, k1), shape.curvature[1], 1e-6) << case_.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Closed, testing::Range(0, 12));

TEST(ClosedForm, OthersHaveNone) {
  const nurbs::Frame at = place();
  const Vector3 x = at.axes.col(0), y = at.axes.col(1);
  const KnotVector knots = KnotVector::uniform(2, 3);
  EXPECT_FALSE(closed_form(nurbs::plane(at.origin, x, y + 1e-6 * x, {knots, knots}))) << "skew";
  Surface pipe = nurbs::cylinder(at, 0.6, 1.5, arc(0, 360), knots);
  Surface ellipse = pipe;
  ellipse.control_points.row(0) *= 1.0 + 1e-9;
  EXPECT_FALSE(closed_form(ellipse));
  Surface dented = pipe;
  dented.control_points(2, 40) += 1e-9;
  EXPECT_FALSE(closed_form(dented));
  nurbs::Curve lemon = arc(-40, 40);  // an arc about a point beyond the axis
  lemon.control_points.row(2) = lemon.control_points.row(1);
  lemon.control_points.row(1).setZero();
  lemon.control_points.row(0).array() -= 0.3;
  EXPECT_FALSE(closed_form(nurbs::revolve(lemon, arc(0, 360), at)));
  EXPECT_FALSE(closed_forms({pipe, ellipse}, 0.02)) << "one of two";
}

// Where a pipe goes on as a cone, their border is one edge, and two walls one sheet outside.
TEST(ClosedForm, NeighboursShareTheirBorder) {
  const nurbs::Frame at = place();
  const KnotVector knots = KnotVector::uniform(2, 3);
  nurbs::Frame below = at;
  below.origin -= 0.4 * at.axes.col(2);
  const auto forms = closed_forms({nurbs::cylinder(at, 0.6, 1.5, arc(0, 360), knots),
                                   nurbs::cone(below, {0.2, 0.6}, 0.4, arc(0, 360), knots)},
                                  0.02);
  ASSERT_TRUE(forms);
  EXPECT_EQ(forms->surface.edges.size(), 3u);
  EXPECT_EQ(forms->surface.sheet(0, 1), forms->surface.sheet(1, 1));
}

}  // namespace
}  // namespace brep
