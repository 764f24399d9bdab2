// SPDX-License-Identifier: GPL-2.0-or-later
// How this library gets into LIGGGHTS without touching it.  LIGGGHTS builds its tables of styles in
// LAMMPS::create(), which the constructor and the command `clear` call.  The library exports a function of
// that name; where it stands before libliggghts in the order of symbol lookup (the executable liggghts-nurbs,
// or LD_PRELOAD), it is called instead, runs the original and adds our styles.
#pragma once

#include "lammps.h"

namespace liggghts_pkg {

/// Adds our fix styles to this instance.
void register_styles(LAMMPS_NS::LAMMPS* lmp);

}  // namespace liggghts_pkg
