// SPDX-License-Identifier: GPL-2.0-or-later
// Sub-steps whose number changes in a run: with the time step, and where strain asks for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "block_with_substeps.h"
#include "options_of_substeps.h"
#include "structure/material/saint_venant_kirchhoff.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::SubstepOptions;
using coupling::Substeps;
using coupling::Vector3;
using test::forces_on;
using test::Ground;
using test::options;
using test::run;
using test::small_block;
using Fast = SubstepOptions::Fast;

// Contacts kick the body by what they are, whoever is fast and however many steps there are then.
TEST(SubstepsThatChange, ATimeStepThatChangesInARunKeepsMomentum) {
  struct Change {
    Fast fast;
    double before, after;
    int count;  // afterwards
  };
  for (const Change& change :
       {Change{Fast::structure, 1.0, 0.1, 1}, Change{Fast::structure, 0.1, 1.0, 2},
        Change{Fast::by_time_step, 1.0, 0.1, 1}, Change{Fast::by_time_step, 0.1, 1.0, 2}}) {
    Substeps body(small_block(), options(change.fast, std::nullopt));
    body.set_time_step(change.before);
    NodalForces forces = forces_on(body);
    body.initialise_forces(forces);
    Vector3 impulse = Vector3::Zero();
    for (const double dt : {change.before, change.after}) {
      body.set_time_step(dt);
      for (int n = 0; n < 10; ++n) {
        impulse += 0.5 * dt * forces.values.rowwise().sum();
        body.begin_step();
        forces = forces_on(body);
        impulse += 0.5 * dt * forces.values.rowwise().sum();
        body.end_step(forces);
      }
      impulse += 18.0 * 10 * dt * Vector3(1e-4, 0, -2e-4);
    }
    EXPECT_GE(body.count(), change.count);
    EXPECT_EQ(body.particles_fast(), change.fast == Fast::by_time_step && change.after < 0.5);
    EXPECT_LT((body.linear_momentum() - impulse).norm(), 1e-12 * impulse.norm());
  }
}

/// A block whose lower face stays while the rest flies off, of a law that stiffens.
std::unique_ptr<coupling::IgaStructure> stretched_block(double speed) {
  auto body = small_block(Ground::fixed, std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.3, 1.0));
  NodalVectors v = NodalVectors::Zero(3, body->positions().cols());
  v.row(2).setConstant(speed);
  body->solver().set_velocities(v);
  return body;
}

struct Changes {
  std::vector<std::string> said;
  std::vector<int> counts;
};

Changes run_and_listen(Substeps& body, int steps) {
  Changes changes;
  for (int n = 0; n < steps; ++n) {
    run(body, 1);
    if (std::string change = body.take_change(); !change.empty()) {
      changes.said.push_back(std::move(change));
      changes.counts.push_back(body.count());
    }
  }
  EXPECT_EQ(body.take_change(), "");
  return changes;
}

void expect_closed_ledger(const Substeps& body, double start) {
  const coupling::Work work = body.work();
  EXPECT_NEAR(body.kinetic_energy() + work.internal - work.loads - work.contacts, start, 1e-12 * start);
}

// Strain shortens the stable step: fewer particle steps in one of the body's, then more steps of the body in
// one of theirs.
TEST(SubstepsThatChange, AutoTakesAnotherNumberWhereStrainAsksForIt) {
  const double stable = stretched_block(0.3)->stable_time_step();
  const auto expect_another = [&](Fast fast, double share, int count, int steps, const char* said) {
    Substeps body(stretched_block(0.3), options(fast, {}, 1e-4));
    body.set_time_step(share * stable);
    EXPECT_EQ(body.count(), count);
    body.initialise_forces(forces_on(body));
    const double start = body.kinetic_energy();
    const Changes changes = run_and_listen(body, steps);
    ASSERT_EQ(changes.said.size(), 1u);
    EXPECT_THAT(changes.said[0], testing::HasSubstr(said));
    EXPECT_THAT(changes.said[0], testing::HasSubstr("brought its stable step down to"));
    expect_closed_ledger(body, start);
  };
  for (const Fast fast : {Fast::by_time_step, Fast::particles})
    expect_another(fast, 0.32, 3, 30, "substeps particles 2");
  for (const Fast fast : {Fast::by_time_step, Fast::structure})
    expect_another(fast, 0.97, 1, 20, "substeps structure 2");
}

TEST(SubstepsThatChange, ANumberStaysAndSaysWhatHelps) {
  const double stable = stretched_block(0.3)->stable_time_step();
  const auto failure = [&](Fast fast, std::optional<int> count, double dt) -> std::string {
    Substeps body(stretched_block(0.3), options(fast, count, 1e-4));
    try {
      body.set_time_step(dt);
      body.initialise_forces(forces_on(body));
      run(body, 60);
    } catch (const std::exception& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_THAT(failure(Fast::particles, 3, 0.32 * stable), testing::HasSubstr("or 'substeps auto'"));
  EXPECT_THAT(failure(Fast::structure, 1, 0.97 * stable), testing::HasSubstr("or 'substeps auto'"));
  EXPECT_THAT(failure(Fast::particles, {}, 0.97 * stable),
              testing::AllOf(testing::HasSubstr("above the structure's stable step"),
                             testing::HasSubstr("or 'substeps auto'")));
}

}  // namespace
