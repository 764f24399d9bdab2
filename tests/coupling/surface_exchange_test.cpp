// SPDX-License-Identifier: GPL-2.0-or-later
// The forces that the structure gets do not depend on how many ranks hold the particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <cstdio>

#include "contact/rising_sheet.h"
#include "coupling/force_distribution.h"
#include "coupling/iga_structure.h"
#include "coupling/open_structure.h"
#include "coupling/rigid/rigid_surface.h"
#include "coupling/surface_exchange.h"
#include "geometry_io/yaml_map.h"
#include "late_surface.h"
#include "nurbs/primitives.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"
#include "wavy_surface.h"

namespace {

using coupling::ContactForce;
using coupling::NodalVectors;
using coupling::Vector3;

struct Ranks {
  Ranks() {
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
  }
  int me, count;
};

/// Contact of particle `tag`: forces of very different size, so that the order of summation shows in the last
/// bits.
ContactForce force_at_foot(long tag, int branch = 0) {
  const double t = static_cast<double>(tag) + 0.3 * branch;
  return {tag,
          branch,
          branch % 2,
          {std::fmod(0.37 * t, 1.0), std::fmod(0.73 * t, 1.0)},
          {std::sin(t), std::cos(3 * t), std::pow(10.0, (tag + 2 * branch) % 7) * (1.0 + 0.1 * t)}};
}

TEST(SurfaceExchange, ForcesAreBitwiseTheSameOnAnyNumberOfRanks) {
  const Ranks ranks;
  coupling::RigidSurface rigid({test::wavy_surface(), test::wavy_surface()});
  coupling::SurfaceExchange exchange(MPI_COMM_WORLD, rigid);
  const int particles = 201, branches = 3;  // not equally many on each rank

  // Serial reference in the order of tags and branches, straight from eq. 34.
  NodalVectors expected = NodalVectors::Zero(3, rigid.positions().cols());
  Vector3 total = Vector3::Zero();
  for (long tag = 1; tag <= particles; ++tag)
    for (int branch = 0; branch < branches; ++branch) {
      const ContactForce c = force_at_foot(tag, branch);
      coupling::FootBasis(rigid.surface().topology, {branch % 2, {c.xi[0], c.xi[1]}})
          .distribute(Vector3::Map(c.F), expected);
      total += Vector3::Map(c.F);
    }

  std::vector<ContactForce> mine;
  for (long tag = particles; tag >= 1; --tag)  // against the order, dealt to the ranks in turn
    for (int branch = branches - 1; branch >= 0; --branch)
      if (tag % ranks.count == ranks.me) mine.push_back(force_at_foot(tag, branch));
  const coupling::NodalForces& on_nodes = exchange.export_add(mine);
  const NodalVectors& forces = on_nodes.values;
  EXPECT_EQ(on_nodes.touched, coupling::NodalForces(forces).touched);
  EXPECT_EQ((forces - expected).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LE((forces.rowwise().sum() - total).norm(), 1e-13 * total.norm());
}

// Of control points that move as a rigid body the moment of these forces is the couple, and their sum
// nothing.
TEST(SurfaceExchange, ACoupleIsItsMomentAndNoForce) {
  const Ranks ranks;
  coupling::RigidSurface rigid({test::wavy_surface(), test::wavy_surface()});
  coupling::SurfaceExchange exchange(MPI_COMM_WORLD, rigid);
  ContactForce one = force_at_foot(4, 1);
  std::vector<ContactForce> mine;
  const auto nodal_forces = [&] { return NodalVectors(exchange.export_add(mine).values); };
  if (ranks.me == 0) mine = {one};
  const NodalVectors of_force = nodal_forces(), &X = exchange.positions();
  const auto foot = [&](double xi, double eta) {
    return coupling::FootBasis(rigid.surface().topology, {one.patch, {xi, eta}}).interpolate(X);
  };
  constexpr double kStep = 1e-6;
  nurbs::Tangents S;
  S.col(0) = 0.5 / kStep * (foot(one.xi[0] + kStep, one.xi[1]) - foot(one.xi[0] - kStep, one.xi[1]));
  S.col(1) = 0.5 / kStep * (foot(one.xi[0], one.xi[1] + kStep) - foot(one.xi[0], one.xi[1] - kStep));
  const Vector3 couple(0.7, -0.4, 0.3);
  one.has_couple = true;
  const std::array<Vector3, 2> G = coupling::couple_forces(S.col(0), S.col(1), couple);
  for (int j = 0; j < 2; ++j) Vector3::Map(one.couple[j]) = G[j];
  if (ranks.me == 0) mine = {one};
  const NodalVectors f = nodal_forces() - of_force;
  Vector3 moment = Vector3::Zero();
  for (Eigen::Index A = 0; A < X.cols(); ++A) moment += Vector3(X.col(A)).cross(Vector3(f.col(A)));
  EXPECT_LT(f.rowwise().sum().norm(), 1e-14 * of_force.norm());
  EXPECT_LT((moment - couple).norm(), 1e-8);
}

TEST(SurfaceExchange, RanksWithoutContactsTakePart) {
  const Ranks ranks;
  coupling::RigidSurface rigid({test::wavy_surface()});
  coupling::SurfaceExchange exchange(MPI_COMM_WORLD, rigid);
  std::vector<ContactForce> mine;
  if (ranks.me == ranks.count - 1) mine.push_back(force_at_foot(3));
  EXPECT_NEAR(exchange.export_add(mine).values.row(2).sum(), force_at_foot(3).F[2],
              1e-13 * force_at_foot(3).F[2]);
  EXPECT_EQ(exchange.export_add({}).values.cwiseAbs().maxCoeff(), 0.0)
      << "forces of an earlier step must not stay";
}

TEST(SurfaceExchange, ImportBringsTheControlPoints) {
  const nurbs::Surface surface = test::wavy_surface();
  coupling::RigidSurface rigid({surface});
  const coupling::SurfaceExchange exchange(MPI_COMM_WORLD, rigid);
  EXPECT_EQ(exchange.positions(), surface.control_points);
  EXPECT_EQ(exchange.velocities().cwiseAbs().maxCoeff(), 0.0);
}

/// A solver whose node ids have gaps: control point i of its surface is node 1000 + 3 i, and this rank holds
/// a few nodes beside those.
class SparseNodes final : public coupling::StructureSolver {
 public:
  using NodeId = coupling::NodeId;
  explicit SparseNodes(const nurbs::Surface& patch)
      : surface_{nurbs::join({patch}).topology, coupling::SurfaceMap::identity(0), {0}} {
    std::vector<NodeId> node;
    for (int i = 0; i < patch.control_points.cols(); ++i) node.push_back(1000 + 3 * i);
    surface_.map = coupling::SurfaceMap::selection(node, NodeId(1) << 40);
    nodes_ = node;
    nodes_.insert(nodes_.begin(), {5, 700 + Ranks().me});
    nodes_.push_back(NodeId(1) << 39);
    positions_ = NodalVectors::Constant(3, nodes_.size(), -99.0);
    positions_.middleCols(2, node.size()) = patch.control_points;
  }
  const coupling::ContactSurface& surface() const override { return surface_; }
  const std::vector<NodeId>& nodes() const override { return nodes_; }
  /// From now on the first control point is the mean of two nodes.
  void interpolate() {
    coupling::SurfaceMap::Matrix S(positions_.cols() - 3, NodeId(1) << 40);
    S.reserve(Eigen::Matrix<NodeId, Eigen::Dynamic, 1>::Constant(S.rows(), 2));
    for (NodeId i = 0; i < S.rows(); ++i) S.insert(i, 1000 + 3 * i) = i == 0 ? 0.5 : 1.0;
    S.insert(0, 1003) = 0.5;
    S.makeCompressed();
    surface_.map = coupling::SurfaceMap(S);
  }
  NodalVectors inverse_node_mass() const override {
    return NodalVectors::Constant(3, positions_.cols(), 4.0);
  }
  const NodalVectors& positions() const override { return positions_; }
  const NodalVectors& velocities() const override { return positions_; }
  void initialise_forces(const coupling::NodalForces&) override {}
  void begin_step() override {}
  void end_step(const coupling::NodalForces&) override {}
  void set_time_step(double) override {}
  double stable_time_step() const override { return 1.0; }
  bool moves() const override { return true; }
  double kinetic_energy() const override { return 0.0; }
  double strain_energy() const override { return 0.0; }
  Vector3 linear_momentum() const override { return Vector3::Zero(); }
  Vector3 angular_momentum(const Vector3&) const override { return Vector3::Zero(); }
  std::vector<coupling::SurfaceMaterial> materials() const override { return {}; }
  std::vector<coupling::Probe> probes() const override { return {}; }
  std::vector<double> save() const override { return {}; }
  void load(const std::vector<double>&) override {}
  coupling::Fingerprint fingerprint() const override { return {}; }

 private:
  coupling::ContactSurface surface_;
  std::vector<NodeId> nodes_;
  NodalVectors positions_;
};

TEST(SurfaceExchange, KnowsNodesByTheirIds) {
  const Ranks ranks;
  const nurbs::Surface surface = test::wavy_surface();
  coupling::RigidSurface dense({surface});
  SparseNodes sparse(surface);
  coupling::SurfaceExchange by_column(MPI_COMM_WORLD, dense), by_id(MPI_COMM_WORLD, sparse);
  EXPECT_EQ(by_id.positions(), surface.control_points);

  std::vector<ContactForce> mine;
  for (long tag = 1; tag <= 40; ++tag)
    if (tag % ranks.count == ranks.me) mine.push_back(force_at_foot(tag));
  const NodalVectors expected = by_column.export_add(mine).values, forces = by_id.export_add(mine).values;
  ASSERT_EQ(forces.cols(), expected.cols() + 3);
  EXPECT_EQ(forces.middleCols(2, expected.cols()), expected);
  EXPECT_EQ(forces.leftCols(2).cwiseAbs().maxCoeff() + forces.rightCols(1).cwiseAbs().maxCoeff(), 0.0);
}

// Elements of degree 2: three by three control points of the corner and a row and a column around them.
TEST(SurfaceExchange, BringsWhatIsFollowedAndMeasuresAll) {
  const nurbs::Surface plane = nurbs::plane(
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nurbs::KnotVector::uniform(2, 8), nurbs::KnotVector::uniform(2, 8)});
  test::RisingSheet sheet(plane, 0.5);
  sheet.set_time_step(0.1);
  coupling::SurfaceExchange exchange(MPI_COMM_WORLD, sheet);
  sheet.begin_step();
  exchange.import_surface();
  const NodalVectors before = exchange.positions();
  EXPECT_EQ(before, sheet.positions());
  exchange.follow({0});
  EXPECT_EQ(exchange.largest_motion(), 0.0);
  sheet.begin_step();
  exchange.import_followed();
  EXPECT_NEAR(exchange.largest_motion(), 0.05, 1e-16);
  int brought = 0;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const int c = i + 10 * j;
      const bool near = i < 4 && j < 4;
      brought += near;
      EXPECT_EQ(exchange.positions().col(c), near ? sheet.positions().col(c) : before.col(c))
          << i << " " << j;
    }
  EXPECT_EQ(exchange.followed().size(), static_cast<std::size_t>(brought));
}

// Whoever is nowhere is no nearer than the others, whichever control point it is.
TEST(SurfaceExchange, MotionThatIsNoNumberStaysOne) {
  const nurbs::Surface plane = nurbs::plane(
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nurbs::KnotVector::uniform(2, 2), nurbs::KnotVector::uniform(2, 2)});
  for (const int lost : {0, 5, 15}) {
    test::RisingSheet sheet(plane, 0.5);
    sheet.set_time_step(0.1);
    coupling::SurfaceExchange exchange(MPI_COMM_WORLD, sheet);
    exchange.follow({0});
    sheet.lose(lost);
    sheet.begin_step();
    EXPECT_TRUE(std::isnan(exchange.largest_motion())) << lost;
  }
}

// A force on a control point moves it by the sum of factor^2 / mass, and others that hang on the same nodes.
TEST(SurfaceExchange, MassesAreThoseOfNodesThatAreControlPoints) {
  SparseNodes sparse(test::wavy_surface());
  const coupling::SurfaceExchange selected(MPI_COMM_WORLD, sparse);
  EXPECT_EQ(selected.inverse_masses(), NodalVectors::Constant(3, selected.positions().cols(), 4.0));
  sparse.interpolate();
  EXPECT_EQ(coupling::SurfaceExchange(MPI_COMM_WORLD, sparse).inverse_masses().size(), 0);
}

TEST(LateSurface, IsSeenAsItWasTwoStepsAgo) {
  const auto knots = nurbs::KnotVector::uniform(2, 1);
  nurbs::Volume cube = nurbs::box({0, 0, 0}, {1, 1, 1}, {knots, knots, knots});
  auto material = std::make_shared<structure::LinearElastic>(1.0, 0.0, 1.0);
  auto in_phase = std::make_unique<coupling::IgaStructure>(
      structure::ExplicitSolver(std::make_unique<structure::Solid>(std::move(cube), material), {}),
      std::vector<structure::SkinPiece>{{0, nurbs::Face::zeta_plus}});
  const coupling::IgaStructure& now = *in_phase;
  test::LateSurface solver(std::move(in_phase), 2);
  solver.set_time_step(0.1);
  const coupling::NodalForces pull(NodalVectors::Ones(3, solver.positions().cols()));
  solver.initialise_forces(pull);

  coupling::SurfaceExchange exchange(MPI_COMM_WORLD, solver);
  std::vector<NodalVectors> positions(3, exchange.positions()), velocities(3, exchange.velocities());
  for (int step = 0; step < 4; ++step) {
    EXPECT_EQ(exchange.positions(), positions[step]);
    EXPECT_EQ(exchange.velocities(), velocities[step]);
    solver.begin_step();
    positions.emplace_back();
    velocities.emplace_back();
    now.surface().map.to_surface(now.positions(), positions.back());
    now.surface().map.to_surface(now.velocities(), velocities.back());
    EXPECT_NE(positions.back(), *(positions.end() - 2));
    exchange.import_surface();
    solver.end_step(pull);
  }
}

TEST(OpenRigidSurface, MissingFileIsAnErrorOnEveryRank) {
  try {
    coupling::open_rigid_surface(MPI_COMM_WORLD, "no_such_file.yaml", "floor");
    FAIL() << "expected geometry_io::InputError";
  } catch (const geometry_io::InputError& problem) {
    EXPECT_THAT(problem.what(),
                testing::AllOf(testing::HasSubstr("no_such_file.yaml"), testing::HasSubstr("No such file")));
  }
}

TEST(OpenRigidSurface, FolderInPlaceOfAFileIsAnError) {
  EXPECT_THROW(coupling::open_rigid_surface(MPI_COMM_WORLD, ".", "floor"), geometry_io::InputError);
}

}  // namespace
