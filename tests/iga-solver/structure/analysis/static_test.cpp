// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibrium under dead loads, beside closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/analysis/coloured_products.h"
#include "structure/analysis/conjugate_gradients.h"
#include "structure/analysis/static_equilibrium.h"
#include "structure/conditions/loads.h"
#include "structure/conditions/probe.h"
#include "structure/weld.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::NewtonIteration;
using structure::PreconditionerKind;
using structure::Solid;
using structure::StaticEquilibrium;
using structure::Supports;

constexpr PreconditionerKind kKinds[] = {PreconditionerKind::sparse, PreconditionerKind::tensor,
                                         PreconditionerKind::nodes};

/// Of a block, planes x = 0, y = 0, z = 0 stay in themselves.
Supports symmetry(const Solid& solid) {
  Supports supports;
  const nurbs::Space<3>& space = solid.patch(0).space();
  supports.fix(structure::nodes_on(space, {Face::xi_minus}), {true, false, false});
  supports.fix(structure::nodes_on(space, {Face::eta_minus}), {false, true, false});
  supports.fix(structure::nodes_on(space, {Face::zeta_minus}), {false, false, true});
  return supports;
}

Supports clamped(const Solid& solid, const std::vector<Face>& faces) {
  Supports supports;
  for (const Face face : faces)
    supports.fix(structure::nodes_on(solid.patch(0).space(), {face}), {true, true, true});
  return supports;
}

std::shared_ptr<const structure::Material> law(const char* word, double E, double nu) {
  for (const structure::MaterialLaw& one : structure::material_laws())
    if (one.word == std::string(word)) return one.make({E, nu, 1.0});
  return nullptr;
}

Vector3 corner(const Solid& solid, const NodalVectors& u) { return u.col(solid.node_count() - 1); }

TEST(ColouredProducts, GiveTheStiffness) {
  for (const nurbs::Volume& patch :
       {models::block({3, 2, 1}, {4, 3, 1}, {2, 3, 2}), models::quarter_ring(2, 3)}) {
    const Solid solid(patch, models::elastic());
    const Supports supports = symmetry(solid);
    const NodalVectors u = NodalVectors::Zero(3, solid.node_count());
    const structure::Tangent tangent(solid, supports, u);
    const std::vector<int> number = structure::numbers_of_free(supports, solid.node_count());
    const structure::NodeGraph graph(solid);
    const Eigen::MatrixXd K = models::stiffness(solid),
                          lower = structure::lower_triangle(graph, tangent.product(), number);
    double largest = 0.0;
    for (Eigen::Index a = 0; a < K.rows(); ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        if (number[a] >= 0 && number[b] >= 0)
          largest = std::max(largest, std::abs(lower(number[a], number[b]) - K(a, b)));
    EXPECT_LT(largest, 1e-12 * K.norm());
    const std::vector<structure::Matrix3> blocks = structure::nodal_blocks(graph, tangent.product());
    for (int A = 0; A < solid.node_count(); ++A)
      for (int i = 0; i < 3; ++i)
        if (number[3 * A + i] >= 0) {
          ASSERT_NEAR(blocks[A](i, i), K(3 * A + i, 3 * A + i), 1e-12 * K.norm());
        }
  }
}

TEST(Static, BarUnderTractionHasHookesStrain) {
  constexpr double kE = 200.0, kNu = 0.3, kStress = 0.02;
  for (const PreconditionerKind kind : kKinds) {
    const Solid solid(models::block({10, 1, 2}, {5, 2, 2}, 2), models::elastic(kE, kNu));
    const Supports supports = symmetry(solid);
    const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {kStress, 0, 0});
    StaticEquilibrium statics(solid, supports, load, {1, 1e-10, 25, kind});
    int iterations = 0;
    statics.solve([&](const NewtonIteration&) { ++iterations; });
    EXPECT_EQ(iterations, 1);  // the law is linear
    const double strain = kStress / kE;
    for (int A = 0; A < solid.node_count(); ++A) {
      const Vector3 X = solid.reference().col(A);
      const Vector3 expected = strain * Vector3(X[0], -kNu * X[1], -kNu * X[2]);
      EXPECT_LT((statics.displacements().col(A) - expected).norm(), 1e-9 * strain)
          << statics.preconditioner();
    }
  }
}

// An end that is moved: the same stretch as by the stress of the closed form.
TEST(Static, SupportsMoveWithTheLoadFactor) {
  const Solid solid(models::block({2, 1, 1}, {2, 2, 2}, 2), law("neo_hooke", 1000.0, 0.3));
  Supports supports = symmetry(solid);
  supports.move(structure::nodes_on(solid.patch(0).space(), {Face::xi_plus}), {true, false, false},
                {0.4, 0, 0}, structure::ramp(0.0, 1.0));
  const NodalVectors no_load = NodalVectors::Zero(3, solid.node_count());
  StaticEquilibrium statics(solid, supports, no_load, {2, 1e-11});
  statics.solve();
  NodalVectors force(3, solid.node_count());
  solid.internal_force(statics.displacements(), force);
  double reaction = 0.0;
  for (const int A : structure::nodes_on(solid.patch(0).space(), {Face::xi_plus})) reaction += force(0, A);
  EXPECT_NEAR(reaction, 174.929147, 1e-6);
  EXPECT_NEAR(corner(solid, statics.displacements())[1], 0.94563262 - 1.0, 1e-8);
}

// Uniaxial stress of neo-Hooke's and St. Venant's law, E = 1000, nu = 0.3: stretch, P, lateral.
TEST(Static, HomogeneousFiniteStretchIsTheClosedForm) {
  struct Case {
    const char* word;
    double stretch, stress, lateral;
  };
  for (const Case& c :
       {Case{"neo_hooke", 0.9, -108.722185, 1.03170243}, Case{"neo_hooke", 1.2, 174.929147, 0.94563262},
        Case{"neo_hooke", 2.0, 646.744660, 0.79807754},
        Case{"saint_venant_kirchhoff", 1.5, 937.5, 0.79056942}}) {
    const Solid solid(models::block({2, 1, 1}, {2, 2, 2}, 2), law(c.word, 1000.0, 0.3));
    const Supports supports = symmetry(solid);
    const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {c.stress, 0, 0});
    for (const PreconditionerKind kind : kKinds) {
      StaticEquilibrium statics(solid, supports, load, {2, 1e-11, 25, kind});
      statics.solve();
      const Vector3 u = corner(solid, statics.displacements());
      EXPECT_NEAR(1.0 + u[0] / 2.0, c.stretch, 1e-8) << c.word;
      EXPECT_NEAR(1.0 + u[1], c.lateral, 1e-8) << c.word;
      EXPECT_NEAR(1.0 + u[2], c.lateral, 1e-8) << c.word;
    }
  }
}

// Dead load P L^2 / (E I) = alpha at the end of a slender cantilever: v / L of the elastica (Bisshopp &
// Drucker 1945); of a solid with L / h = 100 and p = 3, 10 elements, 0.01 % of it.
TEST(Static, CantileverBendsAsTheElastica) {
  struct Case {
    double alpha, v, u;
  };
  const double length = 100.0, h = 1.0, E = 12e4;
  const Solid solid(models::block({length, 1, h}, {16, 1, 1}, {3, 2, 3}),
                    law("saint_venant_kirchhoff", E, 0.0));
  const Supports supports = clamped(solid, {Face::xi_minus});
  const structure::Probe end = structure::probe_at("end", solid.patch(0).space(), {1.0, 0.5, 0.5});
  for (const Case& c :
       {Case{0.5, 0.162144, 0.015919}, Case{1.0, 0.301721, 0.056433}, Case{3.0, 0.603253, 0.254420}}) {
    const double P = c.alpha * E * (h * h * h / 12.0) / (length * length);
    const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {0, 0, P / h});
    StaticEquilibrium statics(solid, supports, load, {4});
    int iterations = 0;
    statics.solve([&](const NewtonIteration&) { ++iterations; });
    EXPECT_LT(iterations, 80);
    const Vector3 u = end.value(statics.displacements()) / length;
    EXPECT_NEAR(u[2], c.v, 3e-4 * c.v);
    EXPECT_NEAR(-u[0], c.u, 6e-4 * c.u);
  }
}

// Orders of convergence of the residuals r: ln(r3 / r2) / ln(r2 / r1) near 2.
TEST(Static, NewtonConvergesQuadratically) {
  const Solid solid(models::block({2, 1, 1}, {4, 2, 2}, 2), law("neo_hooke", 1.0, 0.3));
  const Supports supports = clamped(solid, {Face::xi_minus});
  const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {0.05, 0.02, -0.01});
  std::vector<double> residuals;
  StaticEquilibrium statics(solid, supports, load, {1, 1e-12});
  statics.solve([&](const NewtonIteration& i) { residuals.push_back(i.residual); });
  ASSERT_GE(residuals.size(), 4U);
  double best = 0.0;
  for (std::size_t k = 2; k < residuals.size(); ++k)
    if (residuals[k] > 1e-14)
      best = std::max(
          best, std::log(residuals[k] / residuals[k - 1]) / std::log(residuals[k - 1] / residuals[k - 2]));
  EXPECT_GT(best, 1.7);
  EXPECT_LE(residuals.size(), 10U);
}

int products(int elements, int degree, PreconditionerKind kind) {
  const Solid solid(models::block({2, 1, 1}, {2 * elements, elements, elements}, degree), models::elastic());
  const Supports supports = clamped(solid, {Face::xi_minus});
  const NodalVectors load = structure::traction_load(solid, {0, Face::zeta_plus}, {0, 0, 1});
  int count = 0;
  StaticEquilibrium statics(solid, supports, load, {1, 1e-8, 25, kind});
  statics.solve([&](const NewtonIteration& i) { count += i.products; });
  return count;
}

TEST(Static, FastDiagonalisationTakesAsManyProductsOnFineMeshesAsOnCoarseOnes) {
  const int coarse = products(4, 2, PreconditionerKind::tensor);
  EXPECT_LT(coarse, 60);
  EXPECT_LT(products(12, 2, PreconditionerKind::tensor), 1.3 * coarse);
  EXPECT_LT(products(8, 4, PreconditionerKind::tensor), 1.3 * coarse);
  EXPECT_GT(products(12, 2, PreconditionerKind::nodes), 2 * coarse);  // what it is for
  EXPECT_LT(products(6, 2, PreconditionerKind::sparse), 4);
}

TEST(Static, ReactionsOfAGravityLoadAreTheWeight) {
  const Solid solid(models::distorted(models::block({2, 1, 1}, {4, 3, 3}, 2), 0.02), models::elastic(1e3));
  const Supports supports = clamped(solid, {Face::zeta_minus});
  const NodalVectors load = structure::gravity_load(solid, {0, 0, -1});
  for (const PreconditionerKind kind : kKinds) {
    StaticEquilibrium statics(solid, supports, load, {1, 1e-10, 25, kind});
    statics.solve();
    NodalVectors reactions(3, solid.node_count());
    solid.internal_force(statics.displacements(), reactions);
    reactions -= load;
    EXPECT_NEAR(reactions.row(2).sum(), solid.row_sum_mass().sum(), 1e-9);
    NodalVectors free = reactions;
    supports.apply(free);
    EXPECT_LT(free.norm(), 1e-9 * load.norm());
  }
}

TEST(Static, RefusesABodyThatCanMove) {
  const Solid solid(models::block({2, 1, 1}, {2, 1, 1}, 2), models::elastic());
  const NodalVectors load = structure::gravity_load(solid, {0, 0, -1});
  Supports hinge;
  hinge.fix(structure::nodes_on(solid.patch(0).space(), {Face::xi_minus, Face::zeta_minus}),
            {true, true, true});
  try {
    const StaticEquilibrium statics(solid, hinge, load);
    FAIL() << "a body on a hinge was taken";
  } catch (const structure::NoEquilibrium& error) {
    EXPECT_NE(std::string(error.what()).find("free in 1 of its 6 rigid motions"), std::string::npos);
  }
}

/// Two unit blocks of an element each, of which the second stands at the first one's edge x = y = 1.
Solid two_at_an_edge(int degree) {
  const nurbs::Volume first = models::block({1, 1, 1}, {1, 1, 1}, degree);
  nurbs::Volume second = first;
  second.control_points.colwise() += Vector3(1, 1, 0);
  const structure::NodeNumbering nodes = structure::weld({first, second});
  std::vector<structure::PatchBoxes> boxes;
  for (int p = 0; p < 2; ++p) boxes.emplace_back(first.space, structure::box_cuts(first.space));
  return {{{first, models::elastic(2e7)}, {second, models::elastic(2e7)}},
          nodes,
          {},
          structure::Partition(boxes, nodes, 1).part(0)};
}

// Round-off decides whether conjugate gradients end, and how far the second block is then.
TEST(Static, RefusesAMechanism) {
  for (const int degree : {1, 2})
    for (const double traction : {1.0, 1000.0})
      for (const PreconditionerKind kind : {PreconditionerKind::sparse, PreconditionerKind::nodes}) {
        const Solid solid = two_at_an_edge(degree);
        const Supports supports = clamped(solid, {Face::xi_minus});
        const NodalVectors load = structure::traction_load(solid, {1, Face::xi_plus}, {0, traction, 0});
        try {
          StaticEquilibrium statics(solid, supports, load, {1, 1e-8, 25, kind});
          statics.solve();
          FAIL() << "found an equilibrium at displacements of " << statics.displacements().norm();
        } catch (const std::runtime_error& error) {
          EXPECT_NE(std::string(error.what()).find("move freely"), std::string::npos) << error.what();
        }
      }
}

// Balanced but for round-off, which is all that a body is strained by which supports take along as it is.
TEST(Static, FollowsSupportsWithoutAStrain) {
  const Solid solid(models::block({1, 1, 1}, {2, 2, 2}, 2), models::elastic(2e7));
  Supports supports;
  supports.move(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, true, true}, {0.3, 0.2, 0.1},
                structure::ramp(0.0, 1.0));
  const NodalVectors no_load = NodalVectors::Zero(3, solid.node_count());
  StaticEquilibrium statics(solid, supports, no_load);
  statics.solve();
  EXPECT_LT((statics.displacements().colwise() - Vector3(0.3, 0.2, 0.1)).norm(), 1e-9);
}

// A load that grows with what it does, faster than any stiffness.
TEST(Static, RefusesWhatGrowsBeyondNumbers) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 2), models::elastic());
  const Supports supports = clamped(solid, {Face::xi_minus});
  const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {1, 0, 0});
  const auto growing = [&](const NodalVectors& u, NodalVectors& f) {
    f = load * (1.0 + std::pow(u.lpNorm<Eigen::Infinity>(), 2));
  };
  StaticEquilibrium statics(solid, supports, growing);
  EXPECT_THROW(statics.solve(), structure::NoEquilibrium) << statics.displacements().norm();
}

// St. Venant's bar has no equilibrium under a pressure beyond its limit: P = E (s^3 - s) / 2 is least at s^2
// = 1/3.
TEST(Static, SaysWhereThereIsNoEquilibrium) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 2), law("saint_venant_kirchhoff", 1.0, 0.0));
  const Supports supports = symmetry(solid);
  const double limit = 0.5 * (std::pow(3.0, -1.5) - std::pow(3.0, -0.5));
  const NodalVectors load = structure::traction_load(solid, {0, Face::xi_plus}, {2.0 * limit, 0, 0});
  StaticEquilibrium statics(solid, supports, load, {4});
  double reached = 0.0;
  try {
    statics.solve({}, [&](double load_factor) { reached = load_factor; });
    FAIL() << "found an equilibrium that is none";
  } catch (const structure::NoEquilibrium& error) {
    EXPECT_GT(reached, 0.45);
    EXPECT_LE(reached, 0.5);
    EXPECT_NE(std::string(error.what()).find("no equilibrium beyond load factor"), std::string::npos);
  }
}

}  // namespace
