// SPDX-License-Identifier: GPL-2.0-or-later
// Free vibrations, beside closed forms and the eigenvalues of the dense matrix.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "models.h"
#include "structure/analysis/modes.h"
#include "structure/analysis/static_equilibrium.h"
#include "structure/conditions/loads.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::Mode;
using structure::PreconditionerKind;
using structure::Solid;
using structure::Supports;

NodalVectors undeformed(const Solid& solid) { return NodalVectors::Zero(3, solid.node_count()); }

TEST(Modes, AreTheEigenvaluesOfTheDenseMatrix) {
  const Solid solid(models::distorted(models::block({3, 2, 1}, {3, 2, 2}, 2), 0.02), models::elastic());
  Supports supports;
  supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::xi_minus}), {true, true, true});
  const Eigen::VectorXd expected =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(models::mass_scaled_stiffness(solid, supports))
          .eigenvalues();
  for (const PreconditionerKind kind :
       {PreconditionerKind::sparse, PreconditionerKind::tensor, PreconditionerKind::nodes}) {
    const std::vector<Mode> modes =
        structure::lowest_modes(solid, supports, undeformed(solid), {8, 1e-10, kind});
    ASSERT_EQ(modes.size(), 8U);
    for (int k = 0; k < 8; ++k) EXPECT_NEAR(modes[k].eigenvalue, expected[k], 1e-9 * expected[k]) << k;
  }
}

TEST(Modes, MayBeAllButOne) {
  const Solid solid(models::block({3, 2, 1}, {1, 1, 1}, 2), models::elastic());
  Supports held;
  held.fix(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, true, true});
  for (const Supports& supports : {held, Supports()}) {
    const Eigen::VectorXd expected =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(models::mass_scaled_stiffness(solid, supports))
            .eigenvalues();
    const int count = static_cast<int>(expected.size()) - 1;
    const std::vector<Mode> modes = structure::lowest_modes(solid, supports, undeformed(solid), {count});
    ASSERT_EQ(modes.size(), std::size_t(count));
    for (int k = 0; k < count; ++k)
      EXPECT_NEAR(modes[k].eigenvalue, expected[k], 1e-7 * (expected[k] + expected[6])) << k;
  }
}

// A body of other units has the same modes: omega^2 ~ E / (rho L^2), of values that are far from 1, too.
TEST(Modes, ScaleWithTheModulusAndWithLengths) {
  const auto eigenvalues = [](double E, double length, bool is_held) {
    const Solid solid(models::block({2 * length, 1.7 * length, 0.3 * length}, {4, 3, 2}, 2),
                      models::elastic(E, 0.3));
    Supports supports;
    if (is_held) supports.fix(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, true, true});
    std::vector<double> values;
    for (const Mode& mode : structure::lowest_modes(solid, supports, undeformed(solid), {20}))
      values.push_back(mode.eigenvalue * length * length / E);
    return values;
  };
  for (const bool is_held : {true, false}) {
    const std::vector<double> expected = eigenvalues(1.0, 1.0, is_held);
    for (const double E : {1e-12, 1.0, 1e12})
      for (const double length : {1e-3, 1.0}) {
        const std::vector<double> values = eigenvalues(E, length, is_held);
        for (int k = is_held ? 0 : 6; k < 20; ++k)
          EXPECT_NEAR(values[k], expected[k], 1e-8 * expected[k]) << k << ", E " << E << ", L " << length;
      }
  }
}

// Beside omega^2 of springs that are so weak, 1/omega^2 of elastic modes is round-off.
TEST(Modes, OfABodyOnVeryWeakSpringsAreThoseOfAFreeOne) {
  const Solid solid(models::block({3, 2, 1}, {3, 2, 1}, 2), models::elastic());
  structure::Springs springs;
  for (const int corner : {0, 4, 15, 45}) springs.add({{corner, 1e-12 * Eigen::Matrix3d::Identity()}});
  const std::vector<Mode> free = structure::lowest_modes(solid, {}, undeformed(solid), {12}),
                          sprung = structure::lowest_modes(solid, {}, undeformed(solid), {12}, springs);
  for (int k = 6; k < 12; ++k)
    EXPECT_NEAR(sprung[k].eigenvalue, free[k].eigenvalue, 1e-7 * free[k].eigenvalue) << k;
}

// Beside those of a soft one all 1/omega^2 of a stiff piece are round-off, and Lanczos' method takes what it
// has there for modes.
TEST(Modes, OfPiecesWhoseStiffnessesAreFarApart) {
  const nurbs::Volume soft = models::block({1, 1, 1}, {1, 1, 1}, 1),
                      stiff = models::block({3, 2, 1}, {2, 2, 1}, 2);
  const structure::NodeNumbering nodes({soft.space.control_point_count(), stiff.space.control_point_count()});
  const structure::Partition whole({structure::PatchBoxes(soft.space, structure::box_cuts(soft.space)),
                                    structure::PatchBoxes(stiff.space, structure::box_cuts(stiff.space))},
                                   nodes, 1);
  const Solid both({{soft, models::elastic(1e-15)}, {stiff, models::elastic()}}, nodes, {}, whole.part(0)),
      alone(stiff, models::elastic());
  Supports of_both, of_one;
  const std::vector<int> ends = structure::nodes_on(stiff.space, {Face::xi_minus});
  std::vector<int> all = structure::nodes_on(soft.space, {Face::xi_minus});
  for (const int node : ends) all.push_back(soft.space.control_point_count() + node);
  of_both.fix(all, {true, true, true});
  of_one.fix(ends, {true, true, true});
  constexpr int kSoft = 12, kStiff = 3;
  const std::vector<Mode> found = structure::lowest_modes(both, of_both, undeformed(both), {kSoft + kStiff}),
                          expected = structure::lowest_modes(alone, of_one, undeformed(alone), {kStiff});
  for (int k = 0; k < kSoft; ++k) EXPECT_LT(found[k].eigenvalue, 1e-12) << k;
  for (int k = 0; k < kStiff; ++k)
    EXPECT_NEAR(found[kSoft + k].eigenvalue, expected[k].eigenvalue, 1e-7 * expected[k].eigenvalue) << k;
}

// The stiffness of a law of small strain is that of the reference, and so are the motions that cost nothing.
TEST(Modes, OfALawOfSmallStrainDoNotSeeThatTheBodyIsTurned) {
  const Solid solid(models::block({3, 2, 1}, {3, 2, 1}, 2), models::elastic());
  const Eigen::AngleAxisd turn(0.2, Vector3(1, 2, 3).normalized());
  const NodalVectors turned = turn.toRotationMatrix() * solid.reference() - solid.reference();
  const std::vector<Mode> found = structure::lowest_modes(solid, {}, turned, {9}),
                          expected = structure::lowest_modes(solid, {}, undeformed(solid), {9});
  for (int k = 0; k < 9; ++k)
    EXPECT_NEAR(found[k].eigenvalue, expected[k].eigenvalue, 1e-9 * expected[8].eigenvalue) << k;
}

// One after the other, of which there are never fewer than was said.
TEST(Modes, TellHowManySystemsAreSolved) {
  const Solid solid(models::block({3, 2, 1}, {2, 2, 1}, 2), models::elastic());
  Supports supports;
  supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::xi_minus}), {true, true, true});
  structure::ModeOptions options;
  options.count = 4;
  int solves = 0, least = 0;
  options.on_solve = [&](int solved, int at_least) {
    EXPECT_EQ(solved, ++solves);
    EXPECT_GE(at_least, least);
    least = at_least;
  };
  structure::lowest_modes(solid, supports, undeformed(solid), options);
  EXPECT_GT(least, options.count);
  EXPECT_GE(solves, least);
}

TEST(Modes, OfAFreeBlockSixAreRigid) {
  const Solid solid(models::block({3, 2, 1}, {4, 3, 2}, 2), models::elastic());
  const Eigen::VectorXd& m = solid.row_sum_mass();
  for (const PreconditionerKind kind : {PreconditionerKind::sparse, PreconditionerKind::tensor}) {
    const std::vector<Mode> modes = structure::lowest_modes(solid, {}, undeformed(solid), {9, 1e-9, kind});
    const double elastic = modes[6].eigenvalue;
    EXPECT_GT(elastic, 1e-3);
    for (int k = 0; k < 6; ++k) EXPECT_LT(std::abs(modes[k].eigenvalue), 1e-7 * elastic);
    for (int j = 0; j < 9; ++j)
      for (int k = 0; k <= j; ++k)
        EXPECT_NEAR((modes[j].shape.cwiseProduct(modes[k].shape).colwise().sum() * m).value(),
                    j == k ? 1.0 : 0.0, 1e-8);
  }
}

/// Springs along one direction at the corners of a block's base, of the same stiffness.
structure::Springs at_corners(const Solid& solid, const Vector3& direction, double stiffness) {
  const NodalVectors& X = solid.reference();
  const Vector3 end = X.rowwise().maxCoeff();
  std::vector<structure::Springs::Spring> group;
  for (Eigen::Index A = 0; A < X.cols(); ++A) {
    const bool is_corner = (X(0, A) == 0 || X(0, A) == end[0]) && (X(1, A) == 0 || X(1, A) == end[1]);
    if (is_corner && X(2, A) == 0) group.push_back({A, stiffness * direction * direction.transpose()});
  }
  EXPECT_EQ(group.size(), 4U);
  structure::Springs springs;
  springs.add(std::move(group));
  return springs;
}

int zeros(const std::vector<Mode>& modes) {
  return static_cast<int>(
      std::count_if(modes.begin(), modes.end(), [](const Mode& mode) { return mode.frequency() == 0.0; }));
}

// A rigid block a, b, c on upright springs, k each, at its corners: it slides along x and y and turns about z
// freely, goes up with omega^2 = 4 k/m, and rocks with k a^2 / (m (a^2 + c^2)/12), or b for a.
TEST(Modes, OfAStiffBlockOnSpringsAreThoseOfARigidBody) {
  const double a = 3, b = 2, c = 1, k = 1e-6, m = a * b * c;
  const Solid solid(models::block({a, b, c}, {3, 2, 1}, 2), models::elastic(1.0, 0.3));
  const structure::Springs springs = at_corners(solid, {0, 0, 1}, k);
  const double up = 4 * k / m, about_x = up * 3 * b * b / (b * b + c * c),
               about_y = up * 3 * a * a / (a * a + c * c);
  for (const structure::MassKind mass : {structure::MassKind::lumped, structure::MassKind::consistent})
    for (const PreconditionerKind kind : {PreconditionerKind::automatic, PreconditionerKind::sparse,
                                          PreconditionerKind::tensor, PreconditionerKind::nodes}) {
      structure::ModeOptions options{8, 1e-9, kind, mass};
      const std::vector<Mode> modes = structure::lowest_modes(solid, {}, undeformed(solid), options, springs);
      ASSERT_EQ(modes.size(), 8U);
      EXPECT_EQ(zeros(modes), 3);
      EXPECT_NEAR(modes[3].eigenvalue, up, 1e-4 * up);
      EXPECT_GT(modes[6].eigenvalue, 1e3 * up) << "elastic";
      if (mass == structure::MassKind::lumped) continue;  // other moments of inertia
      EXPECT_NEAR(modes[4].eigenvalue, about_x, 1e-4 * about_x);
      EXPECT_NEAR(modes[5].eigenvalue, about_y, 1e-4 * about_y);
    }
}

TEST(Modes, AreZeroForWhatSupportsAndSpringsTogetherLeaveFree) {
  const Solid solid(models::block({3, 2, 1}, {3, 2, 1}, 2), models::elastic());
  Supports in_plane, without_x;
  in_plane.fix(structure::nodes_on(solid.space(), {Face::eta_minus}), {false, true, false});
  without_x.fix(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, false, false});
  const Vector3 up(0, 0, 1), oblique = Vector3(2, 1, 2) / 3;
  const auto zeros_of = [&](const Supports& supports, const Vector3& direction, double stiffness) {
    return zeros(structure::lowest_modes(solid, supports, undeformed(solid), {7},
                                         at_corners(solid, direction, stiffness)));
  };
  for (const double stiffness : {1e-8, 1e-3, 1e3}) {
    EXPECT_EQ(zeros_of({}, oblique, stiffness), 3);
    EXPECT_EQ(zeros_of(in_plane, up, stiffness), 1);          // along x
    EXPECT_EQ(zeros_of(in_plane, oblique, stiffness), 1);     // across the springs
    EXPECT_EQ(zeros_of(without_x, up, stiffness), 1);         // along y
    EXPECT_EQ(zeros_of(without_x, {0, 1, 0}, stiffness), 2);  // along z, and about the springs' plane
    EXPECT_EQ(zeros_of(without_x, {1, 0, 0}, stiffness), 3) << "they are where it is fixed, or beside it";
  }
}

double cantilever(const std::array<int, 3>& elements, int mode) {
  const Solid solid(models::block({10, 1, 1}, elements, 2), models::elastic(1.0, 0.0));
  Supports supports;  // bends in the plane x, z
  supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::xi_minus}), {true, true, true});
  supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::eta_minus}), {false, true, false});
  supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::eta_plus}), {false, true, false});
  const std::vector<Mode> modes = structure::lowest_modes(solid, supports, undeformed(solid), {4});
  return std::sqrt(modes[mode].eigenvalue * 12.0) * 100.0;  // omega L^2 sqrt(rho A / (E I))
}

// Independent code, lumped masses; Timoshenko's beam: 3.49303, 21.0915; second order in the mesh.
TEST(Modes, OfACantileverAreThoseOfTimoshenkosBeam) {
  const double coarse = cantilever({10, 1, 1}, 0), fine = cantilever({20, 2, 2}, 0);
  EXPECT_NEAR(coarse, 3.4709, 1e-3);
  EXPECT_NEAR(cantilever({10, 1, 1}, 1), 20.256, 1e-2);
  EXPECT_NEAR(fine, 3.4852, 1e-3);
  EXPECT_NEAR(cantilever({20, 2, 2}, 1), 20.786, 1e-2);
  const double limit = 3.4932;
  EXPECT_NEAR(std::log2((limit - coarse) / (limit - fine)), 1.5, 0.5);
}

/// Bars fixed at both ends that move along x alone, c = L = 1; so thin that all else is far above.
double bar_frequency(int elements, int degree, int mode) {
  const Solid solid(models::block({1, 0.05, 0.05}, {elements, 1, 1}, degree), models::elastic(1.0, 0.0));
  Supports supports;
  for (const Face end : {Face::xi_minus, Face::xi_plus})
    supports.fix(structure::nodes_on(solid.space(), {end}), {true, true, true});
  supports.fix(structure::nodes_on(solid.space(), {}), {false, true, true});
  structure::ModeOptions options{mode + 1, 1e-12};
  options.mass = structure::MassKind::consistent;
  return std::sqrt(structure::lowest_modes(solid, supports, undeformed(solid), options)[mode].eigenvalue);
}

// Hughes (2000), sec. 7.3.2: linear elements have omega^2 h^2 = 6 (1 - cos k h)/(2 + cos k h), above k^2 h^2;
// degree p converges with h^(2 p).
TEST(Modes, OfConsistentMassesAreThoseOfTheClosedFormAndOfOrderTwiceTheDegree) {
  const double pi = std::acos(-1.0);
  for (int mode = 0; mode < 3; ++mode) {
    const double theta = (mode + 1) * pi / 8;
    EXPECT_NEAR(bar_frequency(8, 1, mode), 8 * std::sqrt(6 * (1 - std::cos(theta)) / (2 + std::cos(theta))),
                1e-7);
  }
  for (const int degree : {2, 3}) {
    const double coarse = bar_frequency(4, degree, 1) - 2 * pi, fine = bar_frequency(8, degree, 1) - 2 * pi;
    EXPECT_GT(fine, 0.0);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0 * degree, 0.8);
  }
}

// Whatever the way to solve, free and held; the rigid motions of a free block stay.
TEST(Modes, OfConsistentMassesDoNotDependOnThePreconditioner) {
  const Solid solid(models::distorted(models::block({3, 2, 1}, {3, 2, 2}, 2), 0.02), models::elastic());
  Supports held;
  held.fix(structure::nodes_on(solid.space(), {Face::xi_minus}), {true, true, true});
  for (const Supports& supports : {held, Supports()}) {
    std::vector<double> seen;
    for (const PreconditionerKind kind : {PreconditionerKind::sparse, PreconditionerKind::tensor}) {
      structure::ModeOptions options{8, 1e-10, kind};
      options.mass = structure::MassKind::consistent;
      const std::vector<Mode> modes = structure::lowest_modes(solid, supports, undeformed(solid), options);
      seen.push_back(modes[7].eigenvalue);
      const bool is_free = supports.fixed_dofs().empty();
      EXPECT_EQ(std::abs(modes[5].eigenvalue) < 1e-7 * modes[7].eigenvalue, is_free);
    }
    EXPECT_NEAR(seen[0] / seen[1], 1.0, 1e-7);
    EXPECT_GT(seen[0], structure::lowest_modes(solid, supports, undeformed(solid), {8})[7].eigenvalue);
  }
}

// A stretched St. Venant-Kirchhoff bar is stiffer along its axis by (3 s^2 - 1) / 2.
TEST(Modes, AreThoseAboutADeformedState) {
  for (const structure::MaterialLaw& law : structure::material_laws()) {
    if (law.word != std::string("saint_venant_kirchhoff")) continue;
    const Solid solid(models::block({1, 0.1, 0.1}, {8, 1, 1}, 2), law.make({1.0, 0.0, 1.0}));
    Supports supports;
    for (const Face face : {Face::eta_minus, Face::eta_plus, Face::zeta_minus, Face::zeta_plus})
      supports.fix(structure::nodes_on(solid.patch(0).space(), {face}), {false, true, true});
    supports.fix(structure::nodes_on(solid.patch(0).space(), {Face::xi_minus}), {true, true, true});
    NodalVectors stretched = undeformed(solid);
    stretched.row(0) = 0.1 * solid.reference().row(0);
    const double before = structure::lowest_modes(solid, supports, undeformed(solid), {1}).front().eigenvalue,
                 after = structure::lowest_modes(solid, supports, stretched, {1}).front().eigenvalue;
    EXPECT_NEAR(after / before, (3.0 * 1.1 * 1.1 - 1.0) / 2.0, 1e-7);
    EXPECT_NEAR(std::sqrt(before), 1.5707963, 0.02);  // pi/2 c/L, lumped
  }
}

TEST(Modes, MoreThanThereAreIsRefused) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 1), models::elastic());
  EXPECT_THROW(structure::lowest_modes(solid, {}, undeformed(solid), {24}), std::invalid_argument);
}

}  // namespace
