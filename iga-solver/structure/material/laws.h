// SPDX-License-Identifier: GPL-2.0-or-later
// The laws that model files may name: word, constants, and how a law is made of them.  An elastic law is a
// struct in a file of its own and its name in law_list.h; one of other constants than E and nu also a row of
// them here; one with memory a class behind Material and a row here.  The rest (messages, fingerprints of
// restart files, the time step) is the same for all.
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

/// A vector of the model file that may be left out.
struct MaterialDirection {
  const char* key;
  Eigen::Vector3d otherwise;
};

struct MaterialLaw {
  const char* word;
  std::vector<MaterialConstant> constants;
  std::vector<MaterialDirection> directions;
  /// From the values of the constants and then the directions' components, in that order.  Throws
  /// std::invalid_argument if they do not go together.
  std::shared_ptr<const Material> (*make)(const std::vector<double>& values);
};

using LinearElastic = ElasticMaterial<LinearElasticLaw>;
using SaintVenantKirchhoff = ElasticMaterial<SaintVenantKirchhoffLaw>;
using NeoHooke = ElasticMaterial<NeoHookeLaw>;
using OrthotropicSolid = ElasticMaterial<OrthotropicElasticLaw>;

template <class Law>
MaterialLaw elastic_law(const IsotropicElastic* /*constants*/) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Law::kWord,
          {{"youngs_modulus", 0.0, kInfinity}, {"poissons_ratio", -1.0, 0.5}, {"density", 0.0, kInfinity}},
          {},
          [](const std::vector<double>& v) -> std::shared_ptr<const Material> {
            return std::make_shared<ElasticMaterial<Law>>(v[0], v[1], v[2]);
          }};
}
template <class Law>
MaterialLaw elastic_law(const OrthotropicElastic* /*constants*/) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto positive = [](const char* key) { return MaterialConstant{key, 0.0, kInfinity}; };
  const auto any = [](const char* key) { return MaterialConstant{key, -kInfinity, kInfinity}; };
  return {Law::kWord,
          {positive("E_1"), positive("E_2"), positive("E_3"), any("nu_12"), any("nu_13"), any("nu_23"),
           positive("G_12"), positive("G_13"), positive("G_23"), positive("density")},
          {{"direction_1", {1, 0, 0}}, {"direction_2", {0, 1, 0}}},
          [](const std::vector<double>& v) -> std::shared_ptr<const Material> {
            return std::make_shared<ElasticMaterial<Law>>(OrthotropicConstants{{v[0], v[1], v[2]},
                                                                               {v[3], v[4], v[5]},
                                                                               {v[6], v[7], v[8]},
                                                                               v[9],
                                                                               {v[10], v[11], v[12]},
                                                                               {v[13], v[14], v[15]}});
          }};
}
template <class... Laws>
std::vector<MaterialLaw> elastic_laws(LawList<Laws...>) {
  return {elastic_law<Laws>(static_cast<const typename Laws::Constants*>(nullptr))...};
}

inline const std::vector<MaterialLaw>& material_laws() {
  static const std::vector<MaterialLaw> kLaws = elastic_laws(NamedLaws{});
  return kLaws;
}

}  // namespace structure
