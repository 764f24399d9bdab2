// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles of trimmed faces are as near them as was asked for.
#include "brep/facets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "brep/builder.h"
#include "brep/faced_patches.h"
#include "brep/foot_search.h"
#include "nurbs/borders.h"

namespace brep {
namespace {

// `turns` of a wave, whose middle is on its chord, or of a helix, which comes back over where it was.
nurbs::Surface turning(bool helix, int degree, double turns) {
  const int elements = 12, count = elements + degree;
  nurbs::NodalVectors points(3, 2 * count);
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < count; ++k) {
      const double t = static_cast<double>(k) / (count - 1), angle = nurbs::kTwoPi * turns * t;
      points.col(k + count * j) = helix ? Vector3((1.0 + j) * std::cos(angle), (1.0 + j) * std::sin(angle), t)
                                        : Vector3(4.0 * t, 1.0 * j, 0.3 * std::sin(angle));
    }
  return {
      nurbs::Space<2>({nurbs::KnotVector::uniform(degree, elements), nurbs::KnotVector::uniform(1, 1)}, {}),
      points};
}

class FacetsOf : public testing::TestWithParam<std::tuple<bool, int, double>> {};

TEST_P(FacetsOf, AreWithinTheChord) {
  const auto [helix, degree, turns] = GetParam();
  const std::vector<nurbs::Surface> patches{turning(helix, degree, turns)};
  const Surface wall = from_cad(model_of(patches, nurbs::find_borders(patches)), {0}, 0.02);
  for (const double chord : {0.05, 0.01}) {
    const nurbs::TriangleMesh mesh = facets_of(wall, chord).mesh;
    std::vector<int> corners;
    for (const auto& triangle : mesh.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    const Surface triangles = from_triangles(mesh.vertices, corners);
    const FootSearch search(triangles);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<int> near;
    double farthest = 0.0;
    for (int k = 0; k < 500; ++k) {
      const Vector3 d = wall.patches->point(0, {uniform(random), uniform(random)});
      near.clear();
      search.near(d, 0.4, near);
      farthest = std::max(farthest, search.nearest(d, 0.4, near.data(), static_cast<int>(near.size())));
    }
    EXPECT_LE(farthest, 1.5 * chord) << mesh.triangles.size() << " triangles";  // both ways at once
    EXPECT_LT(mesh.triangles.size(), 40 * turns / std::sqrt(chord));
  }
}

INSTANTIATE_TEST_SUITE_P(Turns, FacetsOf,
                         testing::Combine(testing::Bool(), testing::Values(2, 3), testing::Values(1.0, 2.0)));

}  // namespace
}  // namespace brep
