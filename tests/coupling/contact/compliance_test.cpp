// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts behind a compliance of their mesh, on a sheet that does not give way itself: what is left is the
// correction alone, with a potential of its own.
#include "coupling/contact/compliance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "rippled_sheet.h"

namespace {

using nurbs::Vector3;
using ripples::kConstant;
using ripples::keep_above;
using ripples::kK;
using ripples::Ripples;
using ripples::Scene;
using ripples::Sheet;
using ripples::sheet_of;
using test::kRadius;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// x - c (K x^(3/2) + spring x) = overlap, by bisection up to s = 1, and s there.
struct OwnOverlap {
  double x, s;
};
OwnOverlap own_overlap(double overlap, double c, double spring = 0.0) {
  const auto excess = [&](double x) { return x - c * (kK * x * std::sqrt(x) + spring * x) - overlap; };
  double low = overlap, high = std::pow((1.0 - c * spring) / (1.5 * c * kK), 2);
  for (int k = 0; k < 200; ++k) {
    const double x = 0.5 * (low + high);
    (excess(x) < 0.0 ? low : high) = x;
  }
  return {low, c * (1.5 * kK * std::sqrt(low) + spring)};
}

// m V^2/2 = 2/5 K x^(5/2) - c F^2/2 where the ball turns back.
TEST(ComplianceCorrection, TheBallTurnsBackWhereItsEnergyIsAllInTheContact) {
  const double c = 1.5e-4;
  Ripples compliance(c, 0.0);
  Scene scene(compliance, {0.3, 0.2, kRadius}, {0, 0, -1}, 1e-5);
  scene.begin();
  double peak = 0.0;
  do {
    scene.step();
    peak = std::max(peak, scene.balls.force(0)[2]);
  } while (!scene.is_over());
  const double x = std::pow(peak / kK, 2.0 / 3.0);
  EXPECT_NEAR(0.4 * peak * x - 0.5 * c * peak * peak, 0.5, 1e-7);
  EXPECT_GT(1.5 * c * kK * std::sqrt(x), 0.25);
  EXPECT_NEAR(scene.balls.velocity(0)[2], 1.0, 1e-7);
}

// Over the ripples of c a ball that slides while it bounces is accelerated and braked, and no energy is lost.
TEST(ComplianceCorrection, ASlidingContactIsConservative) {
  Ripples compliance(1.5e-4, 0.4);
  for (const double phase : {0.0, 0.3, 0.7, 1.3, 1.7}) {
    Scene scene(compliance, {-2.0 + phase, -1.1, kRadius}, {3, 1, -1}, 1e-5,
                phase > 1.0 ? Sheet::rational : Sheet::plane);
    scene.begin();
    double fastest = 0.0;
    do {
      scene.step();
      fastest = std::max(fastest, std::abs(scene.balls.velocity(0)[0] - 3.0));
    } while (!scene.is_over());
    EXPECT_NEAR(scene.balls.velocity(0).squaredNorm(), 11.0, 2e-7) << phase;
    EXPECT_GT(fastest, 1e-3);
  }
}

// Where 1/2 m V^2 = 2/5 K x^(5/2) (1 - 5 s/6).
TEST(ComplianceCorrection, ManyBouncesGainNothingUpToTheLimit) {
  for (const double s : {0.5, 0.7, 0.83}) {
    const double x = std::pow(1.25 / kK / (1.0 - 5.0 / 6.0 * s), 0.4), c = s / (1.5 * kK * std::sqrt(x));
    Ripples compliance(c, 0.02);
    Scene scene(compliance, {-2.1, -1.2, kRadius}, {0.3, 0.2, -1}, 4e-5);
    scene.begin();
    double height = kRadius + 0.02, stiffest = 0.0;
    for (int bounces = 0; bounces < 200;) {
      const bool falls = scene.balls.velocity(0)[2] < 0.0;
      scene.step();
      if (falls && scene.balls.velocity(0)[2] >= 0.0) ++bounces;
      if (!scene.loop->contacts().empty()) stiffest = std::max(stiffest, scene.model.seen.overlap);
      keep_above(scene, height, 3.0);
    }
    while (!scene.is_over()) scene.step();
    EXPECT_NEAR(scene.balls.velocity(0).squaredNorm() / 1.13, 1.0, 1e-4) << s;
    EXPECT_NEAR(1.5 * c * kK * std::sqrt(stiffest), s, 0.06);
  }
}

// Over a hill the foot is slower than the ball, in a hollow faster, and the force along the surface as much
// less or more.
TEST(ComplianceCorrection, ASlidingContactIsConservativeOnCurvedWalls) {
  Ripples compliance(1.5e-4, 0.4);
  for (const Sheet kind : {Sheet::hill, Sheet::hollow})
    for (const double x : {-1.0, -0.3, 0.4}) {
      const double height = (kind == Sheet::hill ? -0.125 : 0.125) * (x * x + 0.25);
      Scene scene(compliance, {x, -0.5, height + (kind == Sheet::hill ? 1.05 : 1.3) * kRadius}, {3, 1, -1},
                  1e-5, kind);
      scene.begin();
      for (const bool before : {true, false})
        while (scene.loop->contacts().empty() == before && scene.step_number < 40000) scene.step();
      ASSERT_LT(scene.step_number, 40000);
      EXPECT_NEAR(scene.balls.velocity(0).squaredNorm(), 11.0, 1e-6) << x;
    }
}

TEST(ComplianceCorrection, ModelsSeeTheirOwnOverlapAndItsRate) {
  const double c = 1.5e-4, overlap = 0.02;
  Ripples compliance(c, 0.0);
  Scene scene(compliance, {0.3, 0.2, kRadius - overlap}, {0.5, 0, -2}, 1e-5);
  scene.begin();
  const contact::Contact& seen = scene.model.seen;
  const auto [x, s] = own_overlap(overlap, c);
  EXPECT_NEAR(seen.overlap, x, 1e-15);
  EXPECT_NEAR(seen.delta.norm(), kRadius - x, 1e-15);
  EXPECT_NEAR(seen.wall_velocity[2], 2.0 / (1.0 - s) - 2.0, 1e-12);
  EXPECT_EQ(seen.wall_velocity[0], 0.0);
  // and others the geometry
  EXPECT_NEAR(scene.loop->contacts()[0].overlap, overlap, 1e-15);
  const contact::Contact& told = scene.loop->contacts()[0];
  EXPECT_NEAR(told.centre[2] - told.delta[2], 0.0, 1e-15);
}

/// A ball at rest, this deep, behind c: it runs at `below` times this time step, and is refused at `above`.
void expect_stable_up_to(double step, double below, double above, double overlap, double c,
                         double damping = 0.0) {
  for (const bool is_stable : {true, false}) {
    Ripples compliance(c, 0.0);
    Scene scene(compliance, {0.3, 0.2, kRadius - overlap}, {0, 0, 0}, (is_stable ? below : above) * step);
    scene.model.damping = damping;
    const nurbs::NodalVectors inverse_mass = nurbs::NodalVectors::Zero(3, 100);
    if (is_stable)
      EXPECT_NO_THROW(scene.begin(inverse_mass));
    else
      EXPECT_THAT([&] { scene.begin(inverse_mass); },
                  ThrowsMessage<std::runtime_error>(HasSubstr("too stiff")));
  }
}

TEST(ComplianceCorrection, IsAsStiffAsItIsToTheTimeStep) {
  const double overlap = 0.02, c = 1.5e-4;
  const auto [x, s] = own_overlap(overlap, c);
  const double tangent = 1.5 * kK * std::sqrt(x) / (1.0 - s);
  expect_stable_up_to(2.0 / std::sqrt(tangent), 0.9995, 1.0005, overlap, c);
}

// k dt^2 + 2 gamma dt = 4 for a mass of 1.  The damper follows the surface by 0.3 of its way in a step here,
// so at once it is a spring of 0.3 gamma/dt.
TEST(ComplianceCorrection, DampingHasItsShareOfTheTimeStep) {
  const double overlap = 0.02, c = 1.5e-4, damping = 200.0;
  const double gamma = damping * std::pow(kRadius * overlap, 0.25), S = 1.5 * kK * std::sqrt(overlap);
  const auto stable = [&](double k) { return 4.0 / (gamma + std::sqrt(gamma * gamma + 4.0 * k)); };
  double step = stable(S);
  for (int i = 0; i < 50; ++i) {
    const double spring = 0.3 * gamma / step;
    const double s = own_overlap(overlap * (1.0 - c * spring), c, spring).s;
    step = stable((S + spring) / (1.0 - s));
  }
  EXPECT_LT(step, 0.8 * stable(0.0));
  expect_stable_up_to(step, 0.999, 1.001, overlap, c, damping);
}

/// Hertz' law for some, damped for others, with springs along the surface for some of both.
class Mixed final : public contact::ContactModel {
 public:
  static constexpr int kSpring = 3;  // numbers in the history
  Mixed(test::Balls& balls, double dt) : balls_(balls), dt_(dt) {}
  void evaluate(contact::Contact* contacts, int count) override {
    for (contact::Contact* c = contacts; c < contacts + count; ++c) {
      const Vector3 n = c->delta / c->distance, slip = this->slip(*c);
      const double x = std::max(c->overlap, 0.0), root = std::sqrt(x * c->effective_radius);
      const double damping = hertz_damping(c->particle) * std::sqrt(root);
      const Vector3 along = slip - n.dot(slip) * n;
      Eigen::Map<Vector3> stretch(c->history);
      stretch += dt_ * along + c->correction->further_slip;
      c->force = (kConstant * root * x - damping * n.dot(slip)) * n;
      if (shear_constant(c->particle) > 0.0)
        c->force -= shear_constant(c->particle) * root * stretch + 0.5 * damping * along;
      c->torque.setZero();
    }
  }
  int kind(int i) const { return balls_.tag[i] % 4; }
  double hertz_constant(int) const override { return kConstant; }
  double hertz_damping(int i) const override { return kind(i) < 2 ? 0.0 : 20.0 * kind(i); }
  double shear_constant(int i) const override { return kind(i) % 2 == 0 ? 0.0 : 0.8 * kConstant; }
  Vector3 shear_stretch(const contact::Contact& c) const override { return Vector3::Map(c.history); }
  Vector3 slip(const contact::Contact& c) const override {
    return balls_.velocity(c.particle) - c.wall_velocity;
  }

 private:
  test::Balls& balls_;
  double dt_;
};

/// Some balls over a sheet with ripples, for a while.  The result are their places and velocities.
std::vector<double> places_of(const std::vector<int>& numbers) {
  constexpr double kDt = 1e-4;
  Ripples compliance(1e-4, 0.3);
  compliance.along = {coupling::LocalCompliance::Component{5e-5, {1e-5, 0}},
                      coupling::LocalCompliance::Component{6e-5, {0, 1e-5}},
                      coupling::LocalCompliance::Component{1e-6, {0, 0}}};
  test::RisingSheet sheet(sheet_of(Sheet::plane), 0.0);
  sheet.compliance = &compliance;
  sheet.set_time_step(kDt);
  test::Balls balls(2, contact::ComplianceCorrection::kMemory + Mixed::kSpring);
  for (const int k : numbers) {
    balls.add({0.19 * (k % 7) - 0.5, 0.17 * (k / 7) - 0.6, kRadius + 0.002 * (k % 5) - 0.004}, kRadius,
              {0.3 * (k % 3), 0.1, -0.5 - 0.05 * (k % 4)});
    balls.tag.back() = 1 + k;
  }
  coupling::SurfaceExchange exchange(MPI_COMM_SELF, sheet);
  contact::ContactLoop loop(sheet, exchange, contact::ContactLoop::Options{});
  loop.wall().import();
  loop.build_list(balls.view(), {4.0, 1.0, kDt, {{-9, -9, -9}, {9, 9, 9}, {false, false, false}}});
  Mixed model(balls, kDt);
  for (int step = 0; step < 60; ++step) {
    std::fill(balls.f.begin(), balls.f.end(), 0.0);
    std::fill(balls.torque.begin(), balls.torque.end(), 0.0);
    loop.step(balls.view(), {step, kDt, 1.0, step == 0}, model);
    for (std::size_t k = 0; k < balls.x.size(); ++k) balls.x[k] += kDt * (balls.v[k] += kDt * balls.f[k]);
  }
  std::vector<double> all = balls.x;
  all.insert(all.end(), balls.v.begin(), balls.v.end());
  return all;
}

// More than are corrected together, of all kinds.
TEST(ComplianceCorrection, EachOfManyContactsIsAsItIsAlone) {
  std::vector<int> numbers(45);
  for (int k = 0; k < 45; ++k) numbers[k] = k;
  const std::vector<double> together = places_of(numbers);
  for (const int k : numbers) {
    const std::vector<double> alone = places_of({k});
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(together[3 * k + d], alone[d]) << k;
      EXPECT_EQ(together[135 + 3 * k + d], alone[3 + d]) << k;
    }
  }
}

TEST(ComplianceCorrection, DampedContactsNeedRoomInTheMemory) {
  Ripples compliance(1e-5, 0.0);
  Scene scene(compliance, {0.3, 0.2, kRadius - 0.01}, {0, 0, 0}, 1e-5);
  scene.balls = test::Balls();
  scene.balls.add({0.3, 0.2, kRadius - 0.01}, kRadius);
  scene.model.damping = 1.0;
  EXPECT_THAT([&] { scene.begin(); },
              ThrowsMessage<std::logic_error>(HasSubstr("room for 0 numbers, expected 28 more")));
}

TEST(ComplianceCorrection, SaysWhereElementsAreTooSmall) {
  Ripples compliance(1e-3, 0.0);
  Scene scene(compliance, {0.3, 0.2, kRadius - 0.01}, {0, 0, 0}, 1e-5);
  EXPECT_THAT([&] { scene.begin(); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("elements at (0.3, 0.2, 0)"),
                        HasSubstr("particle 1 (radius 0.5, overlap 0.01) at step 1"),
                        HasSubstr("expected at most 0.9"), HasSubstr("or 'compliance none'"))));
}

}  // namespace
