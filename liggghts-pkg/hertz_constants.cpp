// SPDX-License-Identifier: GPL-2.0-or-later
#include "hertz_constants.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "atom.h"
#include "contact_laws.h"
#include "fix_property_global.h"
#include "force.h"
#include "model_words.h"
#include "modify.h"

namespace liggghts_pkg {

void HertzConstants::read(LAMMPS_NS::LAMMPS* lmp, const std::string& normal_model, int wall_type,
                          bool corrected) {
  if (!is_hertzian(normal_model)) return;
  const auto property = [&](const char* name, const char* shape) {
    return static_cast<LAMMPS_NS::FixPropertyGlobal*>(
        lmp->modify->find_fix_property(name, "property/global", shape, 0, 0, "fix wall/nurbs"));
  };
  auto *const E = property("youngsModulus", "peratomtype"), *const nu =
                                                                property("poissonsRatio", "peratomtype");
  const LawProperty& factor = HertzLaw::properties[0];
  auto* const lambda = normal_model == HertzLaw::word ? property(factor.name, "peratomtypepair") : nullptr;
  types_ = lmp->atom->ntypes;
  auto* const restitution = corrected ? property("coefficientRestitution", "peratomtypepair") : nullptr;
  for (int i = 0; restitution && i < types_; ++i)
    if (const double e = restitution->compute_array(i, wall_type - 1); e < kLeastRestitution)
      throw std::invalid_argument(fmt::format(
          "'compliance corrected' is for contacts that lose little, given coefficientRestitution {:g} "
          "of atom types {} and {}, expected {:g} or more, or 'compliance none'",
          e, i + 1, wall_type, kLeastRestitution));
  values_.assign(types_ * types_, 0.0);
  const auto compliance = [&](int type) {
    const double ratio = nu->compute_vector(type);
    return (1.0 - ratio * ratio) / E->compute_vector(type);
  };
  for (int i = 0; i < types_; ++i)
    for (int j = 0; j < types_; ++j)
      values_[i * types_ + j] = 4.0 / 3.0 / (compliance(i) + compliance(j)) *
                                (lambda ? lambda->compute_array(i, j) : 1.0) / lmp->force->nktv2p;
}

double HertzConstants::of_types(int i, int j) const {
  if (values_.empty()) return std::numeric_limits<double>::quiet_NaN();
  return values_[(i - 1) * types_ + (j - 1)];
}

}  // namespace liggghts_pkg
