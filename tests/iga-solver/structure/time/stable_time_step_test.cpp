// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "models.h"
#include "nurbs/gauss_legendre.h"
#include "structure/material/saint_venant_kirchhoff.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using nurbs::Face;
using structure::LumpedMass;
using structure::Solid;
using structure::Supports;
using testing::AllOf;
using testing::HasSubstr;

double stable_step(const Solid& solid, const Supports& supports) {
  return structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), supports,
                                     NodalVectors::Zero(3, solid.node_count()));
}

void fix(Supports& supports, const Solid& solid, std::initializer_list<Face> faces,
         structure::Directions directions) {
  for (Face face : faces) supports.fix(structure::nodes_on(solid.space(), {face}), directions);
}

Supports clamped_at_xi_minus(const Solid& solid) {
  Supports supports;
  fix(supports, solid, {Face::xi_minus}, {true, true, true});
  return supports;
}

/// M^-1/2 K M^-1/2 of a law with the tangent dP_iJ = A_iJkL dH_kL, from basis functions alone.
template <class Tangent>
double dense_eigenvalue(const nurbs::Volume& patch, const Supports& supports, double density,
                        const Tangent& tangent) {
  const nurbs::Space<3>& space = patch.space;
  const int n = 3 * space.control_point_count();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd m = Eigen::VectorXd::Zero(n);
  for (int e = 0; e < space.element_count(); ++e) {
    const std::array<int, 3> span = space.element_indices(e);
    nurbs::QuadratureRule rule[3];
    for (int d = 0; d < 3; ++d) {
      const std::vector<double>& breaks = space.knots(d).breaks();
      rule[d] = nurbs::gauss_legendre(space.degree(d) + 1, breaks[span[d]], breaks[span[d] + 1]);
    }
    for (std::size_t i = 0; i < rule[0].points.size(); ++i)
      for (std::size_t j = 0; j < rule[1].points.size(); ++j)
        for (std::size_t k = 0; k < rule[2].points.size(); ++k) {
          nurbs::RationalBasis<3> basis;
          nurbs::evaluate_on_element(space, e, {rule[0].points[i], rule[1].points[j], rule[2].points[k]}, 1,
                                     basis);
          Eigen::MatrixXd dR(3, basis.count);
          models::Matrix3 J = models::Matrix3::Zero();
          for (int a = 0; a < basis.count; ++a) {
            dR.col(a) = models::Vector3(basis.dR[0][a], basis.dR[1][a], basis.dR[2][a]);
            J += patch.control_points.col(basis.control_point[a]) * dR.col(a).transpose();
          }
          const double w = rule[0].weights[i] * rule[1].weights[j] * rule[2].weights[k] * J.determinant();
          const Eigen::MatrixXd g = J.inverse().transpose() * dR;
          for (int a = 0; a < basis.count; ++a) {
            const int A = 3 * basis.control_point[a];
            m.segment<3>(A).array() += w * density * basis.R[a];
            for (int b = 0; b < basis.count; ++b)
              K.block<3, 3>(A, 3 * basis.control_point[b]) += w * tangent(g.col(a), g.col(b));
          }
        }
  }
  std::vector<int> free;
  for (int dof = 0; dof < n; ++dof)
    if (!std::binary_search(supports.fixed_dofs().begin(), supports.fixed_dofs().end(), dof))
      free.push_back(dof);
  const Eigen::VectorXd scale = m(free).cwiseSqrt().cwiseInverse();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
             Eigen::MatrixXd(scale.asDiagonal() * K(free, free) * scale.asDiagonal()), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Hooke's: the 3 x 3 block of nodes A and B whose functions have the gradients a and b.
struct Hooke {
  double E, nu;
  models::Matrix3 operator()(const models::Vector3& a, const models::Vector3& b) const {
    const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    return lambda * a * b.transpose() + mu * b * a.transpose() + mu * a.dot(b) * models::Matrix3::Identity();
  }
};

/// St. Venant-Kirchhoff about a homogeneous H: F B_A . C . (F B_B) + a . S b.
struct StrainedHooke {
  Hooke hooke;
  models::Matrix3 H;
  models::Matrix3 operator()(const models::Vector3& a, const models::Vector3& b) const {
    const double lambda = hooke.E * hooke.nu / ((1 + hooke.nu) * (1 - 2 * hooke.nu)),
                 mu = hooke.E / (2 * (1 + hooke.nu));
    const models::Matrix3 F = models::Matrix3::Identity() + H,
                          strain = 0.5 * (F.transpose() * F - models::Matrix3::Identity()),
                          S = lambda * strain.trace() * models::Matrix3::Identity() + 2 * mu * strain;
    return F * hooke(a, b) * F.transpose() + a.dot(S * b) * models::Matrix3::Identity();
  }
};

struct RandomBody {
  nurbs::Volume patch;
  Supports supports;
  Hooke law;
  double density;
};

/// Degrees 1 to 3, up to 4 elements a side that may be thin or graded, distorted, rational, held here and
/// there.
RandomBody random_body(unsigned seed) {
  std::mt19937 generator(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * generator() / double(std::mt19937::max());
  };
  const auto whole = [&](int low, int high) { return low + int(generator() % unsigned(high - low + 1)); };
  std::array<int, 3> elements{}, degrees{};
  do
    for (int d = 0; d < 3; ++d) elements[d] = whole(1, 4), degrees[d] = whole(1, 3);
  while ((elements[0] + degrees[0]) * (elements[1] + degrees[1]) * (elements[2] + degrees[2]) > 90);
  RandomBody body{models::block({1.0 * elements[0], 1.0 * elements[1], 1.0 * elements[2]}, elements, degrees),
                  {},
                  {std::pow(10.0, uniform(-3, 3)), uniform(-0.2, 0.45)},
                  std::pow(10.0, uniform(-3, 3))};
  body.patch = models::distorted(body.patch, uniform(0.0, 0.12));
  if (whole(0, 2) == 0) {
    std::vector<double> weights(body.patch.space.control_point_count());
    for (double& weight : weights) weight = uniform(0.8, 1.2);
    body.patch.space = nurbs::Space<3>(
        {body.patch.space.knots(0), body.patch.space.knots(1), body.patch.space.knots(2)}, weights);
  }
  for (int d = 0; d < 3; ++d) {
    const double size = std::pow(10.0, uniform(-1.5, 0.5)), grade = whole(0, 1) * uniform(0.0, 0.2);
    for (double& x : body.patch.control_points.row(d)) x = size * x * (1.0 + grade * x);
  }
  for (int side = whole(0, 6); side < 6; side += 2)
    body.supports.fix(structure::nodes_on(body.patch.space, {Face(side)}),
                      {whole(0, 1) == 1, whole(0, 1) == 1, whole(0, 1) == 1});
  return body;
}

/// Never above the true one, and near it.
void expect_below(double step, double eigenvalue, double near) {
  const double ratio = step * std::sqrt(eigenvalue) / 2.0;
  EXPECT_LE(ratio, 1.0);
  EXPECT_GE(ratio, near);
}

TEST(StableTimeStep, IsNeverAboveThatOfDenseEigenvalues) {
  double nearest = 0.0, farthest = 1.0;
  for (unsigned seed = 1; seed <= 240; ++seed) {
    SCOPED_TRACE(seed);
    const RandomBody body = random_body(seed);
    const Solid solid(body.patch, models::elastic(body.law.E, body.law.nu, body.density));
    const double exact = dense_eigenvalue(body.patch, body.supports, body.density, body.law);
    const double step = stable_step(solid, body.supports);
    expect_below(step, exact, 0.975);
    nearest = std::max(nearest, step * std::sqrt(exact) / 2.0);
    farthest = std::min(farthest, step * std::sqrt(exact) / 2.0);
  }
  RecordProperty("nearest", std::to_string(nearest));
  RecordProperty("farthest", std::to_string(farthest));
}

TEST(StableTimeStep, OfAStrainedSolidIsThatOfItsTangent) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomBody body = random_body(seed);
    body.supports = {};
    const Solid solid(
        body.patch, std::make_shared<structure::SaintVenantKirchhoff>(body.law.E, body.law.nu, body.density));
    const models::Matrix3 H = 0.2 * models::some_gradient() * (seed % 2 ? 1.0 : -0.5);
    const double exact = dense_eigenvalue(body.patch, {}, body.density, StrainedHooke{body.law, H});
    expect_below(structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), {},
                                             models::linear_field(H, body.patch.control_points)),
                 exact, 0.975);
  }
}

TEST(StableTimeStep, OfTheLastFreeDofIsExact) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 2), models::elastic());
  Supports supports;
  structure::NodeSet others;
  for (int A = 1; A < solid.node_count(); ++A) others.push_back(A);
  supports.fix({0}, {true, false, true});
  supports.fix(others, {true, true, true});
  expect_below(stable_step(solid, supports),
               dense_eigenvalue({solid.space(), solid.reference()}, supports, 1.0, Hooke{1.0, 0.3}), 0.9999);
}

// The stiffness of a linear law does not know of the displacement about which it is taken.
TEST(StableTimeStep, OfALinearLawIsTheSameAboutAnyDisplacement) {
  const Solid solid(models::distorted(models::block({2, 2, 1}, {2, 2, 1}, 2), 0.05), models::elastic());
  const LumpedMass mass(solid.row_sum_mass());
  const Supports supports = clamped_at_xi_minus(solid);
  NodalVectors u = models::random_vectors(solid.node_count(), 9);
  supports.apply(u);
  EXPECT_NEAR(structure::stable_time_step(solid, mass, supports, u) / stable_step(solid, supports), 1.0,
              1e-3);
}

/// Counts evaluations of the internal force of a solid.
class CountingSolid final : public structure::Body {
 public:
  explicit CountingSolid(const Solid& solid) : solid_(solid) {}
  int evaluations() const { return evaluations_; }

  void internal_force(const NodalVectors& u, NodalVectors& f) const override {
    ++evaluations_;
    solid_.internal_force(u, f);
  }
  int node_count() const override { return solid_.node_count(); }
  const NodalVectors& reference() const override { return solid_.reference(); }
  structure::PatchSpaces patches() const override { return solid_.patches(); }
  nurbs::BoundarySurface skin(const structure::SkinPiece& piece) const override { return solid_.skin(piece); }
  std::vector<structure::SkinBox> skin_boxes(const structure::SkinPiece& piece) const override {
    return solid_.skin_boxes(piece);
  }
  structure::ExactSum volume_sum() const override { return solid_.volume_sum(); }
  std::vector<const structure::Material*> materials() const override { return solid_.materials(); }
  const Eigen::VectorXd& row_sum_mass() const override { return solid_.row_sum_mass(); }
  void evolve(const NodalVectors&, double, NodalVectors&, const std::function<void()>&) override {}
  void commit() override {}
  const std::vector<double>& memory() const override { return solid_.memory(); }
  void set_memory(std::vector<double>) override {}
  structure::ExactSum strain_energy_sum(const NodalVectors& u) const override {
    return solid_.strain_energy_sum(u);
  }
  int element_count() const override { return solid_.element_count(); }
  int padded_functions(int element) const override { return solid_.padded_functions(element); }
  void gather(int, const NodalVectors&, double*) const override { ADD_FAILURE(); }
  void element_force(int, const double*, double*) const override { ADD_FAILURE(); }
  const double* element_mass(int element) const override { return solid_.element_mass(element); }
  double smallest_volume_ratio(int, const double*) const override { return 1.0; }
  std::string describe_element(int element) const override { return solid_.describe_element(element); }

 private:
  const Solid& solid_;
  mutable int evaluations_ = 0;
};

TEST(StableTimeStep, TakesTwentyEvaluationsAndNoElement) {
  const Solid solid(models::block({4, 4, 4}, {4, 4, 4}, 2), models::elastic());
  const CountingSolid counting(solid);
  structure::stable_time_step(counting, LumpedMass(solid.row_sum_mass()), {},
                              NodalVectors::Zero(3, solid.node_count()));
  EXPECT_EQ(counting.evaluations(), 20);
}

// PHYSICS C7.  A bar: nu = 0, the sides held, one linear element across; the section is so wide that its
// shear modes (1e-4 of the eigenvalue) do not matter.
TEST(StableTimeStep, OfALumpedBarIsTheKnownOneDimensionalValue) {
  const double expected[] = {1.0, 0.86206, 0.65274};  // times h/c, p = 1, 2, 3
  for (int degree : {1, 2, 3}) {
    const int elements = 6;
    const Solid solid(models::block({1.0 * elements, 100, 100}, {elements, 1, 1}, {degree, 1, 1}),
                      models::elastic(1.0, 0.0, 1.0));
    Supports supports;
    fix(supports, solid, {Face::eta_minus, Face::zeta_minus}, {false, true, true});
    fix(supports, solid, {Face::eta_plus, Face::zeta_plus}, {false, true, true});
    EXPECT_NEAR(stable_step(solid, supports), expected[degree - 1], 1e-3) << "degree " << degree;
  }
}

// PHYSICS C15: 4 x 4 x 4 quadratic unit cubes, free.
TEST(StableTimeStep, OfAFreeBlockIsThatOfAnIndependentCode) {
  const Solid solid(models::block({4, 4, 4}, {4, 4, 4}, 2), models::elastic());
  const double ratio = stable_step(solid, {}) / 0.6454;
  EXPECT_LT(ratio, 1.0);
  EXPECT_GT(ratio, 0.975);
}

// PHYSICS A8: the plate of Table 2 in Gao & Feng (2019).
TEST(StableTimeStep, OfThePapersPlateIsThatOfAnIndependentCode) {
  const Solid solid(models::block({0.610, 0.610, 0.0501}, {31, 31, 8}, 2),
                    models::elastic(210.6e9, 0.286, 7850));
  Supports supports;
  fix(supports, solid, {Face::xi_minus, Face::xi_plus, Face::eta_minus, Face::eta_plus}, {true, true, true});
  const double ratio = stable_step(solid, supports) / 9.19e-7;
  EXPECT_LT(ratio, 1.0);
  EXPECT_GT(ratio, 0.965);
}

TEST(StableTimeStep, IsInfiniteWhenNothingCanMove) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 1), models::elastic());
  Supports supports;
  fix(supports, solid, {Face::xi_minus, Face::xi_plus}, {true, true, true});
  EXPECT_EQ(stable_step(solid, supports), std::numeric_limits<double>::infinity());
}

TEST(StableTimeStep, RefusesTheMassesOfAnotherBody) {
  const Solid solid(models::block({2, 2, 1}, {2, 2, 1}, 2), models::elastic());
  const NodalVectors at_rest = NodalVectors::Zero(3, solid.node_count());
  for (double factor : {0.01, 100.0})
    EXPECT_THROW(structure::stable_time_step(solid, LumpedMass(factor * solid.row_sum_mass()), {}, at_rest),
                 std::logic_error);
}

/// Its stress is no gradient: it turns with the strain.
class Turning final : public structure::IsotropicElastic {
 public:
  Turning() : IsotropicElastic("Turning", 1.0, 0.3, 1.0) {}
  const char* law() const override { return "turning"; }
  models::Matrix3 stress(const models::Matrix3& H, const double*) const override {
    models::Matrix3 P = hooke(0.5 * (H + H.transpose()));
    P(0, 0) += H(1, 1);
    return P;
  }
  double energy_density(const models::Matrix3&, const double*) const override { return 0.0; }
};

TEST(StableTimeStep, RefusesAForceThatIsNoGradient) {
  const Solid solid(models::block({2, 2, 1}, {2, 2, 1}, 2), std::make_shared<Turning>());
  EXPECT_THAT([&] { stable_step(solid, {}); },
              testing::ThrowsMessage<std::logic_error>(HasSubstr("not the gradient of an energy")));
}

// Eigenvalues of matrices that are not finite would be sought for ever.
TEST(StableTimeStep, RefusesNumbersThatAreNotFinite) {
  const auto message = [](const Solid& solid, const NodalVectors& u) -> std::string {
    try {
      structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), {}, u);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  const Solid solid(models::block({1, 1, 1}, {2, 1, 1}, 2), models::elastic());
  NodalVectors u = NodalVectors::Zero(3, solid.node_count());
  for (double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    u(1, 5) = value;
    EXPECT_THAT(message(solid, u), HasSubstr("displacements that are not finite"));
  }
  u.setZero();
  // Numbers that may be given, but whose quotient is not one: too large, and too small.
  const Solid stiff(models::block({1e-60, 1e-60, 1e-60}, {2, 1, 1}, 2), models::elastic(1e100, 0.3, 1e-100));
  EXPECT_THAT(message(stiff, u), AllOf(HasSubstr("no finite number"), HasSubstr("Young's modulus 1e+100"),
                                       HasSubstr("density 1e-100"), HasSubstr("about 7.94e-61")));
  const Solid soft(models::block({1e70, 1e70, 1e70}, {2, 1, 1}, 2), models::elastic(1e-100, 0.3, 1e90));
  EXPECT_THAT(message(soft, u),
              AllOf(HasSubstr("no finite number > 0"), HasSubstr("Young's modulus 1e-100")));
}

/// Largest |eigenvalue| of the map (u(n), v(n-1/2)) -> (u(n+1), v(n+1/2)) with a(n) = -omega^2 (u(n) + lead
/// v(n-1/2)).
double spectral_radius(double omega, double lead, double dt) {
  Eigen::Matrix2d kick, drift;
  kick << 1.0, 0.0, -dt * omega * omega, 1.0 - dt * omega * omega * lead;
  drift << 1.0, dt, 0.0, 1.0;
  return Eigen::EigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(drift * kick), false)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

// Whoever gives back what was told gets no error.
TEST(StableTimeStep, IsToldRoundedDown) {
  EXPECT_EQ(structure::step_text(1.234567891), "1.23456");
  EXPECT_EQ(structure::step_text(0.99999999), "0.999999");
  EXPECT_EQ(structure::step_text(2.5e-7), "2.5e-07");
  EXPECT_EQ(structure::step_text(std::numeric_limits<double>::infinity()), "inf");
  for (double stable = 1e-9; stable < 1e9; stable *= 1.0123456789) {
    const double told = std::stod(structure::step_text(stable));
    EXPECT_LE(told, stable);
    EXPECT_GT(told, (1.0 - 1.1e-5) * stable);
  }
}

TEST(StableTimeStep, OfADampedBodyEndsWhereItsAmplificationMatrixDoes) {
  for (const double omega : {0.5, 3.0})
    for (const double ratio : {0.0, 0.001, 0.02, 0.3, 2.0}) {
      const double lead = 2.0 * ratio / omega, stable = 2.0 / omega,
                   damped = structure::damped_stable_step(stable, lead);
      EXPECT_NEAR(omega * damped, 2.0 * (std::sqrt(1.0 + ratio * ratio) - ratio), 1e-12);
      EXPECT_NEAR(structure::undamped_step(damped, lead), stable, 1e-12 * stable);
      EXPECT_LT(spectral_radius(omega, lead, (1.0 - 1e-6) * damped), 1.0 + 1e-12) << ratio;
      EXPECT_GT(spectral_radius(omega, lead, (1.0 + 1e-6) * damped), 1.0 + 1e-7) << ratio;
    }
}

}  // namespace
