// SPDX-License-Identifier: GPL-2.0-or-later
// Plates of a single quadratic element through the thickness: which patches are some, and how they shear.
#include "structure/solid/plate_patch.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "models.h"
#include "nurbs/boundary.h"
#include "nurbs/gauss_legendre.h"
#include "structure/analysis/modes.h"
#include "structure/analysis/static_equilibrium.h"
#include "structure/material/plate_material.h"

namespace {

using models::Matrix3;
using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using nurbs::Volume;
using structure::Solid;
using structure::Supports;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kE = 1.0, kNu = 0.3, kDensity = 1.0;
const double kMu = kE / (2.0 * (1.0 + kNu));

TEST(PlatePatch, IsOneQuadraticElementThickInJustOneDirection) {
  const auto of = [](const std::array<int, 3>& elements, const std::array<int, 3>& degrees) {
    return structure::thickness_direction(models::block({1, 1, 1}, elements, degrees).space);
  };
  EXPECT_EQ(of({4, 3, 1}, {2, 2, 2}), 2);
  EXPECT_EQ(of({4, 1, 3}, {3, 2, 3}), 1);
  EXPECT_EQ(of({1, 2, 2}, {2, 3, 2}), 0);
  EXPECT_EQ(of({1, 4, 1}, {3, 2, 2}), 2);
  EXPECT_EQ(of({4, 4, 2}, {2, 2, 2}), -1);
  EXPECT_EQ(of({4, 4, 1}, {2, 2, 3}), -1);
  EXPECT_EQ(of({4, 1, 1}, {2, 2, 2}), -1);
}

// Of any outline, wherever it stands.
TEST(PlatePatch, HasANormalIfItIsFlat) {
  const Matrix3 Q = Eigen::AngleAxisd(2.0, Vector3(1, -2, 3).normalized()).toRotationMatrix();
  for (int d = 0; d < 3; ++d) {
    Vector3 size(1, 1.2, 0.9);
    size[d] = 0.1;
    std::array<int, 3> elements{4, 3, 2};
    elements[d] = 1;
    Volume plate = models::block(size, elements, 2);
    const int u = (d + 1) % 3, v = (d + 2) % 3;
    for (Eigen::Index a = 0; a < plate.control_points.cols(); ++a) {
      Vector3 X = plate.control_points.col(a);
      plate.control_points(u, a) += 0.2 * X[v] * X[v] + X[d];  // with slanting sides
    }
    plate.control_points = (Q * plate.control_points).colwise() + Vector3(3, 4, 5);
    EXPECT_LT((structure::plate_normal(plate, d) - Q.col(d)).norm(), 1e-13) << d;
    EXPECT_LT((structure::layer_normal(plate, d, {0.2, 0.7, 0.4}) - Q.col(d)).norm(), 1e-13) << d;
  }
}

TEST(PlatePatch, HasNoneIfItIsNotFlat) {
  const Volume flat = models::block({1, 1, 0.1}, {3, 3, 1}, 2);
  const auto message_of = [&](auto height) {
    return [=] {
      Volume plate = flat;
      for (Eigen::Index a = 0; a < plate.control_points.cols(); ++a)
        plate.control_points(2, a) = height(Vector3(flat.control_points.col(a)));
      structure::plate_normal(plate, 2);
    };
  };
  EXPECT_NO_THROW(message_of([](const Vector3& X) { return X[2]; })());
  EXPECT_THAT(message_of([](const Vector3& X) { return X[2] * (1.0 + 0.1 * X[0]); }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("no flat plate")));
  EXPECT_THAT(message_of([](const Vector3& X) { return X[2] + 0.1 * X[0] * X[0]; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("no flat plate")));
  EXPECT_THAT(message_of([](const Vector3& X) { return X[2] * (0.6 + 4.0 * X[2]); }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("middle layer of control points at 0.4")));
}

/// Half a wave along x of a plate of thickness 1 between walls without friction, strained in its plane alone.
class HalfWave {
 public:
  /// A single quadratic layer of elements half as long as it is thick.
  HalfWave(double wavenumber, bool is_corrected)
      : k_(wavenumber),
        plate_(models::block({M_PI / k_, kWidth, 1.0}, {elements(), 1, 1}, {2, 1, 2}), law(is_corrected)) {
    const nurbs::Space<3>& space = plate_.space();
    supports_.fix(structure::nodes_on(space, {Face::xi_minus}), {true, false, false});
    supports_.fix(structure::nodes_on(space, {Face::xi_plus}), {true, false, false});
    std::vector<int> all(space.control_point_count());
    std::iota(all.begin(), all.end(), 0);
    supports_.fix(all, {false, true, false});
  }

  /// Of free waves, with the consistent mass.
  double phase_speed() const {
    structure::ModeOptions options;
    options.count = 2;  // the first is a motion along z
    options.mass = structure::MassKind::consistent;
    return std::sqrt(structure::lowest_modes(plate_, supports_, at_rest(), options)[1].eigenvalue) / k_;
  }

  /// Of the side with the traction cos(k x), which balances itself.
  double amplitude_at_rest() const {
    Supports supports = supports_;
    supports.fix({plate_.space().control_point_count() / 2}, {false, false, true});
    const NodalVectors load = cosine_load();
    structure::StaticEquilibrium equilibrium(plate_, supports, load);
    equilibrium.solve();
    return load.cwiseProduct(equilibrium.displacements()).sum() / (0.5 * kWidth * M_PI / k_);
  }

 private:
  static constexpr double kWidth = 0.5;
  static std::shared_ptr<const structure::Material> law(bool is_corrected) {
    const auto law = models::elastic(kE, kNu, kDensity);
    return is_corrected ? structure::with_plate_shear(*law, Vector3::UnitZ()) : law;
  }
  int elements() const { return static_cast<int>(std::ceil(2.0 * M_PI / k_)); }
  NodalVectors at_rest() const { return NodalVectors::Zero(3, plate_.node_count()); }
  NodalVectors cosine_load() const {
    const auto top = nurbs::boundary_surface(plate_.space(), Face::zeta_plus);
    NodalVectors load = at_rest();
    const nurbs::QuadratureRule rule = nurbs::gauss_legendre(5);
    for (int e = 0; e < elements(); ++e)
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const double xi = (e + 0.5 + 0.5 * rule.points[q]) / elements();
        nurbs::RationalBasis<2> basis;
        nurbs::evaluate(top.space, {xi, 0.5}, 0, basis);
        const double share = 0.5 * rule.weights[q] / elements() * kWidth * M_PI / k_;
        for (int a = 0; a < basis.count; ++a)
          load(2, top.volume_control_point[basis.control_point[a]]) +=
              share * basis.R[a] * std::cos(M_PI * xi);
      }
    return load;
  }

  double k_;
  Solid plate_;
  Supports supports_;
};

/// By bisection.  Source: Rayleigh (1888), Lamb (1917): tanh(q h)/tanh(p h) = (q^2 + k^2)^2/(4 k^2 p q), h =
/// 1/2.
double speed_of_flexural_wave(double k) {
  const double of_shear = kMu / kDensity, of_pressure = of_shear * 2.0 * (1.0 - kNu) / (1.0 - 2.0 * kNu);
  double low = 0.0, high = std::sqrt(of_shear);
  for (int i = 0; i < 60; ++i) {
    const double c = 0.5 * (low + high), p = k * std::sqrt(1.0 - c * c / of_pressure),
                 q = k * std::sqrt(1.0 - c * c / of_shear), square = q * q + k * k;
    const bool is_above = std::tanh(0.5 * q) * 4.0 * k * k * p * q < std::tanh(0.5 * p) * square * square;
    (is_above ? high : low) = c;
  }
  return low;
}

/// Amplitude of the loaded side of an elastic layer of thickness 1 under cos(k x).
/// Source: Timoshenko & Goodier (1970), art. 24, as the sum of equal and of opposite loads on both sides.
double exact_amplitude(double k) {
  return (1.0 - kNu * kNu) / (kE * k) *
         ((std::cosh(k) + 1.0) / (std::sinh(k) - k) + (std::cosh(k) - 1.0) / (std::sinh(k) + k));
}

// Over the thickness T = 1.  A plain layer is off by (k T)^2/30 at rest, and by half of it in waves.
TEST(PlateShear, BendsAsAnElasticLayer) {
  for (const double k : {0.1, 0.25, 0.5, 1.0}) {
    const double at_rest = exact_amplitude(k), speed = speed_of_flexural_wave(k);
    const HalfWave corrected(k, true), plain(k, false);
    EXPECT_NEAR(corrected.amplitude_at_rest() / at_rest, 1.0, 4e-3 * k * k) << k;
    EXPECT_NEAR(corrected.phase_speed() / speed, 1.0, 3e-4 * k) << k;
    EXPECT_NEAR(plain.amplitude_at_rest() / at_rest - 1.0, -k * k / 30.0, 0.1 * k * k / 30.0) << k;
    EXPECT_GT(plain.phase_speed() / speed - 1.0, 0.7 * k * k / 60.0) << k;
  }
}

}  // namespace
