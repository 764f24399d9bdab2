// SPDX-License-Identifier: GPL-2.0-or-later
#include "hertz_constants.h"

#include <cmath>

#include "atom.h"
#include "contact_laws.h"
#include "fix_property_global.h"
#include "force.h"
#include "model_words.h"
#include "modify.h"

namespace liggghts_pkg {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// zeta of a coefficient of restitution e, as LIGGGHTS has it.
double damping_ratio(double e) { return -std::log(e) / std::hypot(std::log(e), kPi); }

}  // namespace

void HertzConstants::read(LAMMPS_NS::LAMMPS* lmp, const std::string& normal_model) {
  if (!is_hertzian(normal_model)) return;
  const auto property = [&](const char* name, const char* shape) {
    return static_cast<LAMMPS_NS::FixPropertyGlobal*>(
        lmp->modify->find_fix_property(name, "property/global", shape, 0, 0, "fix wall/nurbs"));
  };
  auto *const E = property("youngsModulus", "peratomtype"), *const nu =
                                                                property("poissonsRatio", "peratomtype");
  const LawProperty& factor = HertzLaw::properties[0];
  auto* const lambda = normal_model == HertzLaw::word ? property(factor.name, "peratomtypepair") : nullptr;
  auto* const restitution = property("coefficientRestitution", "peratomtypepair");
  types_ = lmp->atom->ntypes;
  values_.clear();
  const auto of_both = [&](int i, int j, auto of_one) { return 1.0 / (of_one(i) + of_one(j)); };
  const auto plane = [&](int type) {
    const double ratio = nu->compute_vector(type);
    return (1.0 - ratio * ratio) / E->compute_vector(type);
  };
  const auto shear = [&](int type) {
    const double ratio = nu->compute_vector(type);
    return 2.0 * (2.0 - ratio) * (1.0 + ratio) / E->compute_vector(type);
  };
  for (int i = 0; i < types_; ++i)
    for (int j = 0; j < types_; ++j) {
      const double E_star = of_both(i, j, plane) * (lambda ? lambda->compute_array(i, j) : 1.0),
                   zeta = damping_ratio(restitution->compute_array(i, j));
      values_.push_back({4.0 / 3.0 * E_star / lmp->force->nktv2p,
                         2.0 * HertzLaw::damping_factor * zeta * std::sqrt(2.0 * E_star),
                         8.0 * of_both(i, j, shear) / lmp->force->nktv2p});
    }
}

}  // namespace liggghts_pkg
