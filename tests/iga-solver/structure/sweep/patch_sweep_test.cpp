// SPDX-License-Identifier: GPL-2.0-or-later
// Sweeps give what the plain loop over elements gives: every degree, rational or not, every law, quadrature,
// way to find the Jacobian, and instruction set of this machine.
#include "structure/sweep/patch_sweep.h"
#include "structure/sweep/affine_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "models.h"
#include "nurbs/refinement.h"
#include "standard_linear_solid.h"
#include "structure/material/laws.h"
#include "structure/material/plate_material.h"
#include "structure/solid/element_loop.h"

namespace {

using models::NodalVectors;
using nurbs::SimdLevel;
using structure::ElementLoop;
using structure::GeometryMode;
using structure::Material;
using structure::Matrix3;
using structure::PatchSweep;
using structure::PointMemory;
using structure::Quadrature;

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> found;
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512})
    if (nurbs::available(level)) found.push_back(level);
  return found;
}

std::vector<std::shared_ptr<const Material>> laws() {
  std::vector<std::shared_ptr<const Material>> made{
      std::make_shared<test::StandardLinearSolid>(2.0, 0.3, 1.0, 0.3, 2.0)};
  for (const structure::MaterialLaw& law : structure::material_laws())
    made.push_back(models::make_law(law, 2.0));
  for (const int k : {1, 2}) made.push_back(structure::with_plate_shear(*made[k], {1, 2, 3}));
  return made;
}

/// Weights from 0.8 to 1.2.
nurbs::Volume rational(const nurbs::Volume& patch) {
  const NodalVectors noise = models::random_vectors(patch.space.control_point_count(), 5);
  std::vector<double> weights;
  for (Eigen::Index A = 0; A < noise.cols(); ++A) weights.push_back(1.0 + 0.2 * noise(0, A));
  return {nurbs::Space<3>(patch.space.knots(), weights), patch.control_points};
}

/// Knots of all multiplicities in each direction.
nurbs::Volume with_repeated_knots(nurbs::Volume patch) {
  for (int d = 0; d < 3; ++d) {
    const std::vector<double> breaks = patch.space.knots(d).breaks();
    patch = nurbs::insert_knots(patch, d, std::vector<double>(patch.space.degree(d) - 1, breaks[1]));
  }
  return patch;
}

double largest(const NodalVectors& f) { return f.cwiseAbs().maxCoeff(); }

/// Forces before and after memory has evolved, energies, and row sums.
void expect_equal(const nurbs::Volume& patch, const Material& material, Quadrature quadrature,
                  GeometryMode mode) {
  const auto boxes = structure::whole_patch(patch.space);
  const ElementLoop plain(patch.space, patch.control_points, boxes, material, quadrature);
  const NodalVectors u = 0.01 * models::random_vectors(patch.space.control_point_count(), 3);
  const std::size_t remembered = std::size_t(patch.space.element_count()) * material.state_size() *
                                 structure::points_per_element(patch.space, quadrature);
  const std::vector<double> held(remembered, 0.001);
  std::vector<double> next(remembered, 0.0), next_swept(next);
  NodalVectors f(u), evolved(u), swept(u);
  plain.internal_force({held.data()}, u, f);
  plain.internal_force({held.data(), next.data(), 0.7}, u, evolved);
  const double energy = plain.strain_energy({held.data()}, u);
  for (const SimdLevel level : levels()) {
    SCOPED_TRACE(testing::Message() << material.law() << ", " << name(quadrature) << ", mode "
                                    << static_cast<int>(mode) << ", " << nurbs::name(level));
    const PatchSweep sweep(patch.space, patch.control_points, boxes, material, quadrature,
                           {mode, structure::affine_jacobian(patch)}, level);
    sweep.internal_force({held.data()}, u, swept);
    EXPECT_LT(largest(swept - f), 1e-12 * largest(f));
    sweep.internal_force({held.data(), next_swept.data(), 0.7}, u, swept);
    EXPECT_LT(largest(swept - evolved), 1e-12 * largest(evolved));
    if (remembered > 0) {
      EXPECT_LT((Eigen::VectorXd::Map(next_swept.data(), remembered) -
                 Eigen::VectorXd::Map(next.data(), remembered))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-14);
    }
    EXPECT_NEAR(sweep.strain_energy({held.data()}, u), energy, 1e-12 * std::abs(energy));
  }
}

void expect_equal_in_all_ways(const nurbs::Volume& patch, bool affine) {
  for (const auto& material : laws())
    for (const Quadrature quadrature : {Quadrature::full, Quadrature::reduced, Quadrature::zou}) {
      bool for_zou = true;
      for (const nurbs::KnotVector& knots : patch.space.knots()) for_zou = for_zou && knots.degree() <= 3;
      if (quadrature == Quadrature::zou && !for_zou) continue;
      for (const GeometryMode mode : {GeometryMode::affine, GeometryMode::stored, GeometryMode::recomputed})
        if (affine || mode != GeometryMode::affine) expect_equal(patch, *material, quadrature, mode);
    }
}

TEST(PatchSweep, EqualsThePlainLoopOnAffineBlocks) {
  expect_equal_in_all_ways(models::block({1, 2, 1.5}, {5, 3, 4}, 2), true);
  expect_equal_in_all_ways(models::block({1, 2, 1.5}, {2, 1, 11}, 3), true);
}

// Maps that only stretch have loops of their own, for each way to lie along the axes.
TEST(PatchSweep, EqualsThePlainLoopOnAffineImages) {
  const auto image = [](nurbs::Volume patch, const Matrix3& A) {
    patch.control_points = A * patch.control_points;
    return patch;
  };
  const nurbs::Volume block = models::block({1, 2, 1.5}, {5, 3, 9}, 2);
  Matrix3 cyclic, odd, sheared;
  cyclic << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  odd << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  sheared << 1, 0.3, 0, 0, 1, 0, 0.1, 0, 1;
  for (const Matrix3& A : {cyclic, Matrix3(cyclic * cyclic), odd, sheared, Matrix3(sheared * cyclic)})
    expect_equal_in_all_ways(image(block, A), true);
}

TEST(PatchSweep, EqualsThePlainLoopForEveryDegreeAndMixedOnes) {
  for (const std::array<int, 3>& degrees :
       {std::array{2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {2, 3, 4}, {5, 2, 3}, {3, 5, 2}})
    expect_equal_in_all_ways(models::distorted(models::block({1, 2, 1.5}, {3, 9, 2}, degrees), 0.02), false);
}

TEST(PatchSweep, EqualsThePlainLoopOnRationalPatches) {
  for (const std::array<int, 3>& degrees : {std::array{2, 2, 2}, {3, 3, 3}, {2, 4, 3}})
    expect_equal_in_all_ways(
        rational(models::distorted(models::block({1, 2, 1.5}, {9, 2, 3}, degrees), 0.02)), false);
  expect_equal_in_all_ways(models::quarter_ring(2, 3), false);
}

TEST(PatchSweep, EqualsThePlainLoopWhereKnotsAreRepeated) {
  expect_equal_in_all_ways(with_repeated_knots(models::block({1, 2, 1.5}, {9, 3, 2}, 2)), true);
  expect_equal_in_all_ways(
      rational(models::distorted(with_repeated_knots(models::block({1, 2, 1.5}, {2, 3, 10}, 3)), 0.02)),
      false);
}

TEST(PatchSweep, EqualsThePlainLoopOverManyBoxes) {
  const std::array<int, 3> longest = structure::kBoxSpans;
  const nurbs::Volume patch = models::distorted(models::block({1, 2, 1.5}, {2, longest[1] + 5, 2}, 2), 0.01);
  ASSERT_EQ(structure::box_grid(patch.space).size(), 2u);
  expect_equal_in_all_ways(patch, false);
  const nurbs::Volume flat = models::block({1, 2, 1.5}, {2 * longest[0] + 3, 2, longest[2] + 2}, 2);
  ASSERT_EQ(structure::box_grid(flat.space).size(), 6u);
  expect_equal(flat, structure::LinearElastic(1.0, 0.3, 1.0), Quadrature::full, GeometryMode::affine);
}

TEST(PatchSweep, SumsRowsOfTheMassMatrix) {
  for (const nurbs::Volume& patch :
       {models::distorted(models::block({1, 2, 1.5}, {3, 9, 2}, {2, 3, 4}), 0.02), models::quarter_ring(2, 3),
        models::quarter_ring(3, 2)}) {
    const structure::ElementTabulator tabulate(patch.space, Quadrature::full);
    const int functions = patch.space.functions_per_element();
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(patch.space.control_point_count());
    std::vector<int> nodes(functions);
    for (int e = 0; e < patch.space.element_count(); ++e) {
      std::vector<double> sums(functions, 0.0);
      patch.space.element_control_points(e, nodes.data());
      tabulate.add_row_sums(e, {patch.control_points, nodes}, sums.data());
      for (int a = 0; a < functions; ++a) expected[nodes[a]] += sums[a];
    }
    const structure::LinearElastic material(1.0, 0.3, 1.0);
    for (const SimdLevel level : levels()) {
      const PatchSweep sweep(patch.space, patch.control_points, structure::whole_patch(patch.space), material,
                             Quadrature::full, {GeometryMode::recomputed}, level);
      Eigen::VectorXd sums = Eigen::VectorXd::Zero(expected.size());
      const PatchSweep::Volume volume = sweep.add_row_sums(sums);
      EXPECT_LT((sums - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.maxCoeff());
      EXPECT_NEAR(volume.volume.value(), expected.sum(), 1e-13 * expected.sum());
      EXPECT_GT(volume.least_det, 0.0);
    }
  }
}

// A displacement that is no number must not vanish in the padding of a word.
TEST(PatchSweep, HandsOnWhatIsNoNumber) {
  const nurbs::Volume patch = models::block({1, 2, 1.5}, {5, 3, 4}, 2);
  const structure::LinearElastic material(1.0, 0.3, 1.0);
  const PatchSweep sweep(patch.space, patch.control_points, structure::whole_patch(patch.space), material,
                         Quadrature::full, {GeometryMode::affine, structure::affine_jacobian(patch)});
  NodalVectors u = NodalVectors::Zero(3, patch.space.control_point_count()), f(u);
  for (const Eigen::Index node : {Eigen::Index(0), u.cols() / 2, u.cols() - 1}) {
    u.setZero();
    u(1, node) = std::nan("");
    sweep.internal_force({}, u, f);
    EXPECT_FALSE(f.col(node).allFinite()) << node;
  }
}

}  // namespace
