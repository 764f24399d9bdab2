// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/law_call.h"

#include "structure/material/elastic_material.h"
#include "structure/material/law_list.h"

namespace structure {

namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

template <class... Laws>
LawCall find(const Material& material, LawList<Laws...>) {
  LawCall call{sizeof...(Laws), nullptr};
  int i = 0;
  const auto look = [&](const auto* elastic) {
    if (elastic) call = {i, &elastic->inlined_law()};
    ++i;
  };
  (look(dynamic_cast<const ElasticMaterial<Laws>*>(&material)), ...);
  return call;
}

void stress(const void* law, const double* H, const double* state, double* next, double dt, double* P) {
  const Material& material = *static_cast<const Material*>(law);
  const Matrix3 gradient = Eigen::Map<const RowMajor>(H);
  if (next) material.evolve(gradient, dt, state, next);
  Eigen::Map<RowMajor>{P} = material.stress(gradient, next ? next : state);
}

double energy_density(const void* law, const double* H, const double* state) {
  return static_cast<const Material*>(law)->energy_density(Eigen::Map<const RowMajor>(H), state);
}

void stress_change(const void* law, const double* H, const double* G, const double* state, double* dP) {
  Eigen::Map<RowMajor>{dP} = static_cast<const Material*>(law)->stress_change(
      Eigen::Map<const RowMajor>(H), Eigen::Map<const RowMajor>(G), state);
}

}  // namespace

LawCall law_call(const Material& material) { return find(material, ElasticLaws{}); }

OutsideLaw outside_law(const Material& material) {
  return {&material, stress, energy_density, stress_change, nullptr, nullptr, 0.0, nullptr};
}

}  // namespace structure
