// SPDX-License-Identifier: GPL-2.0-or-later
// All instruction sets of this machine find the same feet, one point at a time or several.
#include "nurbs/simd_level.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "feet.h"
#include "nurbs/kernel_choice.h"
#include "trial_surfaces.h"

namespace search {
namespace {

using namespace nurbs;
using namespace nurbs::trials;

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> found;
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512})
    if (available(level)) found.push_back(level);
  return found;
}

template <int number>
int number_of() {
  return number;
}

TEST(KernelChoice, TakesTheOneOfTheLevel) {
  for (const SimdLevel level : levels())
    EXPECT_EQ(kernel_of(level, number_of<0>, number_of<1>, number_of<2>)(), static_cast<int>(level));
}

// Sets the variable that names the level for as long as it lives.
class Wanted {
 public:
  explicit Wanted(const char* level) {
    const char* before = std::getenv(kName);
    if (before != nullptr) before_ = before;
    had_ = before != nullptr;
    setenv(kName, level, 1);
  }
  ~Wanted() { had_ ? setenv(kName, before_.c_str(), 1) : unsetenv(kName); }

 private:
  static constexpr const char* kName = "LIGGGHTS_NURBS_SIMD";
  std::string before_;
  bool had_;
};

struct Query {
  Vector3 d;
  Parameter<2> guess;
};

// Near the surface and far from it, above edges, corners and knot lines, guesses up to two elements off.
std::vector<Query> queries(shapes::Random& random, const TrialSurface& trial, int count) {
  const SurfaceProjector projector(trial.surface.space, trial.surface.control_points);
  std::vector<Query> result(count);
  constexpr double kOff[] = {0.0, 0.01, 0.2, 2.0};
  for (int k = 0; k < count; ++k) {
    result[k].d = random_point(random, trial, static_cast<Place>(k % kPlaces));
    const Parameter<2> foot = projector.cold(result[k].d).xi;
    result[k].guess = guess_beside(random, trial.surface.space, foot, kOff[k % 4]);
  }
  return result;
}

// To the last bit: the same turns at every decision, whatever the neighbours in a word do.
TEST(SimdLevel, BatchesFindTheFeetOfSinglePoints) {
  int points = 0, inside = 0;
  for (int k = 0; k < 240; ++k) {
    std::seed_seq seeds{41, k};
    shapes::Random random(seeds);
    const TrialSurface trial = random_surface(random, static_cast<Family>(k % kFamilies));
    const std::vector<Query> given = queries(random, trial, 17 + k % 9);  // no multiple of a word
    std::vector<Vector3> d;
    std::vector<Parameter<2>> guesses;
    for (const Query& query : given) d.push_back(query.d), guesses.push_back(query.guess);
    for (const SimdLevel level : levels()) {
      const SurfaceProjector projector(trial.surface.space, trial.surface.control_points, level);
      const std::vector<Foot> batch = closest_from(projector, d, guesses);
      for (size_t i = 0; i < given.size(); ++i) {
        const Foot one = projector.warm(d[i], guesses[i]);
        SCOPED_TRACE(testing::Message() << name(level) << ", surface " << k << ", point " << i);
        EXPECT_EQ(batch[i].status, one.status);
        EXPECT_EQ(batch[i].iterations, one.iterations);
        EXPECT_EQ(batch[i].point, one.point);
        EXPECT_EQ(batch[i].distance, one.distance);
        EXPECT_EQ(batch[i].xi, one.xi);
        ++points, inside += one.status == FootStatus::interior;
      }
    }
  }
  EXPECT_GT(inside, points / 3);
  EXPECT_LT(inside, points);
}

// The same of guesses on the ends of the patch, beyond them, a bit from its knots, and of none at all.
TEST(SimdLevel, BatchesStartWhereSinglePointsDo) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const KnotVector equal = KnotVector::uniform(2, 7, 0.1, 0.8),
                   graded = KnotVector::from_breaks(3, {0.1, 0.11, 0.13, 0.17, 0.3, 0.8});
  std::seed_seq seeds{43};
  shapes::Random random(seeds);
  for (const auto& [u, v] : {std::pair{equal, graded}, std::pair{graded, equal}, std::pair{equal, equal}}) {
    const Surface hills = shapes::random_hills(random, {u, v}, 0.1, false);
    std::vector<double> xi[2];
    for (int i = 0; i < 2; ++i) {
      xi[i] = {-kInfinity, -3.0, 5.0, kInfinity, std::nan("")};
      for (const double knot : hills.space.knots(i).breaks())
        for (const double to : {-kInfinity, knot, kInfinity}) xi[i].push_back(std::nextafter(knot, to));
    }
    std::vector<Parameter<2>> guesses;
    for (const double xi_0 : xi[0])
      for (const double xi_1 : xi[1]) guesses.push_back({xi_0, xi_1});
    const std::vector<Vector3> d(guesses.size(), Vector3(0.45, 0.45, 0.3));
    for (const SimdLevel level : levels()) {
      const SurfaceProjector projector(hills.space, hills.control_points, level);
      const std::vector<Foot> batch = closest_from(projector, d, guesses);
      for (size_t i = 0; i < guesses.size(); ++i) {
        const Foot one = projector.warm(d[i], guesses[i]);
        SCOPED_TRACE(testing::Message()
                     << name(level) << ", guess " << guesses[i][0] << " " << guesses[i][1]);
        EXPECT_EQ(batch[i].status, one.status);
        EXPECT_EQ(batch[i].iterations, one.iterations);
        if (one.status == FootStatus::not_converged) continue;
        EXPECT_EQ(batch[i].xi, one.xi);
        EXPECT_EQ(batch[i].point, one.point);
      }
    }
  }
}

TEST(SimdLevel, LevelsAgree) {
  for (int k = 0; k < 240; ++k) {
    std::seed_seq seeds{42, k};
    shapes::Random random(seeds);
    const TrialSurface trial = random_surface(random, static_cast<Family>(k % kFamilies));
    const SurfaceProjector portable(trial.surface.space, trial.surface.control_points, SimdLevel::portable);
    for (const SimdLevel level : levels()) {
      const SurfaceProjector projector(trial.surface.space, trial.surface.control_points, level);
      for (const Query& query : queries(random, trial, 12)) {
        const Foot expected = portable.cold(query.d), found = projector.cold(query.d);
        SCOPED_TRACE(testing::Message() << name(level) << ", surface " << k);
        EXPECT_NEAR(found.distance, expected.distance, 1e-10 * trial.element + 1e-13 * expected.distance);
      }
    }
  }
}

TEST(SimdLevel, TheEnvironmentChooses) {
  for (const SimdLevel level : levels()) {
    const Wanted wanted(name(level));
    EXPECT_EQ(simd_level(), level);
  }
  EXPECT_TRUE(available(SimdLevel::portable));
}

TEST(SimdLevel, OtherNamesAreRefused) {
  const Wanted wanted("sse9");
  try {
    simd_level();
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("\"sse9\", expected portable, avx2 or avx512"));
  }
}

}  // namespace
}  // namespace search
