// SPDX-License-Identifier: GPL-2.0-or-later
// What every contact law must fulfil: a law is tested by being listed.
#include "contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using liggghts_pkg::LawForce;

constexpr double kRadius = 1e-3, kModulus = 5e10;  // E*
constexpr double kDeepest = 5e-6;                  // overlap

/// A law with a memory of its own, as a contact has it.  Its properties, in its units, are such that all laws
/// are about as stiff as Hertz', and that one which yields does so at a tenth of kDeepest.
template <class Law>
class Contact {
 public:
  Contact() : history_(Law::history.size(), 0.0) {
    for (const auto& property : Law::properties) {
      const bool is_pressure = property.name == std::string("yieldPressure");
      const double yield = 2.0 * kModulus / M_PI * std::sqrt(0.1 * kDeepest / kRadius);
      properties_.push_back(is_pressure ? yield : std::pow(kDeepest, property.length_power));
    }
  }

  /// The answer at an overlap; the history goes on unless it is only looked at.
  LawForce at(double d, bool look = false) {
    std::vector<double> next(history_.size(), std::nan(""));
    const LawForce law =
        Law::evaluate({kRadius, d, kModulus, properties_.data()}, history_.data(), next.data());
    if (!look) history_ = next;
    return law;
  }
  double force(double d, bool look = false) { return at(d, look).secant * d; }
  const std::vector<double>& history() const { return history_; }

 private:
  std::vector<double> properties_, history_;
};

TEST(ContactLaws, WordsAndIdsAreTheirOwn) {
  std::set<std::string> words;
  std::set<int> ids;
  liggghts_pkg::for_each_law([&](auto law) {
    EXPECT_TRUE(words.insert(law.word).second) << law.word;
    EXPECT_TRUE(ids.insert(law.id).second) << law.word;
    EXPECT_GE(law.id, 40) << law.word;  // below are LIGGGHTS' own
    EXPECT_LT(law.id, 64) << law.word;  // six bits
    EXPECT_NEAR(law.damping_factor, std::sqrt((law.exponent + 1) / (2 * law.exponent)), 1e-15) << law.word;
  });
}

TEST(ContactLaws, TangentIsTheDerivativeOfTheForce) {
  liggghts_pkg::for_each_law([](auto law) {
    Contact<decltype(law)> contact;
    for (double d = 0.02 * kDeepest; d < kDeepest; d *= 1.1) {  // loading
      const double h = 1e-4 * d, before = contact.force(d - h), tangent = contact.at(d).tangent;
      EXPECT_NEAR((contact.force(d + h) - before) / (2 * h) / tangent, 1.0, 1e-4) << law.word << " at " << d;
    }
    contact.at(kDeepest);
    for (double d = 0.999 * kDeepest; contact.force(d) > 0.1 * contact.force(kDeepest); d *= 0.99) {
      const double h = 1e-5 * d, tangent = contact.at(d).tangent;
      const double difference = contact.force(d + h, true) - contact.force(d - h, true);
      EXPECT_NEAR(difference / (2 * h) / tangent, 1.0, 1e-4) << law.word << " unloading at " << d;
    }
  });
}

TEST(ContactLaws, ForceHasNoJumpsAndPushes) {
  liggghts_pkg::for_each_law([](auto law) {
    Contact<decltype(law)> contact;
    const double step = 1e-4 * kDeepest;
    double previous = contact.force(0.0), stiffest = 0.0;
    EXPECT_EQ(previous, 0.0);
    for (int k = 1; k <= 30000; ++k) {  // up and down, each time deeper
      const double d = kDeepest * k / 30000. * std::abs(std::sin(M_PI * k / 5000.));
      const LawForce answer = contact.at(d);
      stiffest = std::max(stiffest, answer.tangent);
      const double force = answer.secant * d;
      EXPECT_GE(force, 0.0) << law.word;
      EXPECT_LE(std::abs(force - previous), 20 * stiffest * step) << law.word << " at " << d;
      previous = force;
    }
  });
}

// A step that ends where the overlap does, whatever has been before: round-off of the memory is no overlap.
TEST(ContactLaws, HaveNoForceWithoutOverlap) {
  liggghts_pkg::for_each_law([](auto law) {
    for (int k = 0; k < 2000; ++k) {
      Contact<decltype(law)> contact;
      contact.at(0.1 * kDeepest * (1.0 + 1e-11 * k));  // from where yielding begins
      const LawForce answer = contact.at(0.0);
      ASSERT_EQ(answer.secant * 0.0, 0.0) << law.word << " after step " << k;
      ASSERT_TRUE(std::isfinite(answer.tangent) && std::isfinite(answer.contact_radius)) << law.word;
    }
  });
}

TEST(ContactLaws, MemoryDependsOnThePathAlone) {
  liggghts_pkg::for_each_law([](auto law) {
    Contact<decltype(law)> contact;
    for (double d : {0.3, 1.0, 0.7, 0.9, 0.2, 0.0, 0.6}) {
      const double once = contact.force(d * kDeepest);
      const std::vector<double> remembered = contact.history();
      EXPECT_EQ(contact.force(d * kDeepest), once) << law.word;  // a step in which nothing moves
      EXPECT_EQ(contact.history(), remembered) << law.word;
    }
  });
}

TEST(ContactLaws, NoPathGivesEnergy) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, kDeepest);
  liggghts_pkg::for_each_law([&](auto law) {
    Contact<decltype(law)> contact;
    double given = 0.0, turned_over = 0.0, d = 0.0, force = 0.0;
    for (int leg = 0; leg < 20; ++leg) {
      const double to = leg == 19 ? 0.0 : anywhere(random), from = d;
      for (int k = 1; k <= 1000; ++k) {
        const double d_next = from + (to - from) * k / 1000, next = contact.force(d_next);
        given -= 0.5 * (force + next) * (d_next - d);
        turned_over += 0.5 * (force + next) * std::abs(d_next - d);
        d = d_next, force = next;
      }
    }
    EXPECT_LE(given, 1e-6 * turned_over) << law.word;
    if (law.history.empty()) {
      EXPECT_NEAR(given / turned_over, 0.0, 1e-6) << law.word;
    }
  });
}

}  // namespace
