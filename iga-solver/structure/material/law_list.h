// SPDX-License-Identifier: GPL-2.0-or-later
// The laws that kernels hold inlined, and that model files may name (laws.h).
#pragma once

#include "structure/material/linear_elastic.h"
#include "structure/material/neo_hooke.h"
#include "structure/material/orthotropic_elastic.h"
#include "structure/material/saint_venant_kirchhoff.h"

namespace structure {

template <class... Laws>
struct LawList {
  static constexpr int kCount = sizeof...(Laws);
};

using ElasticLaws = LawList<LinearElasticLaw, SaintVenantKirchhoffLaw, NeoHookeLaw, OrthotropicElasticLaw>;

}  // namespace structure
