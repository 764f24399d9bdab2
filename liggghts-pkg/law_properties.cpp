// SPDX-License-Identifier: GPL-2.0-or-later
#include "law_properties.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "comm.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "update.h"

namespace liggghts_pkg {

namespace {

struct LengthUnit {
  const char* unit_style;  ///< of the deck's `units` command
  const char* name;
  double in_mm;
};
constexpr LengthUnit kLengthUnits[] = {
    {"si", "m", 1e3}, {"cgs", "cm", 10.0}, {"micro", "um", 1e-3}, {"nano", "nm", 1e-6}};

/// "m^(1/2)"; only whole and half powers occur.
std::string unit_power(const char* unit, double power) {
  return fmt::format("{}^({:.0f}/2)", unit, 2.0 * power);
}

/// "0.00174194 m^(1/2) = 0.055085 mm^(1/2)"
std::string with_units(double value, double power, const char* unit_style) {
  if (power == 0.0) return fmt::format("{:.6g}", value);
  for (const LengthUnit& unit : kLengthUnits)
    if (std::strcmp(unit.unit_style, unit_style) == 0)
      return fmt::format("{:.6g} {} = {:.6g} {}", value, unit_power(unit.name, power),
                         value * std::pow(unit.in_mm, power), unit_power("mm", power));
  return fmt::format("{:.6g} {}", value, unit_power("length", power));
}

/// What the deck must have: "fix ID all property/global penaltyFactor peratomtypepair 2 P_11 P_12 P_21 P_22".
std::string line_of_deck(const LawProperty& property, int max_type) {
  const bool per_type = property.per == LawProperty::Per::type;
  std::string line = fmt::format("fix ID all property/global {} {}", property.name,
                                 per_type ? "peratomtype" : fmt::format("peratomtypepair {}", max_type));
  for (int i = 1; i <= max_type; ++i)
    for (int j = 1; j <= (per_type ? 1 : max_type); ++j)
      line += per_type ? fmt::format(" P_{}", i) : fmt::format(" P_{}{}", i, j);
  return line;
}

}  // namespace

void LawPropertyValues::read(PropertyRegistry& registry, const char* law) {
  max_type_ = registry.max_type();
  values_.assign((max_type_ + 1) * (max_type_ + 1) * properties_.size(), 0.0);
  for (std::size_t k = 0; k < properties_.size(); ++k) {
    read_one(registry, law, k);
    print_one(registry.getLAMMPS(), law, k);
  }
}

bool LawPropertyValues::have_lengths() const {
  return std::any_of(properties_.begin(), properties_.end(),
                     [](const LawProperty& property) { return property.length_power != 0.0; });
}

void LawPropertyValues::read_one(PropertyRegistry& registry, const char* law, std::size_t k) {
  const LawProperty& property = properties_[k];
  LAMMPS_NS::LAMMPS* const lmp = registry.getLAMMPS();
  const bool per_type = property.per == LawProperty::Per::type;
  const char* const shape = per_type ? "peratomtype" : "peratomtypepair";
  const std::string caller = fmt::format("model {}", law);
  if (!lmp->modify->find_fix_property(property.name, "property/global", shape, 0, 0, caller.c_str(), false))
    lmp->error->all(FLERR, fmt::format("{} needs {}, expected the line '{}' with numbers > 0", caller,
                                       property.name, line_of_deck(property, max_type_))
                               .c_str());

  FixPropertyGlobal* const given = registry.getGlobalProperty(
      property.name, "property/global", shape, max_type_, per_type ? 0 : max_type_, caller.c_str());
  for (int i = 1; i <= max_type_; ++i)
    for (int j = 1; j <= max_type_; ++j) {
      const double value = per_type ? std::min(given->compute_vector(i - 1), given->compute_vector(j - 1))
                                    : given->compute_array(i - 1, j - 1);
      if (!(value > 0.0))
        lmp->error->all(FLERR, fmt::format("{} of atom types {} and {} is {:g}, expected a number > 0 ({})",
                                           property.name, i, j, value, caller)
                                   .c_str());
      values_[(i * (max_type_ + 1) + j) * properties_.size() + k] = value;
    }
}

// In the deck's units, and in mm where there is a length: what a paper gives in one is easily typed in the
// other.  Says the same thing only once.
void LawPropertyValues::print_one(LAMMPS_NS::LAMMPS* lmp, const char* law, std::size_t k) const {
  const LawProperty& property = properties_[k];
  std::map<double, std::vector<std::string>> pairs_of;  // which pairs of types have this value
  for (int i = 1; i <= max_type_; ++i)
    for (int j = i; j <= max_type_; ++j) pairs_of[of_types(i, j)[k]].push_back(fmt::format("{}-{}", i, j));

  std::string line = fmt::format("Model {}: {}", law, property.name);
  for (const auto& [value, pairs] : pairs_of)
    line += fmt::format(" {} (types {});", with_units(value, property.length_power, lmp->update->unit_style),
                        fmt::join(pairs, " "));
  line.back() = '\n';

  static std::map<std::string, std::string> printed;
  std::string& last = printed[fmt::format("{} {}", law, property.name)];
  if (last == line) return;
  last = line;
  if (lmp->comm->me != 0) return;
  for (FILE* out : {lmp->screen, lmp->logfile})
    if (out) std::fputs(line.c_str(), out);
}

}  // namespace liggghts_pkg
