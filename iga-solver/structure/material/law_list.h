// SPDX-License-Identifier: GPL-2.0-or-later
// The laws that kernels hold inlined: those that model files may name (laws.h), and what these are in plates.
#pragma once

#include "structure/material/linear_elastic.h"
#include "structure/material/neo_hooke.h"
#include "structure/material/orthotropic_elastic.h"
#include "structure/material/plate_shear.h"
#include "structure/material/saint_venant_kirchhoff.h"

namespace structure {

template <class... Laws>
struct LawList {
  static constexpr int kCount = sizeof...(Laws);
};

using NamedLaws = LawList<LinearElasticLaw, SaintVenantKirchhoffLaw, NeoHookeLaw, OrthotropicElasticLaw>;
using ElasticLaws = LawList<LinearElasticLaw, SaintVenantKirchhoffLaw, NeoHookeLaw, OrthotropicElasticLaw,
                            PlateShearLaw<LinearElasticLaw>, PlateShearLaw<SaintVenantKirchhoffLaw>>;

}  // namespace structure
