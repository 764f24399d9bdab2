// SPDX-License-Identifier: GPL-2.0-or-later
// The constants of an isotropic material in a flat plate (plate_shear.h).
#pragma once

#include <vector>

#include "structure/material/isotropic_elastic.h"

namespace structure {

class PlateElastic : public IsotropicElastic {
 public:
  std::vector<double> further_constants() const final;

 protected:
  /// As IsotropicElastic; `normal` of the undeformed plate, of any length but 0.
  PlateElastic(const char* law, double youngs_modulus, double poissons_ratio, double density,
               const Eigen::Vector3d& normal);

  template <class Law>
  Law point_law() const {
    return {lambda(), mu(), shear_factor(), {normal_[0], normal_[1], normal_[2]}};
  }

 private:
  double shear_factor() const;

  Eigen::Vector3d normal_;
};

}  // namespace structure
