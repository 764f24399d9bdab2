// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/plate_material.h"

#include <fmt/format.h>

#include <stdexcept>

#include "structure/material/laws.h"
#include "structure/material/viscous.h"

namespace structure {

std::shared_ptr<const Material> with_plate_shear(const Material& material, const Eigen::Vector3d& normal) {
  const double E = material.youngs_modulus(), nu = material.poissons_ratio(), density = material.density();
  if (dynamic_cast<const LinearElastic*>(&material))
    return std::make_shared<ElasticMaterial<PlateShearLaw<LinearElasticLaw>>>(E, nu, density, normal);
  if (dynamic_cast<const SaintVenantKirchhoff*>(&material))
    return std::make_shared<ElasticMaterial<PlateShearLaw<SaintVenantKirchhoffLaw>>>(E, nu, density, normal);
  throw std::invalid_argument(fmt::format("has the law '{}', expected '{}' or '{}'", material.law(),
                                          LinearElasticLaw::kWord, SaintVenantKirchhoffLaw::kWord));
}

bool has_plate_shear(const Material& material) {
  const auto* const viscous = dynamic_cast<const Viscous*>(&material);
  return dynamic_cast<const PlateElastic*>(viscous ? viscous->elastic().get() : &material) != nullptr;
}

}  // namespace structure
