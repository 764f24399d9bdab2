// SPDX-License-Identifier: GPL-2.0-or-later
// The passes over nodal vectors against the scheme, written down number by number.
#include "structure/time/verlet_update.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models.h"

namespace {

using models::NodalVectors;
using structure::ForceSums;

constexpr int kNodes = 7;  // 21 numbers: not a multiple of the lanes

struct State {
  NodalVectors reference = random(1), u = random(2), v = random(3), a = random(4), x = random(5);
  NodalVectors internal = random(6), loads = random(7), forces = random(8);
  NodalVectors inverse_mass = random(9).cwiseAbs();

  static NodalVectors random(int seed) { return models::random_vectors(kNodes, seed); }
  ForceSums kick(double h, int first, int count) {
    return structure::accelerate_and_kick(h, {internal, loads, forces}, inverse_mass, first, count, a, v);
  }
};

TEST(VerletUpdate, KicksByHalfAStepAndDriftsByAWholeOne) {
  State now;
  const State before;
  const double dt = 0.3;
  const double largest = structure::kick_and_drift(dt, now.a, now.reference, now.v, now.u, now.x);
  const NodalVectors v = before.v + 0.5 * dt * before.a, u = before.u + dt * v;
  EXPECT_LT((now.v - v).norm(), 1e-15);
  EXPECT_LT((now.u - u).norm(), 1e-15);
  EXPECT_LT((now.x - before.reference - u).norm(), 1e-15);
  EXPECT_EQ(largest, now.u.cwiseAbs().maxCoeff());
}

TEST(VerletUpdate, SeesTheLargestDisplacementAtAnyPlace) {
  for (int i = 0; i < 3 * kNodes; ++i) {
    State now;
    now.u.data()[i] = i % 2 == 0 ? 1e6 : -1e6;
    const double largest = structure::kick_and_drift(0.3, now.a, now.reference, now.v, now.u, now.x);
    EXPECT_EQ(largest, std::abs(now.u.data()[i]));
  }
}

TEST(VerletUpdate, AcceleratesTheNodesOfOneRunAndNoOthers) {
  State now;
  now.inverse_mass(1, 3) = 0.0;  // a fixed dof
  now.v(1, 3) = 0.0;
  const State before = now;
  const double h = 0.2;
  now.kick(h, 2, 4);
  NodalVectors a = before.a, v = before.v;
  for (int A = 2; A < 6; ++A)
    for (int i = 0; i < 3; ++i) {
      a(i, A) =
          (before.loads(i, A) + before.forces(i, A) - before.internal(i, A)) * before.inverse_mass(i, A);
      v(i, A) += h * a(i, A);
    }
  EXPECT_LT((now.a - a).norm(), 1e-15);
  EXPECT_LT((now.v - v).norm(), 1e-15);
  EXPECT_EQ(now.v(1, 3), 0.0);
}

TEST(VerletUpdate, SumsOfARunDependNotOnWhereItStands) {
  State here, there;
  const auto move = [](NodalVectors& values) { values.leftCols(5) = values.middleCols(1, 5).eval(); };
  for (NodalVectors* values : {&there.internal, &there.loads, &there.forces, &there.inverse_mass, &there.v})
    move(*values);
  const ForceSums first = here.kick(0.2, 1, 5), second = there.kick(0.2, 0, 5);
  EXPECT_TRUE((first.f_v == second.f_v).all());
  EXPECT_TRUE((first.f_a == second.f_a).all());
}

// h f . (v + v')/2 for the kick that was and for the next, by each kind of forces; all together they are the
// change of the kinetic energy.
TEST(VerletUpdate, WorkIsThatOfTheMeanVelocityOfEachHalfKick) {
  State now;
  const NodalVectors v_before = now.v;
  const double h = 0.2;
  const ForceSums sums = now.kick(h, 0, kNodes);
  const NodalVectors v_after = now.v + h * now.a, mass = now.inverse_mass.cwiseInverse();
  const auto work = [&](const NodalVectors& f, const NodalVectors& v, const NodalVectors& w) {
    return 0.5 * h * f.cwiseProduct(v + w).sum();
  };
  const auto kinetic = [&](const NodalVectors& v) {
    return 0.5 * mass.cwiseProduct(v).cwiseProduct(v).sum();
  };
  const NodalVectors* const f[] = {&now.internal, &now.loads, &now.forces};
  for (int k : {structure::kInternal, structure::kLoads, structure::kForces}) {
    EXPECT_NEAR(sums.work_until_now(h)[k], work(*f[k], v_before, now.v), 1e-13);
    EXPECT_NEAR(sums.work_from_now(h)[k], work(*f[k], now.v, v_after), 1e-13);
  }
  const auto gain = [](const structure::PerForce& w) {
    return w[structure::kLoads] + w[structure::kForces] - w[structure::kInternal];
  };
  EXPECT_NEAR(gain(sums.work_until_now(h)), kinetic(now.v) - kinetic(v_before), 1e-12);
  EXPECT_NEAR(gain(sums.work_from_now(h)), kinetic(v_after) - kinetic(now.v), 1e-12);
}

TEST(VerletUpdate, SumsAreNotFiniteIfOneNumberIsNot) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (NodalVectors State::*values : {&State::internal, &State::loads, &State::forces, &State::v})
      for (const int i : {0, 6, 19, 20}) {
        State now;
        (now.*values).data()[i] = value;
        EXPECT_FALSE(now.kick(0.2, 0, kNodes).f_v.allFinite()) << i;
      }
}

}  // namespace
