// SPDX-License-Identifier: GPL-2.0-or-later
#include "penalty_factor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
std::string with_units(double lambda, double power, const char* unit_style) {
  if (power == 0.0) return fmt::format("{:.6g}", lambda);
  for (const LengthUnit& unit : kLengthUnits)
    if (std::strcmp(unit.unit_style, unit_style) == 0)
      return fmt::format("{:.6g} {} = {:.6g} {}", lambda, unit_power(unit.name, power),
                         lambda * std::pow(unit.in_mm, power), unit_power("mm", power));
  return fmt::format("{:.6g} {}", lambda, unit_power("length", power));
}

}  // namespace

MatrixProperty* create_penalty_factor(PropertyRegistry& registry, const char* caller, bool) {
  MatrixProperty* lambda = MODEL_PARAMS::createPerTypePairProperty(registry, "penaltyFactor", caller);
  for (int i = 1; i <= registry.max_type(); ++i)
    for (int j = 1; j <= registry.max_type(); ++j)
      if (!(lambda->data[i][j] > 0.0))
        registry.getLAMMPS()->error->all(
            FLERR, fmt::format("penaltyFactor of atom types {} and {} is {:g}, expected a number > 0 ({})", i,
                               j, lambda->data[i][j], caller)
                       .c_str());
  return lambda;
}

void print_penalty_factor(LAMMPS_NS::LAMMPS* lmp, const char* law, double exponent, double** factor) {
  std::map<double, std::vector<std::string>> pairs_of;  // which pairs of types have this lambda
  for (int i = 1; i <= lmp->force->registry.max_type(); ++i)
    for (int j = i; j <= lmp->force->registry.max_type(); ++j)
      pairs_of[factor[i][j]].push_back(fmt::format("{}-{}", i, j));

  std::string line = fmt::format("Model {}: penaltyFactor", law);
  for (const auto& [lambda, pairs] : pairs_of)
    line += fmt::format(" {} (types {});", with_units(lambda, 1.5 - exponent, lmp->update->unit_style),
                        fmt::join(pairs, " "));
  line.back() = '\n';

  static std::map<std::string, std::string> printed;
  if (printed[law] == line) return;
  printed[law] = line;
  if (lmp->comm->me != 0) return;
  for (FILE* out : {lmp->screen, lmp->logfile})
    if (out) std::fputs(line.c_str(), out);
}

}  // namespace liggghts_pkg
