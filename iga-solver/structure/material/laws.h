// SPDX-License-Identifier: GPL-2.0-or-later
// The laws that model files may name: word, constants, and how a law is made of them.  An elastic law of two
// constants is a struct in a file of its own and its name in law_list.h; any other is a class behind Material
// and a row here.  The rest (keys, messages, fingerprints of restart files, the time step) is the same for
// all.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "structure/material/elastic_material.h"
#include "structure/material/law_list.h"

namespace structure {

/// A number of the model file, by its key; both bounds are excluded.
struct MaterialConstant {
  const char* key;
  double low, high;
};

struct MaterialLaw {
  const char* word;
  std::vector<MaterialConstant> constants;
  /// From their values, in that order.
  std::shared_ptr<const Material> (*make)(const std::vector<double>& constants);
};

using LinearElastic = ElasticMaterial<LinearElasticLaw>;
using SaintVenantKirchhoff = ElasticMaterial<SaintVenantKirchhoffLaw>;

template <class Law>
MaterialLaw elastic_law() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Law::kWord,
          {{"youngs_modulus", 0.0, kInfinity}, {"poissons_ratio", -1.0, 0.5}, {"density", 0.0, kInfinity}},
          [](const std::vector<double>& constants) -> std::shared_ptr<const Material> {
            return std::make_shared<ElasticMaterial<Law>>(constants[0], constants[1], constants[2]);
          }};
}
template <class... Laws>
std::vector<MaterialLaw> elastic_laws(LawList<Laws...>) {
  return {elastic_law<Laws>()...};
}

inline const std::vector<MaterialLaw>& material_laws() {
  static const std::vector<MaterialLaw> kLaws = elastic_laws(ElasticLaws{});
  return kLaws;
}

}  // namespace structure
