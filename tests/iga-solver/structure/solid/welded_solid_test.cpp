// SPDX-License-Identifier: GPL-2.0-or-later
// Solids of several patches.  A patch with C0 knot planes and the patches that it falls into there have the
// same functions at the same nodes: forces, masses and energies are the same.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "models.h"
#include "nurbs/primitives.h"
#include "structure/weld.h"

namespace {

using models::Matrix3;
using models::NodalVectors;
using models::Vector3;
using nurbs::KnotVector;
using nurbs::Volume;
using structure::Integration;
using structure::IntegrationMethod;
using structure::Material;
using structure::NodeNumbering;
using structure::PatchBoxes;
using structure::Quadrature;
using structure::Solid;

/// Pieces of a direction between its kinks: knots, and the first control point of each.
struct Pieces {
  std::vector<KnotVector> knots;
  std::vector<int> first;
};
Pieces pieces_of(const KnotVector& whole) {
  const int p = whole.degree();
  Pieces pieces;
  int first = 0;
  for (std::size_t c = 0; c + 1 < whole.creases().size(); ++c) {
    std::vector<double> knots{whole.creases()[c]};
    for (const double knot : whole.knots())
      if (whole.creases()[c] <= knot && knot <= whole.creases()[c + 1]) knots.push_back(knot);
    if (c > 0 || whole.creases().size() == 2) knots.erase(knots.begin(), knots.begin() + (c == 0));
    if (c == 0 && whole.creases().size() > 2) knots.erase(knots.begin());
    while (std::count(knots.begin(), knots.end(), knots.back()) < p + 1) knots.push_back(knots.back());
    pieces.knots.emplace_back(p, knots);
    pieces.first.push_back(first);
    first += pieces.knots.back().control_point_count() - 1;
  }
  return pieces;
}

std::vector<Volume> split_at_kinks(const Volume& patch) {
  const nurbs::Space<3>& space = patch.space;
  const Pieces x = pieces_of(space.knots(0)), y = pieces_of(space.knots(1)), z = pieces_of(space.knots(2));
  std::vector<Volume> patches;
  for (std::size_t c = 0; c < z.knots.size(); ++c)
    for (std::size_t b = 0; b < y.knots.size(); ++b)
      for (std::size_t a = 0; a < x.knots.size(); ++a) {
        std::vector<double> weights;
        std::vector<int> nodes;
        for (int k = 0; k < z.knots[c].control_point_count(); ++k)
          for (int j = 0; j < y.knots[b].control_point_count(); ++j)
            for (int i = 0; i < x.knots[a].control_point_count(); ++i) {
              const int node = x.first[a] + i +
                               space.control_point_count(0) *
                                   (y.first[b] + j + space.control_point_count(1) * (z.first[c] + k));
              nodes.push_back(node);
              if (space.rational()) weights.push_back(space.weight(node));
            }
        patches.push_back({nurbs::Space<3>({x.knots[a], y.knots[b], z.knots[c]}, weights),
                           patch.control_points(Eigen::all, nodes)});
      }
  return patches;
}

/// 2 x 2 x 1 pieces, curved and rational.
Volume kinked() {
  const KnotVector x(2, {0, 0, 0, .2, .4, .4, .7, 1, 1, 1}), y(3, {0, 0, 0, 0, .5, .5, .5, .75, 1, 1, 1, 1}),
      z(2, {0, 0, 0, .5, 1, 1, 1});
  const nurbs::Space<3> polynomial({x, y, z});
  std::vector<double> weights;
  for (int a = 0; a < polynomial.control_point_count(); ++a) weights.push_back(1.0 + 0.2 * std::sin(a));
  Volume patch{nurbs::Space<3>({x, y, z}, weights), NodalVectors(3, weights.size())};
  const std::vector<double> u = x.greville(), v = y.greville(), w = z.greville();
  int a = 0;
  for (const double wk : w)
    for (const double vj : v)
      for (const double ui : u) patch.control_points.col(a++) << ui + 0.1 * vj * vj, vj + 0.1 * ui * wk, wk;
  return patch;
}

Solid weld_solid(const std::vector<Volume>& patches, const NodeNumbering& nodes,
                 const std::vector<std::shared_ptr<const Material>>& materials, const Integration& how,
                 int part = 0, int parts = 1) {
  std::vector<structure::MaterialPatch> pieces;
  std::vector<PatchBoxes> boxes;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    pieces.push_back({patches[p], materials[p % materials.size()]});
    boxes.emplace_back(patches[p].space, structure::box_cuts(patches[p].space));
  }
  return {pieces, nodes, how, structure::Partition(boxes, nodes, parts).part(part)};
}

/// Per node of `patches`, that of the patch which stands there.
std::vector<int> nodes_at(const std::vector<Volume>& patches, const NodeNumbering& nodes,
                          const Volume& whole) {
  std::vector<int> at(nodes.node_count(), -1);
  for (structure::Id node = 0; node < nodes.node_count(); ++node) {
    const auto [p, a] = nodes.place(node);
    for (int b = 0; b < whole.control_points.cols(); ++b)
      if ((whole.control_points.col(b) - patches[p].control_points.col(a)).norm() < 1e-12) at[node] = b;
    EXPECT_GE(at[node], 0);
  }
  return at;
}

void expect_same(const Volume& patch, const std::vector<Volume>& patches, const NodeNumbering& one_nodes,
                 const std::shared_ptr<const Material>& law, const Integration& how) {
  const NodeNumbering nodes = structure::weld(patches);
  const Solid welded = weld_solid(patches, nodes, {law}, how),
              one = weld_solid({patch}, one_nodes, {law}, how);
  ASSERT_EQ(welded.node_count(), one.node_count());
  std::vector<int> at = nodes_at(patches, nodes, patch);
  for (int& node : at) node = static_cast<int>(one_nodes.node(0, node));
  const NodalVectors u_one = 0.02 * models::random_vectors(one.node_count(), 7);
  const NodalVectors u = u_one(Eigen::all, at);
  NodalVectors f(3, u.cols()), f_one(3, u.cols());
  welded.internal_force(u, f);
  one.internal_force(u_one, f_one);
  EXPECT_LT((f - f_one(Eigen::all, at)).lpNorm<Eigen::Infinity>(), 1e-12 * f.lpNorm<Eigen::Infinity>());
  const Eigen::VectorXd mass = one.row_sum_mass()(at);
  EXPECT_LT((welded.row_sum_mass() - mass).lpNorm<Eigen::Infinity>(), 1e-13 * mass.maxCoeff());
  EXPECT_NEAR(welded.strain_energy(u), one.strain_energy(u_one), 1e-13 * one.strain_energy(u_one));
  EXPECT_NEAR(welded.volume(), one.volume(), 1e-13);
}

TEST(WeldedSolid, IsThePatchThatFallsIntoItsPieces) {
  const Volume patch = kinked();
  const std::vector<Volume> patches = split_at_kinks(patch);
  ASSERT_EQ(patches.size(), 4u);
  for (const auto& law : {models::elastic(1.0, 0.3), models::large_strain_laws().front()})
    for (const auto method : {IntegrationMethod::automatic, IntegrationMethod::stored,
                              IntegrationMethod::recomputed, IntegrationMethod::elements})
      expect_same(patch, patches, structure::weld({patch}), law, {Quadrature::full, method});
  expect_same(patch, patches, structure::weld({patch}), models::elastic(), {Quadrature::reduced});
}

TEST(WeldedSolid, FourQuartersAreATubeThatIsClosed) {
  const auto ring = [](double from, double to, int elements) {
    return nurbs::tube(nurbs::frame({0, 0, 0}, {0, 0, 1}), 1.0, 2.0, 1.5,
                       nurbs::refined(nurbs::arc(from, to), elements, 2),
                       {KnotVector::uniform(2, 2), KnotVector::uniform(2, 1)});
  };
  std::vector<Volume> quarters;
  for (int k = 0; k < 4; ++k) quarters.push_back(ring(90.0 * k, 90.0 * (k + 1), 2));
  const Volume tube = ring(0, 360, 8);
  const NodeNumbering closed = structure::weld({tube});
  expect_same(tube, quarters, closed, models::elastic(), {});

  // A rigid motion makes no force, in a closed tube, either; and a slit opens, which a weld does not.
  const Solid solid = weld_solid({tube}, closed, {models::elastic()}, {});
  NodalVectors f(3, solid.node_count());
  solid.internal_force(
      models::linear_field(models::Matrix3::Zero(), solid.reference()).colwise() + Vector3(1, 2, 3), f);
  EXPECT_LT(f.lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(WeldedSolid, EachPatchHasItsMaterial) {
  const Volume block = models::block({1, 2, 3}, {2, 2, 2}, 2);
  Volume other = block;
  other.control_points.row(0).array() += 1.0;
  const auto soft = models::elastic(1.0, 0.3, 2.0), hard = models::elastic(70.0, 0.2, 5.0);
  const std::vector<Volume> patches{block, other};
  const Solid solid = weld_solid(patches, structure::weld(patches), {soft, hard}, {});
  const Matrix3 H = 1e-3 * models::some_gradient();
  const double W = 6.0 * (soft->energy_density(H, nullptr) + hard->energy_density(H, nullptr));
  EXPECT_NEAR(solid.strain_energy(models::linear_field(H, solid.reference())), W, 1e-12 * W);
  EXPECT_NEAR(solid.row_sum_mass().sum(), 6.0 * (2.0 + 5.0), 1e-12);
  const auto materials = solid.materials();
  EXPECT_EQ(materials, (std::vector<const Material*>{soft.get(), hard.get()}));
  EXPECT_THAT(solid.describe_element(solid.element_count() - 1),
              testing::StartsWith("patch 1, spans 1, 1, 1"));
}

TEST(WeldedSolid, DegreesMayDifferWhereNothingIsWelded) {
  const Volume quadratic = models::block({1, 1, 1}, {2, 2, 2}, 2);
  Volume cubic = models::block({1, 1, 1}, {2, 2, 2}, 3);
  cubic.control_points.row(0).array() += 2.0;
  const std::vector<Volume> patches{quadratic, cubic};
  const NodeNumbering nodes = structure::weld(patches);
  const Solid solid = weld_solid(patches, nodes, {models::elastic()}, {});
  const Matrix3 H = 1e-3 * models::some_gradient();
  const double W = 2.0 * models::elastic()->energy_density(H, nullptr);
  EXPECT_NEAR(solid.strain_energy(models::linear_field(H, solid.reference())), W, 1e-13);
  EXPECT_EQ(solid.padded_functions(0), 28);
  EXPECT_EQ(solid.padded_functions(15), 64);
}

TEST(WeldedSolid, SkinsAreOfNodes) {
  const Volume block = models::block({1, 1, 1}, {2, 2, 2}, 2);
  Volume other = block;
  other.control_points.row(0).array() += 1.0;
  const std::vector<Volume> patches{block, other};
  const Solid solid = weld_solid(patches, structure::weld(patches), {models::elastic()}, {});
  for (const int patch : {0, 1}) {
    const nurbs::BoundarySurface top = solid.skin({patch, nurbs::Face::zeta_plus});
    for (const int node : top.volume_control_point) EXPECT_EQ(solid.reference()(2, node), 1.0);
  }
  EXPECT_THROW(solid.skin({2, nurbs::Face::zeta_plus}), std::invalid_argument);
}

// What a part of a body adds to its shares, and what all add up to, is the whole body's to the last bit.
TEST(WeldedSolid, InPartsItIsTheSameToTheLastBit) {
  const std::vector<Volume> patches = split_at_kinks(kinked());
  const NodeNumbering nodes = structure::weld(patches);
  const Solid whole = weld_solid(patches, nodes, {models::elastic()}, {});
  const NodalVectors u = 0.02 * models::random_vectors(whole.node_count(), 3);
  NodalVectors f_whole(3, u.cols());
  whole.internal_force(u, f_whole);

  std::vector<PatchBoxes> boxes;
  for (const Volume& patch : patches) boxes.emplace_back(patch.space, structure::box_cuts(patch.space));
  constexpr int kParts = 3;
  std::vector<structure::Part> parts;
  std::vector<NodalVectors> f;
  for (int p = 0; p < kParts; ++p) {
    parts.push_back(structure::Partition(boxes, nodes, kParts).part(p));
    const Solid solid = weld_solid(patches, nodes, {models::elastic()}, {}, p, kParts);
    NodalVectors own = NodalVectors::Zero(3, parts[p].columns);
    for (int column = 0; column < parts[p].held(); ++column) own.col(column) = u.col(parts[p].nodes[column]);
    f.emplace_back(3, own.cols());
    solid.internal_force(own, f.back());
  }
  for (int p = 0; p < kParts; ++p)
    for (const structure::Neighbour& n : parts[p].neighbours)
      for (const structure::Neighbour& there : parts[n.part].neighbours)
        if (there.part == p)
          for (std::size_t i = 0; i < n.shares_in.size(); ++i)
            f[p].col(n.shares_in[i]) = f[n.part].col(there.shares_out[i]);
  for (int p = 0; p < kParts; ++p) {
    structure::add_shares(parts[p], f[p]);
    for (int column = 0; column < parts[p].owned; ++column)
      EXPECT_EQ(f[p].col(column), f_whole.col(parts[p].nodes[column]));
  }
}

}  // namespace
