// SPDX-License-Identifier: GPL-2.0-or-later
// Kinetic damping ends where Newton's method does.
#include <gtest/gtest.h>

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
