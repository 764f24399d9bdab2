// SPDX-License-Identifier: GPL-2.0-or-later
// Frequencies and waves against beam and bar theory and independent codes with the same mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/conditions/loads.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;
using structure::Solid;
using structure::Supports;

// PHYSICS C6: omega L^2 sqrt(rho A / E I) of the first two bending pairs, nu = 0, lumped mass.
TEST(Cantilever, HasTheBendingFrequenciesOfAnIndependentCode) {
  struct Case {
    std::array<int, 3> elements;
    double first, second;
  };
  for (const Case& c : {Case{{10, 1, 1}, 3.4709, 20.256}, Case{{20, 2, 2}, 3.4852, 20.786}}) {
    const Solid solid(models::block({10, 1, 1}, c.elements, 2), models::elastic(1.0, 0.0, 1.0));
    Supports clamped;
    clamped.fix(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, true, true});
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(models::mass_scaled_stiffness(solid, clamped),
                                                       Eigen::EigenvaluesOnly)
            .eigenvalues();
    const Eigen::VectorXd frequency = 100.0 * std::sqrt(12.0) * eigenvalues.head<4>().cwiseSqrt();
    EXPECT_NEAR(frequency[0], c.first, 1e-4);
    EXPECT_NEAR(frequency[1], c.first, 1e-4);  // the section is square: every frequency twice
    EXPECT_NEAR(frequency[2], c.second, 1e-3);
    EXPECT_NEAR(frequency[3], c.second, 1e-3);
  }
}

// PHYSICS C7: a half-sine end force on a bar of unit impedance arrives at mid length half a unit of time
// later, with the known overshoot of lumped quadratic elements; all its impulse becomes momentum.
TEST(BarWave, TravelsAtTheBarSpeedAndKeepsTheImpulse) {
  const double duration = 0.2;
  const int elements = 100;
  auto bar = std::make_unique<Solid>(models::block({1, 1, 1}, {elements, 1, 1}, {2, 1, 1}),
                                     models::elastic(1.0, 0.0, 1.0));
  Supports sides;
  for (Face face : {Face::eta_minus, Face::eta_plus, Face::zeta_minus, Face::zeta_plus})
    sides.fix(structure::nodes_on(bar->space(), {face}), {false, true, true});
  const NodalVectors unit_force = structure::traction_load(*bar, {0, Face::xi_minus}, Vector3(1, 0, 0));
  const nurbs::Space<3> space = bar->space();
  ExplicitSolver solver(std::move(bar), sides);
  solver.set_time_step(0.5 * 0.86206 / elements);

  const auto pulse = [&](double t) {
    return t > 0.0 && t < duration ? std::sin(nurbs::kPi * t / duration) : 0.0;
  };
  NodalVectors F = NodalVectors::Zero(3, solver.body().node_count());
  solver.initialise_forces(F);
  double peak = 0.0, error2 = 0.0, norm2 = 0.0;
  while (solver.time() < 1.0) {
    solver.begin_step();
    F = pulse(solver.time() + solver.time_step()) * unit_force;
    solver.end_step(F);
    const double v = nurbs::interpolate(space, solver.velocities(), {0.5, 0.5, 0.5})[0];
    const double exact = pulse(solver.time() - 0.5);
    peak = std::max(peak, v);
    error2 += (v - exact) * (v - exact);
    norm2 += exact * exact;
  }
  EXPECT_NEAR(peak, 1.047, 0.003);
  EXPECT_NEAR(std::sqrt(error2 / norm2), 0.114, 0.01);
  EXPECT_NEAR(solver.linear_momentum()[0], 2.0 * duration / nurbs::kPi, 3e-4 * 2.0 * duration / nurbs::kPi);
}

}  // namespace
