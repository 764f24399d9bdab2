// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_nurbs_checks.h"

#include <fmt/format.h>
#include <mpi.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "fix_property_global.h"
#include "modify.h"
#include "update.h"

namespace liggghts_pkg {

namespace {

void check_property(LAMMPS_NS::Modify& modify, const char* property, int wall_type, double model_value,
                    const std::string& file) {
  LAMMPS_NS::Fix* fix =
      modify.find_fix_property(property, "property/global", "peratomtype", 0, 0, "wall/nurbs", false);
  if (!fix) return;  // the contact model does not use it
  const double deck_value = static_cast<LAMMPS_NS::FixPropertyGlobal*>(fix)->get_values()[wall_type - 1];
  if (std::abs(deck_value - model_value) > 1e-6 * std::abs(model_value))
    throw std::invalid_argument(fmt::format(
        "{} of atom type {} is {:.10g} in the deck but {:.10g} in '{}'; make them equal, or write 'material "
        "independent' to keep both",
        property, wall_type, deck_value, model_value, file));
}

}  // namespace

void check_run_style(const LAMMPS_NS::Update& update) {
  constexpr int kMinimize = 2;
  if (update.whichflag == kMinimize) throw std::invalid_argument("minimize is not supported; use run");
  if (std::strstr(update.integrate_style, "respa"))
    throw std::invalid_argument("run_style respa is not supported; use run_style verlet");
}

void check_wall_material(LAMMPS_NS::Modify& modify, int wall_type,
                         const std::optional<coupling::SurfaceMaterial>& material, const std::string& file) {
  if (!material) return;
  check_property(modify, "youngsModulus", wall_type, material->youngs_modulus, file);
  check_property(modify, "poissonsRatio", wall_type, material->poissons_ratio, file);
}

}  // namespace liggghts_pkg
