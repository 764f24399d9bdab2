// SPDX-License-Identifier: GPL-2.0-or-later
// What a modal body makes of springs to the ground, and of supports that are not in their places.
#include <gmock/gmock.h>

#include "modal_bar.h"
#include "point_force.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using structure::ExplicitSolver;
using test::bar;
using test::modal;
using test::whole;

// Viscosity is the material's: springs to the ground, on which a bar stands as a whole, give back what they
// take.
TEST(ModalSupports, SpringsToTheGroundAreNotViscous) {
  const double b = 0.05, k = 0.2;
  const auto on_springs = [&] {
    ExplicitSolver solver = bar({});
    std::vector<structure::Springs::Spring> group;
    for (int A = 0; A < solver.body().node_count(); ++A)  // in proportion to the mass: exact rigid modes
      group.push_back({A, k * solver.mass().nodal_mass()[A] * structure::Stiffness3::Identity()});
    structure::Springs springs;
    springs.add(group);
    solver.set_springs(springs);
    return solver;
  };
  const auto body = modal(whole(on_springs()), 7, {{}, 0.0, b});
  body->set_time_step(0.05);
  const NodalForces none(NodalVectors::Zero(3, body->positions().cols()));
  structure::ModalBasis basis = structure::modal_basis(on_springs(), 7);
  EXPECT_NEAR(basis.eigenvalues[0], k, 1e-9);
  EXPECT_GT(basis.eigenvalues[6], 2 * k);
  const auto energy = [&] { return body->kinetic_energy() + body->strain_energy(); };
  // All seven at once, pushed at a place on the surface.
  body->initialise_forces(point_force(*body, {0.8, 0.5}, {0, 0, -10}));
  body->begin_step();
  body->end_step(none);
  const auto ledger = [&] { return body->kinetic_energy() + body->work().internal + body->work().damped; };
  const double start = energy(), booked = ledger();
  const int steps = 8000;
  for (int n = 0; n < steps; ++n) body->begin_step(), body->end_step(none);
  // What is left after 18 time constants of the lowest mode that strains the bar.
  ASSERT_GT(b * (basis.eigenvalues[6] - k) * 0.05 * steps, 18.0);
  const double later = energy();
  for (int n = 0; n < 1000; ++n) body->begin_step(), body->end_step(none);
  EXPECT_NEAR(energy() / later, 1.0, 1e-9) << "rigid motion on springs is not damped";
  EXPECT_GT(later, 0.1 * start);
  EXPECT_NEAR(ledger(), booked, 1e-9 * booked);
}

TEST(ModalSupports, SupportsThatAStateHasDisplacedAreRefused) {
  ExplicitSolver bent = bar();
  NodalVectors u = NodalVectors::Zero(3, bent.body().node_count());
  u.row(2).setConstant(1e-3);
  bent.set_motion(u, NodalVectors::Zero(3, u.cols()), 0.0);
  EXPECT_THAT([&] { modal(whole(std::move(bent)), 3); },
              testing::ThrowsMessage<std::invalid_argument>(testing::AllOf(
                  testing::HasSubstr("displaced by up to 0.001"), testing::HasSubstr("'move'"))));
}

}  // namespace
