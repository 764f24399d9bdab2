// SPDX-License-Identifier: GPL-2.0-or-later
// lambda of the penalty laws: `fix ID all property/global penaltyFactor peratomtypepair N l_11 l_12 ...`.
#pragma once

#include "property_registry.h"

namespace liggghts_pkg {

/// Reads the property `penaltyFactor`; stops LIGGGHTS unless every value is a positive number.  A creator for
/// PropertyRegistry::registerProperty.
MatrixProperty* create_penalty_factor(PropertyRegistry& registry, const char* caller, bool sanity_checks);

/// Prints, on rank 0, a law's lambda in the deck's units and in mm: what a paper gives in one is easily typed
/// in the other.  `exponent` n of the law gives lambda's dimension, length^(3/2 - n).  Says the same thing
/// only once.
void print_penalty_factor(LAMMPS_NS::LAMMPS* lmp, const char* law, double exponent, double** factor);

}  // namespace liggghts_pkg
