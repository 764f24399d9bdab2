// SPDX-License-Identifier: GPL-2.0-or-later
// The nine constants of an orthotropic material and its axes.
#pragma once

#include <array>

#include "structure/material/material.h"

namespace structure {

/// Axes 1, 2, 3 are orthogonal: 1 is `direction_1`, 2 is what `direction_2` has across it, 3 is their cross
/// product; lengths do not matter.  nu_ij = -strain along j over strain along i, under stress along i.
struct OrthotropicConstants {
  std::array<double, 3> E;   ///< E_1, E_2, E_3 [Pa]
  std::array<double, 3> nu;  ///< nu_12, nu_13, nu_23 [-]
  std::array<double, 3> G;   ///< G_12, G_13, G_23 [Pa]
  double density;            ///< [kg/m^3]
  Eigen::Vector3d direction_1 = Eigen::Vector3d::UnitX(), direction_2 = Eigen::Vector3d::UnitY();
};

class OrthotropicElastic : public Material {
 public:
  double density() const final { return constants_.density; }
  /// Of the isotropic material that is the mean of Voigt's and Reuss' (Hill 1952, Proc. Phys. Soc. A 65,
  /// 349): for comparisons alone.
  double youngs_modulus() const final { return mean_E_; }
  double poissons_ratio() const final { return mean_nu_; }
  std::vector<double> further_constants() const final;

 protected:
  /// Throws std::invalid_argument, naming the law and the condition, unless the stored energy is positive:
  /// E, G > 0, |nu_ij| < sqrt(E_i / E_j) and
  /// 1 - nu_12 nu_21 - nu_13 nu_31 - nu_23 nu_32 - 2 nu_21 nu_32 nu_13 > 0 (Lempriere 1968, AIAA J. 6, 2226);
  /// unless density > 0 and unless the directions span a plane.
  OrthotropicElastic(const char* law, const OrthotropicConstants& constants);

  template <class Law>
  Law point_law() const {
    Law law{};
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) law.C[a][b] = stiffness_(a, b);
    return law;
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  void find_means(const Matrix6& stiffness);

  OrthotropicConstants constants_;
  Matrix6 stiffness_;  // in the axes of space, as OrthotropicElasticLaw::C
  double mean_E_, mean_nu_;
};

}  // namespace structure
