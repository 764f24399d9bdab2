// SPDX-License-Identifier: GPL-2.0-or-later
// The laws that model files may name.  A law is a class behind Material, in this file or in one of its own,
// and a row of the table below: its word, the constants that it takes, and how it is made of them.  The rest
// (keys, messages, fingerprints of restart files, the time step) is the same for all.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "structure/material/linear_elastic.h"
#include "structure/material/saint_venant_kirchhoff.h"

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

template <class Law>
std::shared_ptr<const Material> isotropic(const std::vector<double>& constants) {
  return std::make_shared<Law>(constants[0], constants[1], constants[2]);
}

inline const std::vector<MaterialLaw>& material_laws() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static const std::vector<MaterialConstant> kIsotropic = {
      {"youngs_modulus", 0.0, kInfinity}, {"poissons_ratio", -1.0, 0.5}, {"density", 0.0, kInfinity}};
  static const std::vector<MaterialLaw> kLaws = {
      {"linear_elastic", kIsotropic, isotropic<LinearElastic>},
      {"saint_venant_kirchhoff", kIsotropic, isotropic<SaintVenantKirchhoff>},
  };
  return kLaws;
}

}  // namespace structure
