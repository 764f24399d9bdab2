// SPDX-License-Identifier: GPL-2.0-or-later
// Every change of a body that a saved state depends on shows in its fingerprint, by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "coupling/iga_structure.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"
#include "standard_linear_solid.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"
#include "wavy_surface.h"

namespace {

using coupling::Fingerprint;
using coupling::Vector3;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A box of an elastic material, by default always the same one.
struct Box {
  Vector3 size{4.0, 4.0, 2.0};
  std::array<int, 3> elements{4, 4, 2};
  std::array<int, 3> degrees{2, 2, 2};
  double E = 5.0, nu = 0.3, density = 7.0;
  bool large_displacements = false;
  double relaxation_time = 0.0;  // none: elastic
  std::vector<nurbs::Face> held{nurbs::Face::zeta_minus};
  structure::Directions directions{true, true, true};
  std::vector<structure::SkinPiece> seen{{0, nurbs::Face::zeta_plus}};
  Vector3 gravity = Vector3::Zero();

  Fingerprint fingerprint() const {
    const auto knots = [&](int d) { return nurbs::KnotVector::uniform(degrees[d], elements[d]); };
    nurbs::Volume patch = nurbs::box({0, 0, 0}, size, {knots(0), knots(1), knots(2)});
    structure::Supports supports;
    for (const nurbs::Face face : held) supports.fix(structure::nodes_on(patch.space, {face}), directions);
    std::shared_ptr<const structure::Material> material;
    if (relaxation_time > 0.0)
      material = std::make_shared<test::StandardLinearSolid>(E, nu, density, 0.5, relaxation_time);
    else if (large_displacements)
      material = std::make_shared<structure::SaintVenantKirchhoff>(E, nu, density);
    else
      material = std::make_shared<structure::LinearElastic>(E, nu, density);
    structure::ExplicitSolver solver(std::make_unique<structure::Solid>(std::move(patch), material),
                                     supports);
    solver.set_load(structure::gravity_load(solver.body(), gravity));
    return coupling::IgaStructure(std::move(solver), seen).fingerprint();
  }
};

std::string change(const Box& now) { return difference(Box().fingerprint(), now.fingerprint()); }

TEST(Fingerprint, KnowsTheMemoryOfTheMaterial) {
  Box then, now;
  then.relaxation_time = now.relaxation_time = 2.0;
  EXPECT_THAT(difference(then.fingerprint(), now.fingerprint()), IsEmpty());
  now.relaxation_time = 3.0;
  EXPECT_THAT(difference(then.fingerprint(), now.fingerprint()),
              testing::HasSubstr("0.5, 3, 18 numbers of memory at a point now"));
  EXPECT_THAT(change(now), testing::HasSubstr("standard_linear_solid"));
}

TEST(Fingerprint, OfTheSameSolidAgrees) {
  EXPECT_THAT(change(Box()), IsEmpty());
  Box loaded;
  loaded.gravity = {0, 0, -9.81};
  EXPECT_THAT(change(loaded), IsEmpty()) << "loads may change";
}

TEST(Fingerprint, NamesTheGeometry) {
  Box wider;
  wider.size[0] = 4.5;
  EXPECT_THAT(change(wider), AllOf(HasSubstr("geometry: 4 x 4 x 2 elements of degree 2 2 2 from [0, 0, 0] to "
                                             "[4, 4, 2] then"),
                                   HasSubstr("[4.5, 4, 2] now"), Not(HasSubstr("material"))));
  Box of_as_many_control_points;  // 6 x 6 x 4, and 4 x 6 x 6
  of_as_many_control_points.elements = {2, 4, 4};
  EXPECT_THAT(change(of_as_many_control_points), HasSubstr("2 x 4 x 4 elements"));
  Box cubic;  // 6 x 6 x 4, too
  cubic.degrees = {3, 2, 2};
  cubic.elements = {3, 4, 2};
  EXPECT_THAT(change(cubic), HasSubstr("degree 3 2 2"));
}

TEST(Fingerprint, NamesTheMaterial) {
  Box stiffer, denser, incompressible, other_law;
  stiffer.E = 6.0;
  denser.density = 7.0 * (1.0 + 1e-9);
  incompressible.nu = 0.49;
  other_law.large_displacements = true;
  EXPECT_THAT(change(stiffer), HasSubstr("material: E = 5, nu = 0.3, density = 7 then, E = 6"));
  EXPECT_THAT(change(denser), HasSubstr("material: "));
  EXPECT_THAT(change(incompressible), HasSubstr("nu = 0.49"));
  EXPECT_EQ(change(other_law), "law of the material: linear_elastic then, saint_venant_kirchhoff now");
}

TEST(Fingerprint, NamesTheSupports) {
  Box free, other_face, other_direction, same_number;
  free.held.clear();
  other_face.held = {nurbs::Face::zeta_plus};  // as many
  EXPECT_THAT(change(free), HasSubstr("supports: 108 fixed degrees of freedom then, 0 fixed"));
  EXPECT_EQ(change(other_face), "supports: 108 fixed degrees of freedom then, of other numbers now");
  other_direction.directions = {true, true, false};
  EXPECT_THAT(change(other_direction), HasSubstr("72 fixed"));
}

TEST(Fingerprint, NamesTheSurface) {
  Box both;
  both.seen = {{0, nurbs::Face::zeta_minus}, {0, nurbs::Face::zeta_plus}};
  EXPECT_EQ(change(both), "surface: zeta+ then, zeta-, zeta+ now");
}

TEST(Fingerprint, OfARigidWallIsItsGeometry) {
  const nurbs::Surface wavy = test::wavy_surface();
  const Fingerprint wall = coupling::RigidSurface({wavy}).fingerprint();
  EXPECT_THAT(difference(wall, coupling::RigidSurface({wavy}).fingerprint()), IsEmpty());
  EXPECT_THAT(difference(wall, coupling::RigidSurface({wavy, wavy}).fingerprint()), HasSubstr("2 patches"));
  EXPECT_THAT(difference(wall, Box().fingerprint()), HasSubstr("material: none then, E = 5"));

  nurbs::Surface moved = wavy;  // one control point, by a millionth of the wall's size
  const int middle = static_cast<int>(moved.control_points.cols()) / 2;
  moved.control_points(1, middle) += 1e-6 * wavy.control_points.cwiseAbs().maxCoeff();
  EXPECT_THAT(difference(wall, coupling::RigidSurface({moved}).fingerprint()), HasSubstr("of other numbers"));

  const auto weighted = [&](const std::vector<double>& weights) {
    const nurbs::Surface surface{nurbs::Space<2>(wavy.space.knots(), weights), wavy.control_points};
    return coupling::RigidSurface({surface}).fingerprint();
  };
  std::vector<double> weights(wavy.control_points.cols(), 1.0);
  EXPECT_THAT(difference(weighted({}), weighted(weights)), IsEmpty()) << "the same surface";
  weights[middle] = 1.1;
  EXPECT_THAT(difference(weighted({}), weighted(weights)), HasSubstr("geometry"));
}

TEST(Fingerprint, OverlooksRoundOff) {
  nurbs::Surface wavy = test::wavy_surface();
  const Fingerprint wall = coupling::RigidSurface({wavy}).fingerprint();
  wavy.control_points *= 1.0 + 2e-16;
  EXPECT_THAT(difference(wall, coupling::RigidSurface({wavy}).fingerprint()), IsEmpty());
}

TEST(Fingerprint, SurvivesItsWayThroughNumbers) {
  const Fingerprint box = Box().fingerprint();
  std::vector<double> numbers = to_numbers(box);
  const Fingerprint back = coupling::fingerprint_from(numbers);
  ASSERT_EQ(back.size(), box.size());
  for (std::size_t p = 0; p < box.size(); ++p) {
    EXPECT_EQ(back[p].name, box[p].name);
    EXPECT_EQ(back[p].text, box[p].text);
    EXPECT_EQ(back[p].numbers, box[p].numbers);
  }
  numbers.pop_back();
  EXPECT_THROW(coupling::fingerprint_from(numbers), std::invalid_argument);
}

TEST(Fingerprint, OfNumbersThatNobodyWroteIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
           {nan}, {-1.0}, {0.5}, {1e300}, {2.0, 'a'}, {1.0, 300.0, 0.0, 0.0}, {0.0, 0.0}}) {
    SCOPED_TRACE(testing::PrintToString(numbers));
    EXPECT_THAT([&] { coupling::fingerprint_from(numbers); },
                testing::ThrowsMessage<std::invalid_argument>(HasSubstr("restart file is damaged")));
  }
}

}  // namespace
