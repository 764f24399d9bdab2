// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/multi_patch_projector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "nurbs/primitives.h"

namespace nurbs {
namespace {

// On a closed surface a foot within round-off of the seam is one minimum: neither two nor none.
TEST(MultiPatchProjector, MinimaAtASeam) {
  const PatchedSurface ball = join(
      {sphere(frame({0, 0, 0}, {0, 0, 1}), 1.0, refined(arc(0, 360), 8, 2), refined(arc(-90, 0), 4, 2))});
  MultiPatchProjector projector(ball.topology);
  projector.set_control_points(ball.control_points);
  std::vector<int> elements(ball.topology.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  for (const double off : {0.0, 1e-19, 1e-17, 1e-16, 3e-16, 1e-15, 1e-13, 1e-9})
    for (const double sign : {-1.0, 1.0})
      for (int k = 1; k < 200; ++k) {
        const double latitude = -1.57 * k / 200.0;
        const Vector3 d(0.9 * std::cos(latitude), sign * off, 0.9 * std::sin(latitude));
        std::vector<SurfaceFoot> feet;
        projector.add_minima(d, Vector3::Zero(), 0.11, 1e-7, elements.data(),
                             static_cast<int>(elements.size()), feet);
        ASSERT_EQ(feet.size(), 1U) << "y = " << sign * off << ", latitude " << latitude;
        EXPECT_NEAR(feet[0].distance, 0.1, 1e-13);
      }
}

}  // namespace
}  // namespace nurbs
