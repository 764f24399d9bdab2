// SPDX-License-Identifier: GPL-2.0-or-later
// The bin of inputs/hopper_step: cylinder, knuckle, cone, outlet with a bolted flange, a nozzle that joins
// the cone in a blended root, and a chute below.
#pragma once

#include <TDocStd_Document.hxx>

namespace step_parts {

/// Solids `bin`, `flange` and `chute`; faces inside the bin and the floor of the chute have names.  mm.
Handle(TDocStd_Document) hopper();

}  // namespace step_parts
