// SPDX-License-Identifier: GPL-2.0-or-later
// What a particle remembers of the pieces near it is what the search says, wherever it goes.
#include "coupling/contact/near_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../../iga-solver/brep/mixed_trial.h"

namespace contact {
namespace {

using nurbs::Vector3;
namespace trials = brep::trials;
using trials::Given;

// Particles that wander round a wall, some slowly, some fast, and now and then change their numbers.
TEST(NearLists, AreThoseOfTheSearch) {
  constexpr int kParticles = 20, kLists = 60;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  for (int index = 0; index < 2 * trials::kMixedFamilies; ++index) {
    const trials::MixedTrial trial(11, index / 2, index % 2 == 0 ? Given::plainly : Given::as_cad);
    const brep::Surface& surface = trial.surface();
    const brep::FootSearch search(surface);
    brep::NearCells cells(search);
    NearLists lists(search, cells);
    std::vector<Vector3> place(kParticles), step(kParticles);
    for (int i = 0; i < kParticles; ++i) {
      const Vector3 half = 0.6 * (surface.high - surface.low);
      place[i] = 0.5 * (surface.low + surface.high) + half.cwiseProduct(vector());
      step[i] = surface.size * std::pow(10.0, -2.5 + 1.5 * uniform(random)) * vector();
    }
    int empty = 0, far = 0;
    std::vector<int> listed, near;
    for (int list = 0; list < kLists; ++list) {
      if (list % 20 == 19) std::reverse(place.begin(), place.end());
      for (int i = 0; i < kParticles; ++i) {
        if (list % 10 == 0) step[i] *= -1.0;
        place[i] += step[i];
        const double reach = 0.1 * surface.size * (1.0 + 1e-3 * uniform(random));
        listed.clear(), near.clear();
        lists.near(i, place[i], reach, listed);
        search.near(place[i], reach, near);
        near.resize(
            search.activate(place[i], reach, near.data(), static_cast<int>(near.size()), near.data()));
        ASSERT_TRUE(std::is_sorted(listed.begin(), listed.end()));
        ASSERT_TRUE(std::includes(listed.begin(), listed.end(), near.begin(), near.end())) << index;
        const double leeway = 1e-4 * surface.size;
        EXPECT_EQ(listed.empty(), !(search.nearest(place[i], reach + leeway, listed.data(),
                                                   static_cast<int>(listed.size())) < reach + leeway))
            << index << " at " << place[i].transpose();
        empty += static_cast<int>(near.empty());
        far += static_cast<int>(listed.size() > near.size());
      }
    }
    EXPECT_GT(empty, 0) << index;
    EXPECT_GT(far, 0) << index;
  }
}

}  // namespace
}  // namespace contact
