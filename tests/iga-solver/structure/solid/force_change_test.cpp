// SPDX-License-Identifier: GPL-2.0-or-later
// K(u) w, of points, bodies and all ways to integrate.
#include <gtest/gtest.h>

#include "models.h"
#include "standard_linear_solid.h"

namespace {

using models::NodalVectors;
using structure::IntegrationMethod;
using structure::Matrix3;
using structure::Solid;

// Of fourth order in the step: 1e-12 of round-off, 1e-12 of truncation.
template <class Value, class Function>
Value difference(const Function& f, const Value& at, const Value& along) {
  const double h = 1e-3;
  return (8.0 * (f(at + h * along) - f(at - h * along)) - (f(at + 2 * h * along) - f(at - 2 * h * along))) /
         (12.0 * h);
}

std::vector<std::shared_ptr<const structure::Material>> all_laws() {
  std::vector<std::shared_ptr<const structure::Material>> laws = models::large_strain_laws();
  laws.push_back(models::elastic());
  return laws;
}

TEST(StressChange, IsTheDerivativeOfTheStress) {
  const Matrix3 G = (Matrix3() << 0.3, -0.8, 0.1, 0.5, 0.9, -0.2, -0.7, 0.4, 0.6).finished();
  for (const auto& law : all_laws())
    for (const double size : {0.0, 1e-3, 0.3, 1.0}) {  // neo-Hooke's series and its logarithm
      const Matrix3 H = size * models::some_gradient();
      const Matrix3 dP = difference<Matrix3>([&](const Matrix3& A) { return law->stress(A, nullptr); }, H, G);
      EXPECT_LT((law->stress_change(H, G, nullptr) - dP).norm(), 1e-10 * dP.norm()) << law->law() << size;
    }
}

TEST(StressChange, OfALawThatDoesNotKnowItIsFoundByDifferences) {
  const test::StandardLinearSolid law(1.0, 0.3, 1.0, 0.4, 1.0);
  const std::vector<double> state(law.state_size(), 0.01);
  const Matrix3 H = 0.1 * models::some_gradient(), G = models::some_gradient().transpose();
  const Matrix3 dP = difference<Matrix3>([&](const Matrix3& A) { return law.stress(A, state.data()); }, H, G);
  EXPECT_LT((law.stress_change(H, G, state.data()) - dP).norm(), 1e-9 * dP.norm());
}

// Affine along the axes, affine, distorted, rational: all that sweeps know of geometry.
std::vector<nurbs::Volume> patches() {
  nurbs::Volume sheared = models::block({3, 2, 1}, {4, 3, 2}, 2);
  sheared.control_points =
      Matrix3(Matrix3::Identity() + 0.2 * models::some_gradient()) * sheared.control_points;
  return {models::block({3, 2, 1}, {3, 3, 2}, {2, 3, 2}), sheared,
          models::distorted(models::block({3, 2, 1}, {3, 2, 2}, 3), 0.02), models::quarter_ring(2, 3)};
}

TEST(ForceChange, IsTheDerivativeOfTheForce) {
  for (const nurbs::Volume& patch : patches())
    for (const auto& law : all_laws()) {
      const Solid solid(patch, law);
      const NodalVectors u = 0.02 * models::random_vectors(solid.node_count(), 1),
                         w = 0.1 * models::random_vectors(solid.node_count(), 2);
      const NodalVectors expected = difference<NodalVectors>(
          [&](const NodalVectors& at) {
            NodalVectors f(3, at.cols());
            solid.internal_force(at, f);
            return f;
          },
          u, w);
      NodalVectors f(3, u.cols());
      solid.internal_force_change(u, w, f);
      EXPECT_LT((f - expected).norm(), 1e-9 * expected.norm()) << law->law();
      NodalVectors by_differences(3, u.cols());
      solid.Body::internal_force_change(u, w, by_differences);
      EXPECT_LT((by_differences - expected).norm(), 1e-8 * expected.norm()) << law->law();
    }
}

TEST(ForceChange, OfSweepsIsThatOfThePlainLoop) {
  for (const nurbs::Volume& patch : patches())
    for (const auto& law : all_laws()) {
      const Solid plain(patch, law, {structure::Quadrature::full, IntegrationMethod::elements});
      const NodalVectors u = 0.02 * models::random_vectors(plain.node_count(), 1),
                         w = models::random_vectors(plain.node_count(), 2);
      NodalVectors expected(3, u.cols()), f(3, u.cols());
      plain.internal_force_change(u, w, expected);
      for (const IntegrationMethod method :
           {IntegrationMethod::automatic, IntegrationMethod::stored, IntegrationMethod::recomputed}) {
        Solid(patch, law, {structure::Quadrature::full, method}).internal_force_change(u, w, f);
        EXPECT_LT((f - expected).norm(), 1e-12 * expected.norm()) << law->law() << name(method);
      }
    }
}

TEST(ForceChange, OfALawOutsideTheKernelsSeesItsMemory) {
  const auto law = std::make_shared<const test::StandardLinearSolid>(1.0, 0.3, 1.0, 0.4, 1.0);
  const nurbs::Volume patch = models::distorted(models::block({3, 2, 1}, {3, 2, 2}, 2), 0.02);
  Solid plain(patch, law, {structure::Quadrature::full, IntegrationMethod::elements}), swept(patch, law);
  const NodalVectors u = 0.02 * models::random_vectors(plain.node_count(), 1),
                     w = models::random_vectors(plain.node_count(), 2);
  std::vector<double> memory(plain.memory().size());
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = 1e-3 * double(i % 17);
  NodalVectors expected(3, u.cols()), f(3, u.cols());
  for (Solid* solid : {&plain, &swept}) solid->set_memory(memory);
  plain.internal_force_change(u, w, expected);
  swept.internal_force_change(u, w, f);
  EXPECT_LT((f - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace
