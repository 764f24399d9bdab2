// SPDX-License-Identifier: GPL-2.0-or-later
// Elements that turn or fold are seen, and no others.
#include "structure/time/element_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "models.h"
#include "structure/material/viscous.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::Matrix3;
using models::NodalVectors;
using models::Vector3;
using structure::Diverged;
using structure::ElementWatch;
using structure::ExplicitSolver;
using structure::Solid;
using testing::AllOf;
using testing::HasSubstr;

const double kDegree = std::acos(-1.0) / 180.0;

NodalVectors turned(const NodalVectors& X, double degrees) {
  const Matrix3 R = Eigen::AngleAxisd(degrees * kDegree, Vector3(1, 2, -2).normalized()).toRotationMatrix();
  return models::linear_field(R - Matrix3::Identity(), X);
}

std::shared_ptr<const structure::Material> saint_venant_kirchhoff() {
  return std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.3, 1.0);
}

double smallest_ratio(const Solid& solid, const NodalVectors& u) {
  double least = 1.0;
  std::vector<double> values(3 * std::size_t(solid.padded_functions(0)));
  for (int e = 0; e < solid.element_count(); ++e) {
    solid.gather(e, u, values.data());
    least = std::min(least, solid.smallest_volume_ratio(e, values.data()));
  }
  return least;
}

TEST(ElementWatch, SeesALinearLawTurnByMoreThanThreeDegrees) {
  const auto viscous = std::make_shared<structure::Viscous>(models::elastic(), 0.1);
  for (const std::shared_ptr<const structure::Material>& law : {models::elastic(), {viscous}}) {
    const Solid solid(models::distorted(models::block({3, 1, 0.2}, {3, 2, 1}, 2), 0.05), law);
    for (const double degrees : {2.99, 3.01, 170.0}) {
      ElementWatch watch;
      watch.look_at_all(solid, turned(solid.reference(), degrees));
      ASSERT_EQ(watch.turned().has_value(), degrees > 3.0);
      if (degrees > 3.0) {
        EXPECT_NEAR(watch.turned()->value, degrees, 1e-9 * degrees);
      }
    }
  }
}

TEST(ElementWatch, LetsOtherLawsTurn) {
  for (const auto& law : models::large_strain_laws()) {
    const Solid solid(models::block({2, 1, 1}, {2, 1, 1}, 2), law);
    ElementWatch watch;
    watch.look_at_all(solid, turned(solid.reference(), 100.0));
    EXPECT_FALSE(watch.turned());
    EXPECT_FALSE(watch.folded());
  }
}

// What is inside out has no rotation: told as 180 degrees it reads as if another law would do.
TEST(ElementWatch, TellsALinearLawsElementThatIsInsideOutFromOneThatTurns) {
  ExplicitSolver solver(std::make_unique<Solid>(models::block({1, 1, 1}, {2, 2, 2}, 2), models::elastic()),
                        {});
  NodalVectors u = solver.body().reference();
  u.topRows(2).setZero();
  models::set_displacements(solver, -1.5 * u);
  solver.look_at_elements();
  EXPECT_THAT(solver.take_warning(), AllOf(HasSubstr("element 0 (spans 0, 0, 0"), HasSubstr("is inside out"),
                                           HasSubstr("linear_elastic"), Not(HasSubstr("turned"))));
}

// The quadrature points are asked only where there is room for a fold: that must never hide one.
TEST(ElementWatch, SeesExactlyTheFieldsThatFoldAnElement) {
  int folded = 0, rounds = 0;
  for (const int degree : {2, 3}) {
    const Solid solid(models::distorted(models::block({2, 2, 1}, {2, 2, 1}, degree), 0.05),
                      saint_venant_kirchhoff());
    for (unsigned seed = 1; seed <= 100; ++seed, ++rounds) {
      const NodalVectors u = turned(solid.reference(), 3.0 * seed) +
                             0.008 * seed * models::random_vectors(solid.node_count(), seed);
      ElementWatch watch;
      watch.look_at_all(solid, u);
      EXPECT_EQ(watch.folded().has_value(), smallest_ratio(solid, u) <= 0.0) << seed;
      folded += watch.folded().has_value();
    }
  }
  EXPECT_GT(folded, rounds / 5);
  EXPECT_LT(folded, rounds * 4 / 5);
}

// A block whose top is pushed through its bottom: the law alone would let it.
TEST(ElementWatch, StopsAFoldedSolidWithElementAndTime) {
  for (const auto& law : {saint_venant_kirchhoff(), models::make_law(structure::material_laws().back())}) {
    ExplicitSolver solver(std::make_unique<Solid>(models::block({1, 1, 1}, {1, 1, 1}, 2), law), {});
    NodalVectors v = solver.body().reference();
    v.topRows(2).setZero();
    solver.set_velocities(-0.9 * v);
    solver.set_time_step(0.01);
    const NodalVectors none = NodalVectors::Zero(3, v.cols());
    solver.initialise_forces(none);
    double folded_since = 0.0;
    const auto& solid = dynamic_cast<const Solid&>(solver.body());
    std::string said;
    try {
      for (int n = 0; n < 100000; ++n) {
        solver.begin_step();
        solver.end_step(none);
        const bool is_folded = smallest_ratio(solid, solver.displacements()) <= 0.0;
        folded_since = !is_folded ? 0.0 : folded_since > 0.0 ? folded_since : solver.time();
      }
    } catch (const Diverged& error) {
      said = error.what();
    }
    EXPECT_THAT(said, AllOf(HasSubstr("element 0 (spans 0, 0, 0"), HasSubstr("folded, det F = -"),
                            HasSubstr(law->law())));
    EXPECT_LE(smallest_ratio(solid, solver.displacements()), 0.0);
    if (folded_since > 0.0) {
      EXPECT_LE(solver.time(), folded_since + (ElementWatch::kTurns + 1) * solver.time_step());
    }
  }
}

TEST(ElementWatch, WarnsOnceOfALinearSolidThatTurnsAndNotOfOneThatTrembles) {
  for (const double speed : {1e-2, 1e-6}) {
    ExplicitSolver solver(std::make_unique<Solid>(models::block({2, 1, 1}, {2, 1, 1}, 2), models::elastic()),
                          {});
    NodalVectors v = solver.body().reference();
    v.row(0).swap(v.row(1));
    v.row(0) *= -1.0;
    v.row(2).setZero();
    solver.set_velocities(speed * v);
    solver.set_time_step(0.2);
    const NodalVectors none = NodalVectors::Zero(3, v.cols());
    solver.initialise_forces(none);
    int warnings = 0;
    for (int n = 0; n < 4 * ElementWatch::kTurns; ++n) {
      solver.begin_step();
      solver.end_step(none);
      const std::string warning = solver.take_warning();
      if (!warning.empty()) {
        EXPECT_THAT(warning,
                    AllOf(HasSubstr("of small strain"), HasSubstr("is turned by"), HasSubstr("at time")));
        ++warnings;
      }
    }
    EXPECT_EQ(warnings, speed > 1e-3 ? 1 : 0);
  }
}

}  // namespace
