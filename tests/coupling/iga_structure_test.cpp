// SPDX-License-Identifier: GPL-2.0-or-later
// Our solver behind the port, as contact drives it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "coupling/force_distribution.h"
#include "coupling/iga_structure.h"
#include "nurbs/primitives.h"
#include "point_force.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::Vector3;

const double kStep = 1e-8;

/// Free steel block 6 x 6 x 3 mm of PHYSICS D7; particles see its top at z = 0.
coupling::IgaStructure block() {
  const auto knots = [](int n) { return nurbs::KnotVector::uniform(2, n); };
  nurbs::Volume patch = nurbs::box({-3e-3, -3e-3, -3e-3}, {6e-3, 6e-3, 3e-3}, {knots(6), knots(6), knots(3)});
  auto steel = std::make_shared<structure::LinearElastic>(210.6e9, 0.286, 7850.0);
  coupling::IgaStructure solver(
      structure::ExplicitSolver(std::make_unique<structure::Solid>(std::move(patch), steel), {}),
      {{0, nurbs::Face::zeta_plus}});
  solver.set_time_step(kStep);
  return solver;
}

TEST(IgaStructure, SurfaceIsTheTopOfTheBlock) {
  const coupling::IgaStructure solver = block();
  NodalVectors x;
  solver.surface().map.to_surface(solver.positions(), x);
  EXPECT_NEAR(x.row(2).cwiseAbs().maxCoeff(), 0.0, 1e-18);
  EXPECT_EQ(solver.surface().outward_sign, std::vector<int>{1}) << "xi x eta of the top points out";
}

TEST(IgaStructure, MomentumIsForceTimesTime) {
  coupling::IgaStructure solver = block();
  const Vector3 F(1.0, 0.5, -6.0);
  const NodalForces forces = point_force(solver, {0.7, 0.4}, F);
  solver.initialise_forces(forces);
  const int steps = 400;
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(forces);
  }
  const Vector3 impulse = steps * kStep * F;
  EXPECT_LE((solver.linear_momentum() - impulse).norm(), 1e-12 * impulse.norm());
}

TEST(IgaStructure, WorkOfTheForceIsTheEnergyOfTheBlock) {
  coupling::IgaStructure solver = block();
  const Vector3 F(0.0, 0.0, -6.0);
  const NodalForces forces = point_force(solver, {0.5, 0.5}, F);
  solver.initialise_forces(forces);
  double work = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const NodalVectors before = solver.positions();
    solver.begin_step();
    solver.end_step(forces);
    work += forces.values.cwiseProduct(solver.positions() - before).sum();
  }
  const double energy = solver.kinetic_energy() + solver.strain_energy();
  EXPECT_NEAR(energy / work, 1.0, 2e-3) << "error ~ (dt omega)^2";
}

TEST(IgaStructure, LoadContinuesASavedStateToTheLastBit) {
  coupling::IgaStructure first = block(), second = block();
  const NodalForces forces = point_force(first, {0.3, 0.6}, {0, 1, -5});
  const auto advance = [&](coupling::IgaStructure& solver, int steps) {
    for (int n = 0; n < steps; ++n) {
      solver.begin_step();
      solver.end_step(forces);
    }
  };
  first.initialise_forces(forces);
  advance(first, 20);
  EXPECT_EQ(first.state_size(), first.save().size());
  second.load(first.save());
  advance(first, 20);
  advance(second, 20);
  EXPECT_EQ(first.positions(), second.positions());
  EXPECT_EQ(first.velocities(), second.velocities());
  EXPECT_THROW(second.load({1.0, 2.0}), std::invalid_argument);
}

std::shared_ptr<structure::LinearElastic> soft() {
  return std::make_shared<structure::LinearElastic>(1.0, 0.3, 1.0);
}

const std::vector<nurbs::Face> kFaces{nurbs::Face::xi_minus, nurbs::Face::xi_plus,    nurbs::Face::eta_minus,
                                      nurbs::Face::eta_plus, nurbs::Face::zeta_minus, nurbs::Face::zeta_plus};

std::vector<structure::SkinPiece> whole_skin() {
  std::vector<structure::SkinPiece> pieces;
  for (const nurbs::Face face : kFaces) pieces.push_back({0, face});
  return pieces;
}

coupling::IgaStructure whole_skin(nurbs::Volume volume) {
  return coupling::IgaStructure(
      structure::ExplicitSolver(std::make_unique<structure::Solid>(std::move(volume), soft()), {}),
      whole_skin());
}

nurbs::KnotVector knots(int degree, int elements) { return nurbs::KnotVector::uniform(degree, elements); }

// A block has twelve edges, at each of which two faces meet.
TEST(IgaStructure, FacesOfABlockAreWeldedAtAllEdges) {
  const coupling::IgaStructure solver =
      whole_skin(nurbs::box({0, 0, 0}, {1, 2, 3}, {knots(2, 1), knots(2, 2), knots(3, 3)}));
  const nurbs::MultiPatch& skin = solver.surface().topology;
  for (int p = 0; p < 6; ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side) {
      EXPECT_EQ(skin.border(p, side).kind, nurbs::Border::welded) << "face " << p << ", side " << side;
      EXPECT_NE(skin.border(p, side).patch / 2, p / 2) << "opposite faces have no edge in common";
    }
}

// A whole tube is slit: four faces meet there, two and two of the same nodes.  The outside goes on into the
// end of the wall at its own side of the slit, not into itself beyond it, and so does every other edge of the
// solid.
TEST(IgaStructure, EdgesThatOnlyTouchAreNotWelded) {
  nurbs::Volume tube = nurbs::tube(nurbs::frame({0, 0, 0}, {0, 0, 1}), 0.8, 1.0, 2.0,
                                   nurbs::refined(nurbs::arc(0, 360), 8, 2), {knots(2, 3), knots(2, 2)});
  const nurbs::Space<3> space = tube.space;
  auto steel = std::make_shared<structure::LinearElastic>(210.6e9, 0.286, 7850.0);
  const coupling::IgaStructure solver(
      structure::ExplicitSolver(std::make_unique<structure::Solid>(std::move(tube), steel), {}),
      whole_skin());
  const nurbs::MultiPatch& surface = solver.surface().topology;
  for (int p = 0; p < surface.patch_count(); ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side) {
      SCOPED_TRACE(testing::Message() << face_name(kFaces[p]) << ", side " << nurbs::side_name(side));
      const nurbs::Border& border = surface.border(p, side);
      ASSERT_EQ(border.kind, nurbs::Border::welded);
      EXPECT_NE(border.patch, p);
      EXPECT_NEAR(border.max_angle, M_PI / 2, 1e-6) << "all its edges are at right angles";
      // The nodes at the ends of both edges are the same.
      const nurbs::BoundarySurface here = nurbs::boundary_surface(space, kFaces[p]),
                                   there = nurbs::boundary_surface(space, kFaces[border.patch]);
      const auto corner = [](const nurbs::BoundarySurface& face, int of_side, bool end) {
        const int n = face.space.control_point_count(0), m = face.space.control_point_count(1);
        const bool upper = of_side % 2 == 1;
        return face.volume_control_point[of_side < 2 ? (upper ? n - 1 : 0) + n * (end ? m - 1 : 0)
                                                     : (end ? n - 1 : 0) + n * (upper ? m - 1 : 0)];
      };
      for (const bool end : {false, true})
        EXPECT_EQ(corner(here, side, end), corner(there, border.side, end != border.reversed));
    }
}

// On any face: the foot is the point of the solid, and the nodes feel force and moment of what acts there.
TEST(IgaStructure, ForcesGoToTheNodesOfTheirFace) {
  const coupling::IgaStructure solver =
      whole_skin(nurbs::box({0, 0, 0}, {1, 2, 3}, {knots(2, 1), knots(2, 2), knots(3, 3)}));
  const Vector3 F(1.0, -2.0, 0.7);
  NodalVectors on_skin;
  solver.surface().map.to_surface(solver.positions(), on_skin);
  for (int p = 0; p < 6; ++p) {
    const coupling::FootBasis foot(solver.surface().topology, {p, {0.3, 0.8}});
    const int normal = p / 2, u = normal == 0 ? 1 : 0, v = normal == 2 ? 1 : 2;
    Vector3 point;  // a block is parametrised by its relative coordinates
    point[normal] = p % 2, point[u] = 0.3, point[v] = 0.8;
    point = point.cwiseProduct(Vector3(1, 2, 3));
    EXPECT_LE((foot.interpolate(on_skin) - point).norm(), 1e-14);

    NodalVectors f = NodalVectors::Zero(3, on_skin.cols()),
                 on_nodes = NodalVectors::Zero(3, solver.positions().cols());
    foot.distribute(F, f);
    solver.surface().map.add_to_nodes(f, on_nodes);
    Vector3 moment = Vector3::Zero();
    for (int a = 0; a < on_nodes.cols(); ++a)
      moment += Vector3(solver.positions().col(a)).cross(Vector3(on_nodes.col(a)));
    EXPECT_LE((on_nodes.rowwise().sum() - F).norm(), 1e-14 * F.norm());
    EXPECT_LE((moment - point.cross(F)).norm(), 1e-13);
  }
}

// A saved state knows what is held, what of that moves, and on which springs the body stands.
TEST(IgaStructure, FingerprintTellsSupportsApart) {
  const auto fingerprint = [](bool moves, double stiffness) {
    const nurbs::Volume box = nurbs::box({0, 0, 0}, {1, 1, 1}, {knots(2, 1), knots(2, 1), knots(2, 1)});
    const structure::NodeSet bottom = structure::nodes_on(box.space, {nurbs::Face::zeta_minus});
    structure::Supports supports;
    if (moves)
      supports.move(bottom, {true, true, true}, {0, 0, 1e-3}, structure::sine(1.0, 0.0));
    else
      supports.fix(bottom, {true, true, true});
    auto steel = std::make_shared<structure::LinearElastic>(210.6e9, 0.286, 7850.0);
    structure::ExplicitSolver solver(std::make_unique<structure::Solid>(box, steel), supports);
    structure::Springs springs;
    if (stiffness > 0.0) springs.add({{26, stiffness * structure::Stiffness3::Identity()}});
    solver.set_springs(springs);
    return coupling::IgaStructure(std::move(solver), {{0, nurbs::Face::zeta_plus}}).fingerprint();
  };
  EXPECT_EQ(coupling::difference(fingerprint(false, 1e5), fingerprint(false, 1e5)), "");
  EXPECT_THAT(
      coupling::difference(fingerprint(true, 0), fingerprint(false, 0)),
      testing::AllOf(testing::HasSubstr("supports: 27 fixed"), testing::HasSubstr("27 of which move")));
  EXPECT_THAT(coupling::difference(fingerprint(false, 1e5), fingerprint(false, 1e6)),
              testing::HasSubstr("springs: 1 of stiffness 300000"));
  EXPECT_THAT(coupling::difference(fingerprint(false, 1e5), fingerprint(false, 0)),
              testing::HasSubstr("none now"));
}

// Which is not above the true one.
TEST(IgaStructure, TheLimitIsTheStableStep) {
  coupling::IgaStructure solver = block();
  EXPECT_THROW(solver.set_time_step(1.01 * solver.stable_time_step()), std::invalid_argument);
  EXPECT_NO_THROW(solver.set_time_step(0.99 * solver.stable_time_step()));
}

TEST(IgaStructure, StepAboveTheStableOneIsRefusedWithBothNumbers) {
  coupling::IgaStructure solver = block();
  EXPECT_NEAR(solver.stable_time_step(), 1.29e-7, 0.03 * 1.29e-7) << "PHYSICS D7";
  try {
    solver.set_time_step(2e-7);
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& problem) {
    EXPECT_THAT(problem.what(), testing::AllOf(testing::HasSubstr("2e-07"), testing::HasSubstr("1.2")));
  }
}

}  // namespace
