// SPDX-License-Identifier: GPL-2.0-or-later
// Our solver behind the port, as contact drives it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/force_distribution.h"
#include "coupling/iga_structure.h"
#include "nurbs/primitives.h"
#include "structure/linear_elastic.h"

namespace {

using coupling::NodalVectors;
using coupling::Vector3;

const double kStep = 1e-8;

/// Free steel block 6 x 6 x 3 mm of PHYSICS D7; particles see its top at z = 0.
coupling::IgaStructure block() {
  const auto knots = [](int n) { return nurbs::KnotVector::uniform(2, n); };
  nurbs::Volume patch = nurbs::box({-3e-3, -3e-3, -3e-3}, {6e-3, 6e-3, 3e-3}, {knots(6), knots(6), knots(3)});
  auto steel = std::make_shared<structure::LinearElastic>(210.6e9, 0.286, 7850.0);
  coupling::IgaStructure solver(structure::ExplicitSolver({std::move(patch), steel}, {}),
                                {nurbs::Face::zeta_plus});
  solver.set_time_step(kStep);
  return solver;
}

/// Nodal forces of a point force F at parameters xi of the surface.
NodalVectors nodal_forces(const coupling::IgaStructure& solver, const nurbs::Parameter<2>& xi,
                          const Vector3& F) {
  NodalVectors on_surface = NodalVectors::Zero(3, solver.surface().topology.control_point_count());
  coupling::FootBasis(solver.surface().topology, {0, xi}).distribute(F, on_surface);
  NodalVectors on_nodes = NodalVectors::Zero(3, solver.positions().cols());
  solver.surface().map.add_to_nodes(on_surface, on_nodes);
  return on_nodes;
}

TEST(IgaStructure, SurfaceIsTheTopOfTheBlock) {
  const coupling::IgaStructure solver = block();
  NodalVectors x;
  solver.surface().map.to_surface(solver.positions(), x);
  EXPECT_NEAR(x.row(2).cwiseAbs().maxCoeff(), 0.0, 1e-18);
  EXPECT_EQ(solver.surface().outward_sign, std::vector<int>{1}) << "xi x eta of the top points out";
}

TEST(IgaStructure, MomentumIsForceTimesTime) {
  coupling::IgaStructure solver = block();
  const Vector3 F(1.0, 0.5, -6.0);
  const NodalVectors forces = nodal_forces(solver, {0.7, 0.4}, F);
  solver.initialise_forces(forces);
  const int steps = 400;
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(forces);
  }
  const Vector3 impulse = steps * kStep * F;
  EXPECT_LE((solver.linear_momentum() - impulse).norm(), 1e-12 * impulse.norm());
}

TEST(IgaStructure, WorkOfTheForceIsTheEnergyOfTheBlock) {
  coupling::IgaStructure solver = block();
  const Vector3 F(0.0, 0.0, -6.0);
  const NodalVectors forces = nodal_forces(solver, {0.5, 0.5}, F);
  solver.initialise_forces(forces);
  double work = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const NodalVectors before = solver.positions();
    solver.begin_step();
    solver.end_step(forces);
    work += forces.cwiseProduct(solver.positions() - before).sum();
  }
  const double energy = solver.kinetic_energy() + solver.strain_energy();
  EXPECT_NEAR(energy / work, 1.0, 2e-3) << "error ~ (dt omega)^2";
}

TEST(IgaStructure, LoadContinuesASavedStateToTheLastBit) {
  coupling::IgaStructure first = block(), second = block();
  const NodalVectors forces = nodal_forces(first, {0.3, 0.6}, {0, 1, -5});
  const auto advance = [&](coupling::IgaStructure& solver, int steps) {
    for (int n = 0; n < steps; ++n) {
      solver.begin_step();
      solver.end_step(forces);
    }
  };
  first.initialise_forces(forces);
  advance(first, 20);
  second.load(first.save());
  advance(first, 20);
  advance(second, 20);
  EXPECT_EQ(first.positions(), second.positions());
  EXPECT_EQ(first.velocities(), second.velocities());
  EXPECT_THROW(second.load({1.0, 2.0}), std::invalid_argument);
}

TEST(IgaStructure, StepAboveTheStableOneIsRefusedWithBothNumbers) {
  coupling::IgaStructure solver = block();
  EXPECT_NEAR(solver.stable_time_step(), 1.29e-7, 0.03 * 1.29e-7) << "PHYSICS D7";
  try {
    solver.set_time_step(2e-7);
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& problem) {
    EXPECT_THAT(problem.what(), testing::AllOf(testing::HasSubstr("2e-07"), testing::HasSubstr("1.2")));
  }
}

}  // namespace
