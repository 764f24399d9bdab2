// SPDX-License-Identifier: GPL-2.0-or-later
// Solids of large-strain laws.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "models.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using structure::ExplicitSolver;
using structure::Matrix3;
using structure::Solid;
using structure::Supports;

using Law = std::shared_ptr<const structure::Material>;

Law neo_hooke(double E) { return std::make_shared<structure::NeoHooke>(E, 0.3, 1.0); }

Law stvk(double E = 1.0, double nu = 0.3, double density = 1.0) {
  return std::make_shared<structure::SaintVenantKirchhoff>(E, nu, density);
}

NodalVectors force(const Solid& solid, const NodalVectors& u) {
  NodalVectors f(3, solid.node_count());
  solid.internal_force(u, f);
  return f;
}

/// In every way to integrate it.
void expect_no_force_in_a_rigid_motion(const nurbs::Volume& patch, const Law& law, bool affine) {
  using structure::IntegrationMethod;
  using structure::Quadrature;
  const Matrix3 Q = Eigen::AngleAxisd(1.9, Vector3(3, 1, -2).normalized()).toRotationMatrix();
  const NodalVectors u =
      models::linear_field(Q - Matrix3::Identity(), patch.control_points).colwise() + Vector3(5, -7, 11);
  for (const Quadrature quadrature : {Quadrature::full, Quadrature::reduced, Quadrature::zou})
    for (const IntegrationMethod method : {IntegrationMethod::affine, IntegrationMethod::stored,
                                           IntegrationMethod::recomputed, IntegrationMethod::elements}) {
      if (method == IntegrationMethod::affine && !affine) continue;
      SCOPED_TRACE(testing::Message() << law->law() << ", " << name(quadrature) << ", " << name(method));
      const Solid solid(patch, law, {quadrature, method});
      const double h = std::cbrt(solid.volume() / patch.space.element_count());
      EXPECT_LT(force(solid, u).cwiseAbs().maxCoeff(), 1e-12 * 1000.0 * h * h);
      EXPECT_LT(solid.strain_energy(u), 1e-24 * 1000.0 * solid.volume());
    }
}

// PHYSICS C1: elements of 1 x 2 x 1.5 and the ring's, E = 1000.
TEST(LargeStrain, ExertsNoForceInARigidMotion) {
  for (const Law& law : models::large_strain_laws(1000.0)) {
    expect_no_force_in_a_rigid_motion(models::block({2, 4, 3}, {2, 2, 2}, 2), law, true);
    expect_no_force_in_a_rigid_motion(models::distorted(models::block({2, 4, 3}, {2, 2, 2}, 2), 0.1), law,
                                      false);
    expect_no_force_in_a_rigid_motion(models::quarter_ring(2, 3), law, false);
  }
}

// PHYSICS C11: the sides of one element, as wide as leaves them free, and the force along it.
void expect_uniaxial_stress(const Law& law, double stretch, double nominal_stress, double lateral) {
  const Vector3 size(1, 2, 3);
  const Solid solid(models::block(size, {1, 1, 1}, 2), law);
  const auto forces = [&](double b) {
    const Matrix3 H = Vector3(stretch - 1.0, b - 1.0, b - 1.0).asDiagonal();
    return force(solid, models::linear_field(H, solid.reference()));
  };
  const auto on_face = [&](const NodalVectors& f, int d) {  // sum over the face where coordinate d is largest
    double sum = 0.0;
    for (int A = 0; A < f.cols(); ++A)
      if (solid.reference()(d, A) == size[d]) sum += f(d, A);
    return sum;
  };
  double b = 1.0, before = 0.9;
  for (double f = on_face(forces(b), 1), f_before = on_face(forces(before), 1);
       std::abs(b - before) > 1e-14;) {
    const double next = b - f * (b - before) / (f - f_before);
    before = b;
    f_before = f;
    b = next;
    f = on_face(forces(b), 1);
    if (f == f_before) break;
  }
  EXPECT_NEAR(b, lateral, 1e-8);
  EXPECT_NEAR(on_face(forces(b), 0) / (size[1] * size[2]), nominal_stress, 1e-8 * std::abs(nominal_stress));
  EXPECT_NEAR(on_face(forces(b), 2), 0.0, 1e-9);
}

TEST(LargeStrain, HasTheClosedFormsOfUniaxialStress) {
  expect_uniaxial_stress(stvk(1000.0), 1.1, 115.5, 0.96798760);
  expect_uniaxial_stress(stvk(1000.0), 1.5, 937.5, 0.79056942);
  expect_uniaxial_stress(neo_hooke(1000.0), 0.9, -108.722185, 1.03170243);
  expect_uniaxial_stress(neo_hooke(1000.0), 1.1, 93.077432, 0.97149295);
  expect_uniaxial_stress(neo_hooke(1000.0), 1.2, 174.929147, 0.94563262);
  expect_uniaxial_stress(neo_hooke(1000.0), 2.0, 646.744660, 0.79807754);
}

TEST(LargeStrain, PassesThePatchTestOfAFiniteHomogeneousDeformation) {
  const Matrix3 H = 0.3 * models::some_gradient();
  for (const nurbs::Volume& patch :
       {models::block({1, 2, 3}, {3, 3, 3}, 2), models::block({1, 2, 3}, {2, 2, 2}, 3),
        models::distorted(models::block({3, 3, 3}, {3, 3, 3}, 1), 0.2)}) {
    const NodalVectors f = force(Solid(patch, stvk()), models::linear_field(H, patch.control_points));
    EXPECT_LT(f(Eigen::all, models::interior_nodes(patch.space)).cwiseAbs().maxCoeff(),
              1e-13 * f.cwiseAbs().maxCoeff());
  }
}

TEST(LargeStrain, ForceIsTheGradientOfTheStrainEnergy) {
  const Solid solid(models::quarter_ring(2, 2), stvk());
  const NodalVectors u = 0.1 * models::random_vectors(solid.node_count(), 1),
                     du = models::random_vectors(solid.node_count(), 2);
  // The energy is of fourth degree: central differences with h and 2 h have no error left.
  const auto slope = [&](double h) {
    return (solid.strain_energy(u + h * du) - solid.strain_energy(u - h * du)) / (2.0 * h);
  };
  const double expected = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
  EXPECT_NEAR(force(solid, u).cwiseProduct(du).sum(), expected, 1e-10 * std::abs(expected));
}

// Angular momentum about the origin with positions as they are: what the small-strain law does not keep.
TEST(LargeStrain, KeepsBothMomentaOfATumblingBlock) {
  for (const Law& law : models::large_strain_laws()) {
    SCOPED_TRACE(law->law());
    ExplicitSolver solver(std::make_unique<Solid>(models::block({2, 1, 1}, {2, 1, 1}, 2), law), {});
    NodalVectors v = 0.05 * models::random_vectors(solver.body().node_count(), 4);
    for (int A = 0; A < v.cols(); ++A)
      v.col(A) += Vector3(0.02, 0.03, 0.1).cross(Vector3(solver.positions().col(A)));
    solver.set_velocities(v);
    const NodalVectors none = NodalVectors::Zero(3, v.cols());
    solver.set_time_step(0.1);
    solver.initialise_forces(none);
    const Vector3 P = solver.linear_momentum(), L = solver.angular_momentum(Vector3::Zero());
    for (int step = 0; step < 1000; ++step) {
      solver.begin_step();
      solver.end_step(none);
    }
    EXPECT_LT((solver.linear_momentum() - P).norm(), 1e-12 * P.norm());
    EXPECT_LT((solver.angular_momentum(Vector3::Zero()) - L).norm(), 1e-12 * L.norm());
    EXPECT_GT(solver.displacements().cwiseAbs().maxCoeff(), 1.0);  // it has turned by 6 rad
  }
}

// A block that is squashed flat within a step: the run stops there, and says which element.
TEST(LargeStrain, StopsWhereAnElementHasNoVolumeLeft) {
  ExplicitSolver solver(std::make_unique<Solid>(models::block({3, 1, 1}, {3, 1, 1}, 2), neo_hooke(1.0)), {});
  NodalVectors v = NodalVectors::Zero(3, solver.body().node_count());
  for (int A = 0; A < v.cols(); ++A)  // the last element alone
    if (solver.positions()(0, A) > 2.9) v(0, A) = -20.0;
  solver.set_velocities(v);
  const NodalVectors none = NodalVectors::Zero(3, v.cols());
  solver.set_time_step(0.1);
  solver.initialise_forces(none);
  solver.begin_step();
  std::string message;
  try {
    solver.end_step(none);
  } catch (const structure::Diverged& problem) {
    message = problem.what();
  }
  EXPECT_NE(message.find("at time 0.1"), std::string::npos) << message;
  EXPECT_NE(message.find("element 2 (spans 2, 0, 0"), std::string::npos) << message;
  EXPECT_NE(message.find("is folded"), std::string::npos) << message;
}

// A cantilever (length 1, plane, nu = 0) under a dead end load alpha = P L^2 / EI, in equilibrium by Newton's
// method; the tangent is taken by central differences, whose error the iteration removes.
Vector3 end_displacement_of_a_cantilever(double thickness, int elements, int degree, double alpha) {
  const nurbs::Volume patch = models::block({1, 1, thickness}, {elements, 1, 1}, {degree, 1, degree});
  const Solid solid(patch, stvk(1.0, 0.0));
  Supports supports;
  supports.fix(structure::nodes_on(patch.space, {nurbs::Face::xi_minus}), {true, true, true});
  for (nurbs::Face side : {nurbs::Face::eta_minus, nurbs::Face::eta_plus})
    supports.fix(structure::nodes_on(patch.space, {side}), {false, true, false});
  NodalVectors mask = NodalVectors::Ones(3, solid.node_count());
  supports.apply(mask);
  std::vector<int> free;
  for (int dof = 0; dof < mask.size(); ++dof)
    if (mask.data()[dof] != 0.0) free.push_back(dof);
  const double EI = std::pow(thickness, 3) / 12.0;
  NodalVectors u = NodalVectors::Zero(3, solid.node_count());
  for (int load_step = 1; load_step <= 4; ++load_step) {
    const NodalVectors f_ext = structure::traction_load(solid, {0, nurbs::Face::xi_plus},
                                                        {0, 0, 0.25 * load_step * alpha * EI / thickness});
    for (double change = 1.0, rounds = 0; change > 1e-9 && rounds < 50; ++rounds) {
      Eigen::MatrixXd K(free.size(), free.size());
      constexpr double kStep = 1e-6;
      for (std::size_t j = 0; j < free.size(); ++j) {
        NodalVectors ahead = u, behind = u;
        ahead.data()[free[j]] += kStep;
        behind.data()[free[j]] -= kStep;
        const NodalVectors column = (force(solid, ahead) - force(solid, behind)) / (2.0 * kStep);
        K.col(j) = column.reshaped()(free);
      }
      const NodalVectors out_of_balance = f_ext - force(solid, u);
      const Eigen::VectorXd residual = out_of_balance.reshaped()(free), du = K.partialPivLu().solve(residual);
      for (std::size_t j = 0; j < free.size(); ++j) u.data()[free[j]] += du[j];
      change = du.cwiseAbs().maxCoeff();
    }
  }
  return nurbs::interpolate(patch.space, u, {1.0, 0.5, 0.5});
}

// PHYSICS C8, elastica at alpha = 1: deflection 0.301721, shortening 0.056433.
TEST(LargeStrain, BendsAsTheElastica) {
  const Vector3 cubic = end_displacement_of_a_cantilever(0.01, 10, 3, 1.0);
  EXPECT_NEAR(cubic.z() / 0.301721, 1.00002, 2e-4);
  EXPECT_NEAR(-cubic.x() / 0.056433, 1.0, 5e-4);
  const Vector3 quadratic = end_displacement_of_a_cantilever(0.01, 20, 2, 1.0);
  EXPECT_NEAR(quadratic.z() / 0.301721, 1.0 - 0.0022, 2e-4);
}

}  // namespace
