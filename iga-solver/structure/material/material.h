// SPDX-License-Identifier: GPL-2.0-or-later
// The material seam: displacement gradient -> first Piola-Kirchhoff stress.
#pragma once

#include <Eigen/Core>

namespace structure {

using Matrix3 = Eigen::Matrix3d;

class Material {
 public:
  virtual ~Material() = default;
  /// First Piola-Kirchhoff stress P [Pa] from the displacement gradient H = du/dX [-].
  virtual Matrix3 stress(const Matrix3& H) const = 0;
  /// Stored energy per reference volume [J/m^3]; stress is its derivative with respect to H.
  virtual double energy_density(const Matrix3& H) const = 0;

  virtual const char* law() const = 0;        ///< its word in model files
  virtual double density() const = 0;         ///< reference mass density [kg/m^3]
  virtual double youngs_modulus() const = 0;  ///< small-strain value [Pa], compared with the deck's
  virtual double poissons_ratio() const = 0;  ///< small-strain value [-]
};

}  // namespace structure
