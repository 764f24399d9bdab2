// SPDX-License-Identifier: GPL-2.0-or-later
// What is remembered for cells of space is what the search says, wherever a point is and however far it
// reaches.
#include "brep/near_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "brep/builder.h"
#include "mixed_trial.h"
#include "trial_walls.h"
#include "trials.h"

namespace brep {
namespace {

using trials::Given;

// Points in and around the box of a wall, each with a reach from a hundredth of a percent of its size to more
// than all of it.
template <class Function>
void for_points(const Surface& surface, int count, Function f) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vector3 half = 0.5 * (surface.high - surface.low);
  const double room = 0.1 * surface.size;
  for (int k = 0; k < count; ++k) {
    const Vector3 off(uniform(random), uniform(random), uniform(random));
    const Vector3 d = 0.5 * (surface.low + surface.high) + (half.array() + room).matrix().cwiseProduct(off);
    f(d, surface.size * std::pow(10.0, -1.9 + 2.1 * uniform(random)));
  }
}

class NearCellsOf : public testing::TestWithParam<Given> {};

TEST_P(NearCellsOf, HaveTheSearchsFeet) {
  for (int index = 0; index < trials::kMixedFamilies; ++index) {
    const trials::MixedTrial trial(11, index, GetParam());
    const Surface& surface = trial.surface();
    const FootSearch search(surface);
    NearCells cells(search);
    std::vector<int> remembered, found;
    std::vector<Foot> of_remembered, of_found;
    for (int time = 0; time < 2; ++time)  // the second time from memory
      for_points(surface, 300, [&](const Vector3& d, double reach) {
        remembered.clear(), found.clear(), of_remembered.clear(), of_found.clear();
        cells.near(d, reach, remembered);
        search.near(d, reach, found);
        EXPECT_TRUE(std::is_sorted(remembered.begin(), remembered.end()));
        search.feet(d, reach, remembered.data(), static_cast<int>(remembered.size()), of_remembered);
        search.feet(d, reach, found.data(), static_cast<int>(found.size()), of_found);
        ASSERT_EQ(of_remembered.size(), of_found.size()) << index << " at " << d.transpose();
        for (std::size_t k = 0; k < of_found.size(); ++k)
          EXPECT_EQ(of_remembered[k].point, of_found[k].point) << index << " at " << d.transpose();
      });
  }
}

INSTANTIATE_TEST_SUITE_P(Given, NearCellsOf,
                         testing::Values(Given::plainly, Given::as_cad, Given::as_patches),
                         [](const auto& of) {
                           return of.param == Given::plainly  ? "Plainly"
                                  : of.param == Given::as_cad ? "AsCad"
                                                              : "AsPatches";
                         });

// Few triangles, and more than are worth remembering.
TEST(NearCells, HaveTheTrianglesOfTheSearch) {
  const auto waves = [](double x, double y) { return 0.1 * std::sin(7.0 * x) * std::cos(5.0 * y); };
  for (const trials::Wall& wall : {trials::cube(), trials::l_profile(), trials::field(40, waves)}) {
    const Surface surface = built(wall);
    const FootSearch search(surface);
    NearCells cells(search, 500);  // forgets them now and then
    std::vector<int> remembered, found;
    for (int time = 0; time < 2; ++time)
      for_points(surface, 2000, [&](const Vector3& d, double reach) {
        remembered.assign(1, -7), found.assign(1, -7);  // what is there stays
        cells.near(d, reach, remembered);
        search.near(d, reach, found);
        EXPECT_EQ(remembered, found) << d.transpose() << ", reach " << reach;
      });
  }
}

// A point or a reach that is no number, or beyond all bounds.
TEST(NearCells, StandWhatIsNoPoint) {
  const trials::Wall wall = trials::cube();
  const Surface surface = built(wall);
  const FootSearch search(surface);
  NearCells cells(search);
  std::vector<int> pieces;
  const double huge = 1e300;
  for (const Vector3& d : {Vector3(NAN, 0.0, 0.0), Vector3(huge, 0.0, 0.0), Vector3(0.0, -huge, huge)}) {
    cells.near(d, 0.1, pieces);
    EXPECT_TRUE(pieces.empty());
  }
  cells.near(Vector3::Zero(), huge, pieces);
  EXPECT_EQ(pieces.size(), surface.pieces.size());
}

}  // namespace
}  // namespace brep
