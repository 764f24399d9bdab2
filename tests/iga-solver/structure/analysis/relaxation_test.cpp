// SPDX-License-Identifier: GPL-2.0-or-later
// Kinetic damping ends where Newton's method does.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/analysis/relaxation.h"
#include "structure/analysis/static_equilibrium.h"
#include "structure/conditions/loads.h"

namespace {

using models::NodalVectors;
using nurbs::Face;
using structure::Solid;
using structure::Supports;

TEST(Relaxation, EndsAtTheEquilibrium) {
  for (const auto& law : models::large_strain_laws()) {
    auto solid = std::make_unique<Solid>(models::block({3, 1, 1}, {4, 2, 2}, 2), law);
    Supports supports;
    supports.fix(structure::nodes_on(solid->patch(0).space(), {Face::xi_minus}), {true, true, true});
    const NodalVectors load = structure::gravity_load(*solid, {0, 0.002, -0.004});
    structure::StaticEquilibrium statics(*solid, supports, load);
    statics.solve();
    const NodalVectors expected = statics.displacements();

    structure::ExplicitSolver solver(std::move(solid), supports);
    solver.set_load(load);
    solver.set_time_step(0.5 * solver.stable_time_step());
    long peaks = 0;
    const structure::RelaxPeak last =
        structure::relax(solver, {1e-7}, [&](const structure::RelaxPeak&) { ++peaks; });
    EXPECT_GT(expected.norm(), 0.1) << law->law();
    EXPECT_LT((solver.displacements() - expected).norm(), 1e-4 * expected.norm()) << law->law();
    EXPECT_LE(last.residual, 1e-7);
    EXPECT_GT(peaks, 2);
    EXPECT_TRUE(solver.velocities().isZero(0.0));
  }
}

// A fibre of stretch s is stiffer by (3 s^2 - 1)/2, so the stable step comes down below the time step.
TEST(Relaxation, ShortensItsStepsWhereStrainStiffens) {
  for (const auto& law : models::large_strain_laws()) {
    if (law->law() != std::string("saint_venant_kirchhoff")) continue;
    auto solid = std::make_unique<Solid>(models::block({1, 1, 1}, {2, 2, 2}, 2), law);
    Supports supports;
    supports.fix(structure::nodes_on(solid->space(), {Face::xi_minus}), {true, true, true});
    const NodalVectors load = structure::traction_load(*solid, {0, Face::xi_plus}, {0.4, 0, 0});
    structure::StaticEquilibrium statics(*solid, supports, load);
    statics.solve();
    structure::ExplicitSolver solver(std::move(solid), supports);
    solver.set_load(load);
    const double step = 0.9 * solver.stable_time_step();
    solver.set_time_step(step);
    structure::relax(solver, {1e-7});
    EXPECT_LT(solver.time_step(), 0.95 * step);
    EXPECT_LE(solver.time_step(), solver.renew_stable_time_step());
    EXPECT_LT((solver.displacements() - statics.displacements()).norm(),
              1e-4 * statics.displacements().norm());
  }
}

// One element that can only stretch, without Poisson's ratio: the load moves but the mode with omega^2 = 2,
// and none has more.  Two or three steps of sqrt(2) or sqrt(3) / omega bring it back to rest.
TEST(Relaxation, EndsWhereAModeIsAtRestAfterAFewSteps) {
  for (const double turn : {0.3, 1.0, std::sqrt(2.0), std::sqrt(3.0), 1.9}) {
    for (const double damping : {0.0, 0.01}) {
      auto solid =
          std::make_unique<Solid>(models::block({1, 1, 1}, {1, 1, 1}, 1), models::elastic(1.0, 0.0, 1.0));
      const auto& space = solid->patch(0).space();
      Supports supports;
      supports.fix(structure::nodes_on(space, {Face::xi_minus}), {true, true, true});
      supports.fix(structure::nodes_on(space, {Face::xi_plus}), {false, true, true});
      const NodalVectors load = structure::gravity_load(*solid, {0.01, 0, 0});
      structure::ExplicitSolver solver(std::move(solid), supports);
      solver.set_load(load);
      solver.set_mass_damping(damping);
      solver.set_time_step(turn / std::sqrt(2.0));
      EXPECT_LT(structure::relax(solver, {1e-9, 1000}).step, 200) << turn;
      EXPECT_NEAR(solver.displacements().maxCoeff(), 0.005, 1e-11) << turn;
    }
  }
}

TEST(Relaxation, EndsWithAFaceThatIsMoved) {
  for (const auto mass : {structure::TimeMass::lumped, structure::TimeMass::corrected}) {
    for (const int degree : {1, 2, 3}) {
      auto solid = std::make_unique<Solid>(models::block({1, 0.4, 0.3}, {8, 4, 4}, degree), models::elastic(),
                                           structure::Integration{{}, {}, mass});
      const auto& space = solid->patch(0).space();
      Supports supports;
      supports.fix(structure::nodes_on(space, {Face::xi_minus}), {true, true, true});
      supports.move(structure::nodes_on(space, {Face::xi_plus}), {true, false, false}, {0.002, 0, 0},
                    structure::ramp(0.0, 1.0));
      structure::ExplicitSolver solver(std::move(solid), supports);
      solver.set_time_step(0.9 * solver.stable_time_step());
      EXPECT_NO_THROW(structure::relax(solver, {1e-6, 500})) << degree;
    }
  }
}

TEST(Relaxation, SaysWhatIsLeftAfterTooFewSteps) {
  auto solid = std::make_unique<Solid>(models::block({3, 1, 1}, {2, 1, 1}, 2), models::elastic());
  Supports supports;
  supports.fix(structure::nodes_on(solid->patch(0).space(), {Face::xi_minus}), {true, true, true});
  const NodalVectors load = structure::gravity_load(*solid, {0, 0, -0.004});
  structure::ExplicitSolver solver(std::move(solid), supports);
  solver.set_load(load);
  solver.set_time_step(0.5 * solver.stable_time_step());
  try {
    structure::relax(solver, {1e-6, 3});
    FAIL() << "at rest after three steps";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("after 3 steps, expected 1.0e-06"), std::string::npos);
  }
}

}  // namespace
