// SPDX-License-Identifier: GPL-2.0-or-later
// Products with the consistent mass, and row sums that it corrects, beside dense matrices and theory.
#include "structure/time/mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "models.h"
#include "nurbs/refinement.h"
#include "structure/analysis/mass_matrix.h"
#include "structure/conditions/loads.h"
#include "structure/material/saint_venant_kirchhoff.h"
#include "structure/sweep/affine_map.h"
#include "structure/sweep/mass_sweep.h"
#include "structure/time/explicit_solver.h"
#include "structure/weld.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;
using structure::Halo;
using structure::MassKind;
using structure::MassMatrix;
using structure::Solid;
using structure::Supports;

const structure::Integration kCorrected = {{}, {}, structure::TimeMass::corrected};

std::unique_ptr<Solid> solid(const nurbs::Volume& patch, double density = 1.0) {
  return std::make_unique<Solid>(patch, models::elastic(1.0, 0.3, density), kCorrected);
}

nurbs::Volume rough(const std::array<int, 3>& degrees, const std::array<int, 3>& elements = {4, 3, 2}) {
  return models::distorted(models::block({4.0, 2.0, 1.0}, elements, degrees), 0.05);
}

/// With the second knot of each direction repeated as often as may be.
nurbs::Volume with_kinks(nurbs::Volume patch) {
  for (int d = 0; d < 3; ++d)
    patch = nurbs::insert_knots(
        patch, d, std::vector<double>(patch.space.degree(d) - 1, patch.space.knots(d).breaks()[1]));
  return patch;
}

/// Off its axis: there the derivatives of weights have no part in the volume.
nurbs::Volume moved(nurbs::Volume patch) {
  patch.control_points.colwise() += Vector3(1.0, -2.0, 0.5);
  return patch;
}

// Entry by entry is another code: element matrices from basis functions.
TEST(MassProduct, IsThatOfTheConsistentMatrix) {
  for (const nurbs::Volume& patch :
       {models::block({4, 2, 1}, {40, 3, 2}, 2), models::block({4, 2, 1}, {2, 3, 20}, {2, 2, 3}),
        rough({2, 2, 2}), rough({3, 2, 4}), rough({1, 2, 1}, {9, 3, 2}), rough({5, 5, 5}, {1, 2, 1}),
        rough({2, 6, 2}), with_kinks(models::block({4, 2, 1}, {5, 3, 2}, {2, 3, 2})),
        moved(models::quarter_ring(2, 3)), models::quarter_ring(3, 2), with_kinks(rough({2, 3, 2}))}) {
    const auto body = solid(patch, 2.5);
    const NodalVectors a = models::random_vectors(body->node_count(), 3),
                       expected = MassMatrix(*body, MassKind::consistent) * a;
    NodalVectors f(a), plain(a);
    body->mass_product(a, f);
    EXPECT_LT((f - expected).norm(), 1e-13 * expected.norm());
    body->Body::mass_product(a, plain);
    EXPECT_LT((plain - expected).norm(), 1e-13 * expected.norm());
    const bool is_affine = structure::affine_jacobian(patch).has_value();
    for (const auto level : {nurbs::SimdLevel::portable, nurbs::SimdLevel::avx2, nurbs::SimdLevel::avx512}) {
      if (!nurbs::available(level)) continue;
      const auto boxes = structure::whole_patch(patch.space);
      const structure::MassSweep sweep(patch.space, patch.control_points, boxes, 2.5, is_affine, level);
      f.setZero();
      sweep.add_products(0, sweep.box_count(), a, f);
      EXPECT_LT((f - expected).norm(), 1e-13 * expected.norm()) << nurbs::name(level);
    }
  }
}

TEST(MassProduct, SaysBeforehandWhatItKeeps) {
  for (const int degree : {1, 2, 3})
    for (const std::array<int, 3>& elements : {std::array<int, 3>{8, 8, 8}, {20, 20, 1}, {3, 31, 17}}) {
      const nurbs::Volume block = models::block({1, 1, 1}, elements, degree);
      const auto boxes = structure::whole_patch(block.space);
      const structure::MassSweep sweep(block.space, block.control_points, boxes, 1.0, false);
      const double expected = structure::MassSweep::expected_bytes(block.space, boxes);
      EXPECT_NEAR(expected, sweep.table_bytes(), 0.03 * sweep.table_bytes()) << degree;
    }
}

TEST(MassProduct, KnowsWeldsAndTheDensityOfEachPatch) {
  const nurbs::Volume below = models::block({2, 2, 1}, {3, 2, 2}, 2);
  nurbs::Volume above = below;
  above.control_points.row(2).array() += 1.0;
  const auto nodes = structure::weld({below, above});
  std::vector<structure::PatchBoxes> boxes;
  for (int p = 0; p < 2; ++p) boxes.emplace_back(below.space, structure::box_cuts(below.space));
  const Solid body({{below, models::elastic(1.0, 0.3, 2.0)}, {above, models::elastic(1.0, 0.3, 5.0)}}, nodes,
                   kCorrected, structure::Partition(boxes, nodes, 1).part(0));
  const NodalVectors a = models::random_vectors(body.node_count(), 3),
                     expected = MassMatrix(body, MassKind::consistent) * a;
  NodalVectors f(a);
  body.mass_product(a, f);
  EXPECT_LT((f - expected).norm(), 1e-13 * expected.norm());
}

struct Dense {
  Eigen::MatrixXd inverse;  // of all dofs, 0 where they are fixed
  Eigen::VectorXd lumped;   // of all dofs
};

Dense dense_inverse(const Solid& body, const Supports& supports) {
  const int nodes = body.node_count(), dofs = 3 * nodes;
  const MassMatrix consistent(body, MassKind::consistent);
  NodalVectors unit = NodalVectors::Zero(3, nodes);
  Eigen::VectorXd free = Eigen::VectorXd::Ones(dofs), lumped(dofs);
  for (const Eigen::Index dof : supports.fixed_dofs()) free[dof] = 0.0;
  Eigen::MatrixXd M(dofs, dofs);
  for (int dof = 0; dof < dofs; ++dof) {
    unit.data()[dof] = 1.0;
    M.col(dof) = (consistent * unit).reshaped();
    unit.data()[dof] = 0.0;
    lumped[dof] = body.row_sum_mass()[dof / 3];
  }
  const Eigen::MatrixXd L = lumped.asDiagonal(), inverse = free.cwiseQuotient(lumped).asDiagonal();
  return {inverse * (2.0 * L - M) * inverse, lumped};
}

TEST(CorrectedMass, IsTheMatrixAndItsInverse) {
  const auto body = solid(rough({2, 2, 2}, {3, 2, 1}));
  Supports supports;
  supports.fix(structure::nodes_on(body->space(), {Face::xi_minus}), {true, false, true});
  const Halo alone;
  const auto mass = structure::mass_of(*body, supports, alone);
  EXPECT_FALSE(mass->is_diagonal());
  const Dense dense = dense_inverse(*body, supports);
  const NodalVectors f = models::random_vectors(body->node_count(), 4);
  NodalVectors a(f), p(f);
  mass->apply_inverse_mass(f, a);
  const Eigen::VectorXd expected = dense.inverse * f.reshaped();
  EXPECT_LT((a.reshaped() - expected).norm(), 1e-13 * expected.norm());
  for (const Eigen::Index dof : supports.fixed_dofs()) EXPECT_EQ(a.data()[dof], 0.0);
  mass->apply_mass(a, p);
  NodalVectors free_f = f;
  supports.apply(free_f);
  supports.apply(p);
  EXPECT_LT((p - free_f).norm(), 1e-12 * f.norm());
  a = f;
  mass->apply_inverse_mass(a, a);
  EXPECT_LT((a.reshaped() - expected).norm(), 1e-13 * expected.norm()) << "in place";
}

/// Eigenvalues of M^-1 K, 0 of what is fixed.
Eigen::VectorXd squared_frequencies(const Eigen::MatrixXd& inverse_mass, const Eigen::MatrixXd& K) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(inverse_mass);
  const Eigen::MatrixXd root = of.eigenvectors() * of.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
                               of.eigenvectors().transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root * K * root).eigenvalues();
}

// 1/m <= M^-1 < 2/m: what contacts bound their time step with.
TEST(CorrectedMass, LiesBetweenRowSumsAndHalfOfThem) {
  for (const nurbs::Volume& patch : {rough({2, 2, 2}, {3, 2, 1}), models::quarter_ring(2, 2)}) {
    const auto body = solid(patch);
    const Dense dense = dense_inverse(*body, {});
    const Eigen::VectorXd root = dense.lumped.cwiseSqrt();
    const Eigen::MatrixXd scaled = root.asDiagonal() * dense.inverse * root.asDiagonal();
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues();
    EXPECT_NEAR(values.minCoeff(), 1.0, 1e-12);
    EXPECT_LT(values.maxCoeff(), 2.0);
    EXPECT_GT(values.maxCoeff(), 1.8);
    const Halo alone;
    const auto mass = structure::mass_of(*body, {}, alone);
    EXPECT_LT((mass->inverse_mass().reshaped() - 2.0 * dense.lumped.cwiseInverse()).norm(),
              1e-12 * values.size());
  }
}

TEST(CorrectedMass, HasTheStableStepOfTheDenseMatrices) {
  const nurbs::Volume patch = rough({2, 2, 2}, {3, 2, 1});
  for (const bool held : {false, true}) {
    Supports supports;
    if (held) supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, true});
    const ExplicitSolver solver(solid(patch), supports);
    const auto& body = static_cast<const Solid&>(solver.body());
    const double exact =
        2.0 /
        std::sqrt(
            squared_frequencies(dense_inverse(body, supports).inverse, models::stiffness(body)).maxCoeff());
    EXPECT_LE(solver.stable_time_step(), exact);
    EXPECT_GT(solver.stable_time_step(), 0.96 * exact);
  }
}

/// Relative error of the lowest longitudinal frequency pi/L sqrt(E/rho) of a free bar.
double error_of_bar(int elements, structure::TimeMass mass) {
  const auto body = std::make_unique<Solid>(models::block({8.0, 0.1, 0.1}, {elements, 1, 1}, 2),
                                            models::elastic(1.0, 0.0), structure::Integration{{}, {}, mass});
  Supports along;  // x alone
  std::vector<int> all(body->node_count());
  for (int A = 0; A < body->node_count(); ++A) all[A] = A;
  along.fix({all.begin(), all.end()}, {false, true, true});
  Eigen::MatrixXd inverse = dense_inverse(*body, along).inverse;
  if (mass == structure::TimeMass::lumped) {
    inverse.setZero();
    for (int A = 0; A < body->node_count(); ++A) inverse(3 * A, 3 * A) = 1.0 / body->row_sum_mass()[A];
  }
  const Eigen::VectorXd squares = squared_frequencies(inverse, models::stiffness(*body));
  const double exact = std::pow(nurbs::kPi / 8.0, 2);
  const double nearest = *std::min_element(squares.begin(), squares.end(), [&](double a, double b) {
    return std::abs(a - exact) < std::abs(b - exact);
  });
  return std::sqrt(nearest / exact) - 1.0;
}

// Row sums make waves slow by (k h)^2 / 8 with quadratic splines; corrected once, of fourth order.
TEST(CorrectedMass, MakesWavesOfFourthOrder) {
  using structure::TimeMass;
  const double kh = nurbs::kPi / 8.0;  // 8 elements
  EXPECT_NEAR(error_of_bar(8, TimeMass::lumped), -kh * kh / 8.0, 0.1 * kh * kh / 8.0);
  const double coarse = error_of_bar(4, TimeMass::corrected), fine = error_of_bar(8, TimeMass::corrected);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.4);
  EXPECT_LT(std::abs(fine), 0.05 * kh * kh / 8.0);
}

/// From rest under gravity g, all nodes alike.
void expect_fall(ExplicitSolver& solver, const Vector3& g) {
  const NodalVectors none = models::no_forces(solver);
  solver.set_load(structure::gravity_load(solver.body(), g));
  const double dt = 0.5 * solver.stable_time_step();
  solver.set_time_step(dt);
  solver.initialise_forces(none);
  for (int n = 0; n < 50; ++n) models::step(solver, none);
  const double t = 50 * dt, mass = solver.mass().nodal_mass().sum();
  for (int A = 0; A < solver.positions().cols(); ++A)
    EXPECT_LT((solver.displacements().col(A) - 0.5 * t * t * g).norm(), 1e-11 * t * t);
  EXPECT_NEAR(solver.kinetic_energy(), 0.5 * mass * g.squaredNorm() * t * t, 1e-11 * t * t);
  EXPECT_LT((solver.linear_momentum() - mass * t * g).norm(), 1e-11 * t);
}

TEST(CorrectedMass, FallsExactlyUnderGravity) {
  ExplicitSolver solver(solid(rough({2, 2, 2})), {});
  expect_fall(solver, {0.1, -0.2, 0.3});
}

// Of a cube of side 2, density 1: 16/3 about any axis, of which row sums with 2 elements make 1.5 times that.
TEST(CorrectedMass, HasNearlyTheRotationalInertia) {
  ExplicitSolver solver(solid(models::block({2, 2, 2}, {2, 2, 2}, 2)), {});
  const Vector3 omega(0.3, -0.1, 0.7), centre(1, 1, 1);
  NodalVectors v = models::no_forces(solver);
  for (int A = 0; A < v.cols(); ++A) v.col(A) = omega.cross(Vector3(solver.positions().col(A)) - centre);
  solver.set_velocities(v);
  EXPECT_LT((solver.angular_momentum(centre) - 16.0 / 3.0 * omega).norm(), 0.15 * 16.0 / 3.0 * omega.norm());
  EXPECT_NEAR(solver.angular_momentum(centre).dot(omega), 2.0 * solver.kinetic_energy(), 1e-12);
}

// Velocities and momenta of a symmetric mass are parallel on the whole: none is lost where x moves on with v.
TEST(CorrectedMass, KeepsTheSpinOfAFreeBody) {
  const nurbs::Volume patch = rough({2, 2, 2}, {3, 2, 1});
  ExplicitSolver solver(
      std::make_unique<Solid>(patch, std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.3, 1.0),
                              kCorrected),
      {});
  const Vector3 omega(0.03, -0.01, 0.05), about(5, 0, 1);
  NodalVectors v = 0.01 * models::random_vectors(solver.body().node_count(), 3);
  for (int A = 0; A < v.cols(); ++A) v.col(A) += omega.cross(Vector3(solver.positions().col(A)));
  solver.set_velocities(v);
  solver.set_time_step(0.5 * solver.stable_time_step());
  const NodalVectors none = models::no_forces(solver);
  solver.initialise_forces(none);
  const Vector3 before = solver.angular_momentum(about);
  for (int n = 0; n < 300; ++n) models::step(solver, none);
  EXPECT_LT((solver.angular_momentum(about) - before).norm(), 1e-12 * before.norm());
  EXPECT_GT(solver.displacements().cwiseAbs().maxCoeff(), 1.0) << "it has turned far";
}

// Works are summed from velocities and forces alone, kinetic energy is that of momenta.
TEST(CorrectedMass, ItsLedgerIsClosedToRoundOff) {
  Supports supports;
  const nurbs::Volume patch = rough({2, 2, 2}, {3, 2, 1});
  supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, false});
  ExplicitSolver solver(solid(patch), supports);
  const int nodes = solver.body().node_count();
  solver.set_load(structure::gravity_load(solver.body(), {0.3, -0.2, 0.5}));
  solver.set_velocities(models::random_vectors(nodes, 3));
  solver.set_time_step(0.5 * solver.stable_time_step());
  solver.initialise_forces(0.1 * models::random_vectors(nodes, 10));
  const double K_0 = solver.kinetic_energy();
  double turned_over = K_0;
  for (int n = 1; n <= 200; ++n) {
    models::step(solver, 0.1 * models::random_vectors(nodes, 10 + n));
    const structure::Work work = solver.work();
    turned_over = std::max(turned_over, solver.kinetic_energy());
    ASSERT_NEAR(solver.kinetic_energy() - K_0 + work.internal - work.loads - work.forces, 0.0,
                1e-13 * turned_over);
  }
  const std::vector<double> saved = solver.save();
  ExplicitSolver other(solid(patch), supports);
  other.load(saved);
  EXPECT_EQ(other.kinetic_energy(), solver.kinetic_energy());
}

// A support that moves as all else is pushed moves a body that is not strained: each node has its share.
TEST(CorrectedMass, GoesWithItsSupportAsABlockDoes) {
  Supports supports;
  const nurbs::Volume patch = rough({2, 2, 2}, {3, 2, 1});
  const Vector3 g(0.1, -0.2, 0.3);
  supports.move(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, true}, g,
                [](double t) { return 0.5 * t * t; });
  ExplicitSolver solver(solid(patch), supports);
  expect_fall(solver, g);
  const double t = solver.time();
  EXPECT_NEAR(solver.work().supports + solver.work().loads, solver.kinetic_energy(), 1e-11 * t * t);
}

// Forces of supports and loads together are what changes momentum.
TEST(CorrectedMass, SupportsTakeWhatIsLeftOfTheForces) {
  Supports supports;
  const nurbs::Volume patch = rough({2, 2, 2}, {3, 2, 1});
  const structure::NodeSet foot = structure::nodes_on(patch.space, {Face::xi_minus});
  supports.fix(foot, {true, true, true});
  ExplicitSolver solver(solid(patch), supports);
  solver.keep_reactions();
  solver.set_velocities(models::random_vectors(solver.body().node_count(), 3));
  const double dt = 0.5 * solver.stable_time_step();
  solver.set_time_step(dt);
  const NodalVectors F = 0.1 * models::random_vectors(solver.body().node_count(), 10);
  solver.initialise_forces(F);
  structure::NamedSupport support{"foot", {}, {}};
  for (const Eigen::Index dof : supports.fixed_dofs()) support.dofs.push_back(dof);
  const Vector3 inertia = solver.accelerations() * solver.mass().nodal_mass();
  EXPECT_LT((solver.reaction(support) + F.rowwise().sum() - inertia).norm(), 1e-12 * F.norm());
}

}  // namespace
