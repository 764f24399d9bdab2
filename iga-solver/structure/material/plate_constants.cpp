// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/plate_constants.h"

#include <fmt/format.h>

#include <stdexcept>

#include "structure/material/plate_shear.h"

namespace structure {

PlateElastic::PlateElastic(const char* law, double youngs_modulus, double poissons_ratio, double density,
                           const Eigen::Vector3d& normal)
    : IsotropicElastic(law, youngs_modulus, poissons_ratio, density), normal_(normal.normalized()) {
  if (!(normal.norm() > 0.0) || !normal.allFinite())
    throw std::invalid_argument(fmt::format("{}: the plate's normal is ({}, {}, {}), expected a direction",
                                            law, normal[0], normal[1], normal[2]));
}

std::vector<double> PlateElastic::further_constants() const {
  return {shear_factor(), normal_[0], normal_[1], normal_[2]};
}

double PlateElastic::shear_factor() const { return plate_shear_factor(poissons_ratio()); }

}  // namespace structure
