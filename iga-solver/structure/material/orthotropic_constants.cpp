// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/orthotropic_constants.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

#include "structure/material/orthotropic_elastic.h"

namespace structure {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kFirst[3] = {0, 0, 1}, kSecond[3] = {1, 2, 2};  // of nu_12, nu_13, nu_23

/// Written so that NaN is refused, too.
void require(bool valid, const char* law, const std::string& problem) {
  if (!valid) throw std::invalid_argument(fmt::format("{}: {}", law, problem));
}

void require_positive(const char* law, const char* name, double value) {
  require(value > 0.0 && std::isfinite(value), law,
          fmt::format("{} is {}, expected a number > 0", name, value));
}

void check(const char* law, const OrthotropicConstants& c) {
  constexpr const char* kE[] = {"E_1", "E_2", "E_3"};
  constexpr const char* kG[] = {"G_12", "G_13", "G_23"};
  for (int i = 0; i < 3; ++i) require_positive(law, kE[i], c.E[i]);
  for (int i = 0; i < 3; ++i) require_positive(law, kG[i], c.G[i]);
  require_positive(law, "density", c.density);
  double product = 2.0 * c.nu[0] * c.nu[1] * c.nu[2] * c.E[2] / c.E[0], determinant = 1.0;
  for (int k = 0; k < 3; ++k) {
    const int i = kFirst[k], j = kSecond[k];
    const double limit = std::sqrt(c.E[i] / c.E[j]);
    require(std::abs(c.nu[k]) < limit, law,
            fmt::format("nu_{0}{1} is {2}, expected less than sqrt(E_{0} / E_{1}) = {3:.6g} in size, else "
                        "straining gives energy",
                        i + 1, j + 1, c.nu[k], limit));
    determinant -= c.nu[k] * c.nu[k] * c.E[j] / c.E[i];
  }
  determinant -= product;
  require(determinant > 0.0, law,
          fmt::format("1 - nu_12 nu_21 - nu_13 nu_31 - nu_23 nu_32 - 2 nu_21 nu_32 nu_13 is {:.6g}, expected "
                      "a number > 0 (nu_ji = nu_ij E_j / E_i), else straining gives energy",
                      determinant));
}

/// Columns are the axes 1, 2, 3.
Matrix3 axes(const char* law, const OrthotropicConstants& c) {
  constexpr double kParallel = 1e-6;  // sine of the angle
  const Eigen::Vector3d first = c.direction_1.normalized();
  const Eigen::Vector3d third = first.cross(c.direction_2.normalized());
  require(third.norm() > kParallel, law,
          "direction_1 and direction_2 are parallel or 0, expected two that span a plane");
  Matrix3 R;
  R << first, third.normalized().cross(first), third.normalized();
  return R;
}

/// In the axes of the material, of strains with twice the shears.
Matrix6 compliance(const OrthotropicConstants& c) {
  Matrix6 S = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) S(i, i) = 1.0 / c.E[i];
  for (int k = 0; k < 3; ++k) S(kFirst[k], kSecond[k]) = S(kSecond[k], kFirst[k]) = -c.nu[k] / c.E[kFirst[k]];
  S(3, 3) = 1.0 / c.G[0];
  S(4, 4) = 1.0 / c.G[2];
  S(5, 5) = 1.0 / c.G[1];
  return S;
}

/// Strains in the axes R of those in space, both with twice the shears.
Matrix6 strain_rotation(const Matrix3& R) {
  using Law = OrthotropicElasticLaw;
  Matrix6 T;
  for (int b = 0; b < 6; ++b) {
    Matrix3 e = Matrix3::Zero();
    e(Law::kRow[b], Law::kColumn[b]) = e(Law::kColumn[b], Law::kRow[b]) = b < 3 ? 1.0 : 0.5;
    const Matrix3 turned = R.transpose() * e * R;
    for (int a = 0; a < 6; ++a) T(a, b) = (a < 3 ? 1.0 : 2.0) * turned(Law::kRow[a], Law::kColumn[a]);
  }
  return T;
}

}  // namespace

OrthotropicElastic::OrthotropicElastic(const char* law, const OrthotropicConstants& constants)
    : constants_(constants) {
  check(law, constants);
  const Matrix6 stiffness = compliance(constants).inverse(), T = strain_rotation(axes(law, constants));
  stiffness_ = T.transpose() * stiffness * T;
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
  find_means(stiffness);
}

void OrthotropicElastic::find_means(const Matrix6& C) {
  const Matrix6 S = compliance(constants_);
  const auto normal = [](const Matrix6& M) { return M(0, 0) + M(1, 1) + M(2, 2); };
  const auto mixed = [](const Matrix6& M) { return M(0, 1) + M(0, 2) + M(1, 2); };
  const auto shear = [](const Matrix6& M) { return M(3, 3) + M(4, 4) + M(5, 5); };
  const double K_voigt = (normal(C) + 2.0 * mixed(C)) / 9.0, K_reuss = 1.0 / (normal(S) + 2.0 * mixed(S));
  const double G_voigt = (normal(C) - mixed(C) + 3.0 * shear(C)) / 15.0,
               G_reuss = 15.0 / (4.0 * (normal(S) - mixed(S)) + 3.0 * shear(S));
  const double K = 0.5 * (K_voigt + K_reuss), G = 0.5 * (G_voigt + G_reuss);
  mean_E_ = 9.0 * K * G / (3.0 * K + G);
  mean_nu_ = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
}

std::vector<double> OrthotropicElastic::further_constants() const {
  const OrthotropicConstants& c = constants_;
  std::vector<double> all;
  for (const auto* values : {&c.E, &c.nu, &c.G}) all.insert(all.end(), values->begin(), values->end());
  for (const auto* direction : {&c.direction_1, &c.direction_2})
    all.insert(all.end(), direction->begin(), direction->end());
  return all;
}

}  // namespace structure
