// SPDX-License-Identifier: GPL-2.0-or-later
// Momentum, work and saved states of a solid with sub-steps.
#include "coupling/substeps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "block_with_substeps.h"
#include "options_of_substeps.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::SubstepOptions;
using coupling::Substeps;
using coupling::Vector3;
using structure::TimeMass;
using test::forces_on;
using test::Ground;
using test::on_surface;
using test::options;
using test::run;
using test::small_block;
using Fast = SubstepOptions::Fast;

struct Way {
  Fast fast;
  double step;
  double heaviest;  // of heavy particles the impulses are spread
  TimeMass mass = TimeMass::lumped;
};

class BothWays : public testing::TestWithParam<Way> {
 protected:
  double step() const { return GetParam().step; }
  SubstepOptions how(int count) const { return options(GetParam().fast, count, GetParam().heaviest); }
  static std::unique_ptr<coupling::IgaStructure> block(Ground ground, double damping = 0.0) {
    std::unique_ptr<coupling::IgaStructure> solid = small_block(ground, {}, GetParam().mass);
    solid->solver().set_mass_damping(damping);
    return solid;
  }
  void expect_work_of_contacts(Ground ground);
};
constexpr Way kLumped[] = {
    {Fast::particles, 0.02, 0.0}, {Fast::structure, 1.0, 0.0}, {Fast::structure, 1.8, 0.3}};
constexpr Way kCorrected[] = {{Fast::particles, 0.02, 0.0, TimeMass::corrected},
                              {Fast::structure, 0.7, 0.0, TimeMass::corrected},
                              {Fast::structure, 1.3, 0.3, TimeMass::corrected}};
INSTANTIATE_TEST_SUITE_P(Substeps, BothWays, testing::ValuesIn(kLumped));
INSTANTIATE_TEST_SUITE_P(CorrectedMass, BothWays, testing::ValuesIn(kCorrected));

TEST_P(BothWays, AreWhatTheyAreSaidToBe) {
  Substeps body(block(Ground::fixed), how(5));
  body.set_time_step(step());
  EXPECT_EQ(body.describe_step().find("spread") != std::string::npos, GetParam().heaviest > 0.0);
}

TEST_P(BothWays, ASingleStepIsThePlainOne) {
  Substeps body(block(Ground::fixed), how(1));
  const std::unique_ptr<coupling::IgaStructure> plain = block(Ground::fixed);
  const double dt = 0.02;
  body.set_time_step(dt), plain->set_time_step(dt);
  body.initialise_forces(forces_on(body)), plain->initialise_forces(forces_on(*plain));
  for (int n = 0; n < 50; ++n) {
    body.begin_step(), plain->begin_step();
    const NodalForces forces = forces_on(*plain);
    body.end_step(forces), plain->end_step(forces);
  }
  EXPECT_LT((on_surface(body, body.positions()) - on_surface(*plain, plain->positions())).norm(), 1e-13);
  EXPECT_LT((on_surface(body, body.velocities()) - on_surface(*plain, plain->velocities())).norm(), 1e-13);
  EXPECT_NEAR(body.kinetic_energy(), plain->kinetic_energy(), 1e-12 * plain->kinetic_energy());
}

TEST_P(BothWays, KeepMomentumToRoundOff) {
  Substeps body(block(Ground::none), how(5));
  body.set_time_step(step());
  NodalForces forces = forces_on(body);
  body.initialise_forces(forces);
  Vector3 impulse = Vector3::Zero();
  const int steps = 40;
  for (int n = 0; n < steps; ++n) {
    impulse += 0.5 * step() * forces.values.rowwise().sum();
    body.begin_step();
    forces = forces_on(body);
    impulse += 0.5 * step() * forces.values.rowwise().sum();
    body.end_step(forces);
  }
  impulse += 18.0 * steps * step() * Vector3(1e-4, 0, -2e-4);
  EXPECT_LT((body.linear_momentum() - impulse).norm(), 1e-13 * impulse.norm() * steps);
}

// Work of contacts by the rule of the step: the mean velocity of each half kick.
void BothWays::expect_work_of_contacts(Ground ground) {
  std::unique_ptr<coupling::IgaStructure> solid = block(ground, 0.05);
  const structure::ExplicitSolver& solver = solid->solver();
  Substeps body(std::move(solid), how(5));
  body.set_time_step(step());
  const bool inner = GetParam().fast == Fast::particles;
  NodalForces forces = forces_on(body);
  body.initialise_forces(forces);
  const double start = body.kinetic_energy();
  double contacts = 0.0;
  const auto half_kick = [&] {
    NodalVectors kick(forces.values);
    solver.mass().apply_inverse_mass(forces.values, kick);
    return NodalVectors(0.5 * step() * kick);
  };
  for (int n = 0; n < 200; ++n) {
    const NodalVectors kick = half_kick();
    if (inner) {  // velocities at once before and after; within an outer step they have the outer half kick
      body.begin_step();
      const NodalVectors v = body.velocities() + (2 - n % 5) * step() * solver.accelerations();
      contacts += 0.5 * step() * forces.values.cwiseProduct(v - 0.5 * kick).sum();
      forces = forces_on(body);
      const NodalVectors second = half_kick();
      contacts += 0.5 * step() * forces.values.cwiseProduct(v + 0.5 * second).sum();
      body.end_step(forces);
    } else {
      run(body, 1);
    }
    const coupling::Work work = body.work();
    const double turned_over =
        std::abs(work.contacts) + std::abs(work.internal) + std::abs(work.loads) + std::abs(work.supports);
    EXPECT_NEAR(
        body.kinetic_energy() + work.internal + work.damped - work.loads - work.contacts - work.supports,
        start, 1e-12 * turned_over);
    if (inner && n % 5 == 4) {
      EXPECT_NEAR(work.contacts, contacts, 1e-12 * turned_over);
    }
  }
}

TEST_P(BothWays, TheirLedgerIsClosedAndKnowsTheWorkOfContacts) { expect_work_of_contacts(Ground::fixed); }
TEST_P(BothWays, ItKnowsThatOnSupportsThatMove) { expect_work_of_contacts(Ground::moves); }

// A load that rests on a body at rest sees a surface at rest in every step, however light its nodes are; the
// ground carries it, where it presses on fixed nodes, too.
TEST_P(BothWays, ALoadAtRestSeesASurfaceAtRest) {
  std::unique_ptr<coupling::IgaStructure> solid = block(Ground::fixed, 0.1);
  const double heaviest = solid->solver().mass().inverse_mass().maxCoeff();
  solid->watch({{"ground", solid->solver().fixed_dofs()}});
  Substeps body(std::move(solid), how(5));
  body.set_time_step(step());
  NodalVectors F = NodalVectors::Zero(3, body.positions().cols());
  const NodalVectors up = on_surface(body, body.positions());
  NodalVectors pressed = NodalVectors::Zero(3, up.cols());
  pressed.row(2).setConstant(-1e-3);
  body.surface().map.add_to_nodes(pressed, F);
  body.initialise_forces(NodalForces(F));
  const double half_kick = 0.5 * step() * 1e-3 * heaviest;
  const int steps = static_cast<int>(400.0 / step());
  for (int n = 0; n < steps; ++n) {
    body.begin_step();
    if (n >= steps - 10) {
      EXPECT_LT(on_surface(body, body.velocities()).cwiseAbs().maxCoeff(), 1e-3 * half_kick) << n;
    }
    body.end_step(NodalForces(F));
  }
  if (GetParam().fast == Fast::structure) return;  // its reactions are those of the kick
  const Vector3 load = Vector3(0, 0, pressed.row(2).sum()) + 18.0 * Vector3(1e-4, 0, -2e-4);
  EXPECT_LT((body.reactions().at(0).force + load).norm(), 1e-5 * load.norm());
}

TEST_P(BothWays, ContinueFromASavedStateToTheLastBit) {
  for (const int before : {10, 13}) {  // at the end of an outer step, and within one
    Substeps first(block(Ground::fixed, 0.05), how(5)), second(block(Ground::fixed, 0.05), how(5));
    first.set_time_step(step()), second.set_time_step(step());
    first.initialise_forces(forces_on(first));
    run(first, before);
    second.load(first.save());
    second.set_time_step(step());
    for (Substeps* body : {&first, &second}) {
      body->initialise_forces(forces_on(*body));
      run(*body, 19);
    }
    EXPECT_TRUE(on_surface(first, first.positions()) == on_surface(second, second.positions()));
    EXPECT_TRUE(on_surface(first, first.velocities()) == on_surface(second, second.velocities()));
    EXPECT_TRUE(first.save() == second.save());
    EXPECT_EQ(first.work().contacts, second.work().contacts);
  }
}

TEST(Substeps, ARunThatIsSplitWithinAnOuterStepGoesOnAsTheWholeDoes) {
  Substeps whole(small_block(Ground::fixed), options(Fast::particles, 5)),
      split(small_block(Ground::fixed), options(Fast::particles, 5));
  for (Substeps* body : {&whole, &split}) {
    body->set_time_step(0.02);
    body->initialise_forces(forces_on(*body));
    run(*body, 13);
  }
  split.set_time_step(0.02);
  EXPECT_THROW(split.set_time_step(0.01), std::invalid_argument);
  split.initialise_forces(forces_on(split));
  run(whole, 12), run(split, 12);
  const NodalVectors v = on_surface(whole, whole.velocities());
  EXPECT_LT((on_surface(split, split.velocities()) - v).norm(), 1e-3 * v.norm());
  split.set_time_step(0.01);  // now an outer step is done
}

TEST(Substeps, AStateWithinAnOuterStepAsksForItsNumber) {
  Substeps body(small_block(), options(Fast::particles, 5)),
      other(small_block(), options(Fast::particles, 4)), same(small_block(), options(Fast::particles, 5));
  body.set_time_step(0.02);
  body.initialise_forces(forces_on(body));
  run(body, 3);
  std::vector<double> state = body.save();
  EXPECT_THROW(other.load(state), std::invalid_argument);
  same.load(state);
  const std::size_t count = state.size() - 2 - 9 * static_cast<std::size_t>(body.positions().cols());
  ASSERT_EQ(state[count], 5.0);
  for (const double damaged : {0.0, 2.0, 4.5, 1e9}) {
    state[count] = damaged;
    EXPECT_THROW(same.load(state), std::invalid_argument) << damaged;
  }
}

/// How often the shares of nodes are summed: once for the internal force, once for each product with M.
class CountingHalo final : public structure::Halo {
 public:
  explicit CountingHalo(int& sums) : sums_(sums) {}
  void begin_sum(const NodalVectors& /*values*/) const override { ++sums_; }

 private:
  int& sums_;
};

TEST(Substeps, FastParticlesTakeOneProductWithTheMassWhereTheyTouchAndElseNone) {
  int sums = 0;
  Substeps body(small_block(Ground::fixed, {}, TimeMass::corrected, std::make_unique<CountingHalo>(sums)),
                options(Fast::particles, 5));
  const NodalForces none(NodalVectors::Zero(3, body.positions().cols()));
  body.set_time_step(0.02);
  body.initialise_forces(none);
  const auto sums_of_outer_step = [&](const NodalForces& forces) {
    sums = 0;
    for (int n = 0; n < 5; ++n) body.begin_step(), body.end_step(forces);
    return sums;
  };
  EXPECT_EQ(sums_of_outer_step(none), 2);  // the body's own
  EXPECT_EQ(sums_of_outer_step(forces_on(body)), 2 + 5);
}

TEST(Substeps, WithinAnOuterStepTheBodysNumbersAreThoseOfItsBeginning) {
  Substeps body(small_block(Ground::fixed), options(Fast::particles, 5));
  body.set_time_step(0.02);
  body.initialise_forces(forces_on(body));
  run(body, 5);
  const double kinetic = body.kinetic_energy(), strain = body.strain_energy(), work = body.work().contacts;
  run(body, 4);
  EXPECT_EQ(body.kinetic_energy(), kinetic);
  EXPECT_EQ(body.strain_energy(), strain);
  EXPECT_EQ(body.work().contacts, work);
  run(body, 1);
  EXPECT_NE(body.kinetic_energy(), kinetic);
}

}  // namespace
