// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a body that is strained: elements are longer or shorter then, and give way otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "models.h"
#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "top.h"

namespace {

using models::Matrix3;
using nurbs::NodalVectors;
using nurbs::Parameter;
using nurbs::Vector3;
using structure::ComplianceTable;
using structure::ComplianceTables;
using structure::Material;
using structure::ReferenceBody;
using top::Top;

constexpr int kCubes = 7, kLayers = 4;

std::shared_ptr<const Material> neo_hooke() {
  for (const auto& law : models::large_strain_laws())
    if (law->law() == std::string("neo_hooke")) return law;
  throw std::logic_error("no such law");
}

nurbs::Volume block_of_cubes(int finer = 1) {
  return models::block({kCubes, kCubes, kLayers}, {finer * kCubes, finer * kCubes, finer * kLayers}, 2);
}
ReferenceBody hyperelastic(const nurbs::Volume& patch, const std::shared_ptr<const Material>& law) {
  return {{patch}, {law}, structure::without_welds({patch}), structure::Quadrature::full};
}
const ReferenceBody& soft_block() {
  static const ReferenceBody body = hyperelastic(block_of_cubes(), neo_hooke());
  return body;
}
NodalVectors moved(const Matrix3& F, const NodalVectors& X) { return models::linear_field(F, X); }
const NodalVectors& undeformed() { return soft_block().patches[0].control_points; }
ReferenceBody standing_at(const NodalVectors& places) {
  ReferenceBody body = soft_block();
  body.patches[0].control_points = places;
  return body;
}
Matrix3 stretch(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

const Top kSkin{soft_block()};
int element(int i, int j) { return i + kCubes * j; }
Parameter<2> centre_of(int e) { return kSkin.space.element_centre(e); }

/// All that a table says at some points of an element.
std::vector<double> told(ComplianceTables& tables, int e) {
  std::vector<double> all;
  const Parameter<2> centre = centre_of(e);
  for (const auto component : {ComplianceTable::normal, ComplianceTable::first, ComplianceTable::second,
                               ComplianceTable::first_second})
    for (const double way : {-0.45, 0.0, 0.3}) {
      const Parameter<2> xi = {centre[0] + way / kCubes, centre[1] - 0.7 * way / kCubes};
      const ComplianceTable::Value value = top::value(tables, kSkin.space, 0, e, xi, component);
      all.insert(all.end(), {value.c, value.change[0], value.change[1]});
    }
  return all;
}
void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << k;
}

/// The give of a foot under a unit force, about a body that is stretched: by what changes of its own internal
/// forces do, with its base held.
double give_when_strained(const nurbs::Volume& patch, const Matrix3& F, const Parameter<2>& xi) {
  const structure::Solid solid(patch, neo_hooke(), {structure::Quadrature::full});
  const NodalVectors& X = patch.control_points;
  const NodalVectors u0 = models::linear_field(F - Matrix3::Identity(), X),
                     load = point_force::unit_force(hyperelastic(patch, neo_hooke()), xi);
  NodalVectors free = NodalVectors::Ones(3, X.cols());
  for (Eigen::Index a = 0; a < X.cols(); ++a)
    if (X(2, a) < 1e-9) free.col(a).setZero();
  NodalVectors before = load;
  const NodalVectors u = point_force::solved(load, free, 1e-6, [&](const NodalVectors& d, NodalVectors& q) {
    const double small = 1e-5 / d.lpNorm<Eigen::Infinity>();
    solid.internal_force(u0 + small * d, q);
    solid.internal_force(u0 - small * d, before);
    q = (q - before) / (2.0 * small);
  });
  return u.cwiseProduct(load).sum();
}

/// By how much it must be stretched along z so that its top has no load.
double free_stretch(double x, double y) {
  double low = 0.5, high = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (neo_hooke()->stress(stretch(x, y, z) - Matrix3::Identity(), nullptr)(2, 2) > 0.0 ? high : low) = z;
  }
  return low;
}

// c is as one over the size of elements, so meshes of one and of a third differ by -2 c, whatever the body.
TEST(StrainedCompliance, IsWhatMeshesOfTheStrainedBodyDifferBy) {
  const Parameter<2> corner = {3.0 / kCubes, 3.0 / kCubes};
  for (const auto& [x, y] : {std::pair(1.2, 1.2), std::pair(1.2, 1.0), std::pair(0.9, 1.0)}) {
    const Matrix3 F = stretch(x, y, free_stretch(x, y));
    const double c = 0.5 * (give_when_strained(block_of_cubes(3), F, corner) -
                            give_when_strained(block_of_cubes(), F, corner));
    ComplianceTables tables(soft_block(), point_force::kTop);
    const double before = kSkin.table(tables, corner);
    EXPECT_GT(std::abs(before / c - 1.0), 0.04) << x << ' ' << y;
    EXPECT_TRUE(tables.follow(moved(F, undeformed()), {}));
    EXPECT_NEAR(kSkin.table(tables, corner) / c, 1.0, 0.015) << x << ' ' << y;
  }
}

TEST(StrainedCompliance, IsThatOfABodyWhichIsLikeThatFromTheBeginning) {
  const NodalVectors now = moved(stretch(1.3, 0.9, 1.1), undeformed());
  ComplianceTables tables(soft_block(), point_force::kTop), other(standing_at(now), point_force::kTop);
  EXPECT_TRUE(tables.follow(now, {}));
  for (const int e : {element(0, 0), element(3, 3), element(6, 2)})
    expect_near(told(tables, e), told(other, e), 0.0);
  EXPECT_FALSE(tables.follow(now, {})) << "nothing has changed since then";
}

TEST(StrainedCompliance, StaysBelowFivePerCentAndComesBack) {
  ComplianceTables tables(soft_block(), point_force::kTop);
  const int e = element(3, 3);
  const std::vector<double> before = told(tables, e);
  EXPECT_FALSE(tables.follow(moved(stretch(1.049, 1.0 / 1.049, 1.0), undeformed()), {}));
  expect_near(told(tables, e), before, 0.0);
  EXPECT_TRUE(tables.follow(moved(stretch(1.06, 1.06, 1.0), undeformed()), {}));
  EXPECT_GT(std::abs(told(tables, e)[0] / before[0] - 1.0), 0.01);
  const int solved = tables.solved();
  EXPECT_TRUE(tables.follow(moved(stretch(1.005, 1.005, 1.0), undeformed()), {}));
  expect_near(told(tables, e), before, 0.0);
  EXPECT_EQ(tables.solved(), solved) << "the tables of the undeformed body are kept";
}

// A ball keeps the table that it is on; beside it two states of the body meet, which are turned to each
// other.
TEST(StrainedCompliance, DoesNotJumpWhereItIsTouchedNorAtBorders) {
  const Matrix3 turn = Eigen::AngleAxisd(1.0, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  ComplianceTables tables(soft_block(), point_force::kTop);
  const int touched = element(1, 3), changed = element(4, 3), beside = element(3, 3);
  const std::vector<double> before = told(tables, touched);
  told(tables, beside);  // which stays, too, but has points in common with one that does not
  EXPECT_TRUE(tables.follow(moved(turn * stretch(1.2, 1.2, 0.9), undeformed()), {{0, touched}}));
  expect_near(told(tables, touched), before, 0.0);
  for (const auto component :
       {ComplianceTable::normal, ComplianceTable::first, ComplianceTable::first_second})
    for (const double y : {0.0, 0.2, 0.5, 0.9}) {
      const Parameter<2> border = {4.0 / kCubes, (3.0 + y) / kCubes};
      EXPECT_NEAR(top::value(tables, kSkin.space, 0, changed, border, component).c,
                  top::value(tables, kSkin.space, 0, beside, border, component).c, 1e-12)
          << y;
    }
  const double far =
      top::value(tables, kSkin.space, 0, element(6, 6), centre_of(element(6, 6)), ComplianceTable::normal).c;
  EXPECT_TRUE(tables.follow(moved(turn * stretch(1.2, 1.2, 0.9), undeformed()), {}));
  EXPECT_NEAR(told(tables, touched)[0] / before[0], 1.0 / 1.2, 0.06) << "and changes when it is left";
  EXPECT_EQ(
      top::value(tables, kSkin.space, 0, element(6, 6), centre_of(element(6, 6)), ComplianceTable::normal).c,
      far);
}

TEST(StrainedCompliance, DoesNotHangOnHowTheBodyIsTurned) {
  const Matrix3 F = stretch(1.2, 1.1, 0.9),
                turn = Eigen::AngleAxisd(2.0, Vector3(3, 1, 2).normalized()).toRotationMatrix();
  ComplianceTables straight(soft_block(), point_force::kTop), turned(soft_block(), point_force::kTop);
  straight.follow(moved(F, undeformed()), {{0, element(1, 1)}});
  turned.follow(moved(turn * F, undeformed()), {{0, element(1, 1)}});
  for (const int e : {element(1, 1), element(2, 1), element(3, 3)})
    expect_near(told(turned, e), told(straight, e), 1e-8);
}

TEST(StrainedCompliance, IsSavedWithItsStates) {
  ComplianceTables tables(soft_block(), point_force::kTop), other(soft_block(), point_force::kTop);
  EXPECT_TRUE(tables.save().empty());
  tables.follow(moved(stretch(1.2, 1.2, 0.9), undeformed()), {{0, element(1, 1)}});
  tables.follow(moved(stretch(1.3, 1.2, 0.9), undeformed()), {{0, element(5, 5)}});
  other.follow(moved(stretch(0.8, 1.0, 1.0), undeformed()), {});
  told(other, element(3, 3));
  other.load(tables.save());
  for (int e = 0; e < kCubes * kCubes; e += 8) expect_near(told(other, e), told(tables, e), 0.0);
  EXPECT_EQ(other.save(), tables.save());
  other.load({});
  ComplianceTables anew(soft_block(), point_force::kTop);
  expect_near(told(other, element(3, 3)), told(anew, element(3, 3)), 0.0);
  std::vector<double> cut = tables.save(), beyond = cut;
  cut.pop_back();
  EXPECT_THROW(other.load(cut), std::invalid_argument);
  beyond.back() = 3.0;
  EXPECT_THROW(other.load(beyond), std::invalid_argument);
}

TEST(StrainedCompliance, IsForLawsOfLargeStrain) {
  EXPECT_TRUE(ComplianceTables(soft_block(), point_force::kTop).follows_strain());
  EXPECT_FALSE(ComplianceTables(hyperelastic(block_of_cubes(), models::elastic()), point_force::kTop)
                   .follows_strain());
}

}  // namespace
