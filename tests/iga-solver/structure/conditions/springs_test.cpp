// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/springs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using structure::ExplicitSolver;

/// A block that is far stiffer than the springs under all of it, k for each unit of mass.
ExplicitSolver block(double k, const Vector3& direction, double E = 1e4) {
  const nurbs::Volume patch = models::block({1, 1, 1}, {2, 2, 2}, 2);
  ExplicitSolver solver(std::make_unique<structure::Solid>(patch, models::elastic(E)), {});
  std::vector<structure::Springs::Spring> group;
  for (Eigen::Index A = 0; A < solver.body().node_count(); ++A)
    group.push_back({A, k * solver.mass().nodal_mass()[A] * direction * direction.transpose()});
  structure::Springs springs;
  springs.add(std::move(group));
  solver.set_springs(std::move(springs));
  return solver;
}

// All springs in proportion to the mass: a rigid translation is a mode, of frequency sqrt(k), and the
// scheme's is known: cos(omega' dt) = 1 - (omega dt)^2/2.
TEST(Springs, MoveABlockWithTheFrequencyOfTheScheme) {
  const Vector3 direction = Vector3(1, 2, 2) / 3;
  ExplicitSolver body = block(4.0, direction);
  const double dt = 0.5 * body.stable_time_step(), angle = std::acos(1.0 - 2.0 * dt * dt);
  body.set_time_step(dt);
  const NodalVectors none = NodalVectors::Zero(3, body.body().node_count());
  body.set_velocities(direction * Eigen::RowVectorXd::Ones(none.cols()));
  body.initialise_forces(none);
  const structure::NamedSupport ground{"ground", {}, 0};
  for (int n = 1; n <= 400; ++n) {
    body.begin_step();
    body.end_step(none);
    const double u = dt * std::sin(n * angle) / std::sin(angle);
    ASSERT_LT((Vector3(body.displacements().col(5)) - u * direction).norm(), 1e-9) << n;
    ASSERT_NEAR(body.strain_energy(), 0.5 * 4.0 * u * u, 1e-9);
    ASSERT_LT((body.reaction(ground) + 4.0 * u * direction).norm(), 1e-8);
    ASSERT_NEAR(body.kinetic_energy() + body.work().internal, 0.5, 1e-12);
  }
}

// A spring that is much stiffer than the body sets the stable step: 2 / omega of its node.
TEST(Springs, CountInTheStableStep) {
  EXPECT_NEAR(block(1e8, {0, 0, 1}, 1.0).stable_time_step(), 2.0 / 1e4, 0.02 * 2.0 / 1e4);
  const double soft = block(1e-8, {0, 0, 1}).stable_time_step();
  EXPECT_GT(soft, 1e-3);
}

}  // namespace
