// SPDX-License-Identifier: GPL-2.0-or-later
// Which loop over points a material's law has.
#pragma once

#include "structure/material/material.h"
#include "structure/sweep/point_kernel.h"

namespace structure {

struct LawCall {
  int loop;         ///< in PointLoops
  const void* law;  ///< for PointRow::law; null for an outside law, whose OutsideLaw is the caller's
};

/// A law of ElasticLaws by itself, any other from outside.
LawCall law_call(const Material& material);
/// A material asked point after point; memory is still to be set.
OutsideLaw outside_law(const Material& material);

}  // namespace structure
