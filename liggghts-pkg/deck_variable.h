// SPDX-License-Identifier: GPL-2.0-or-later
// A variable of the deck as a number that is evaluated when it is asked for.
#pragma once

#include <string>

#include "coupling/value.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace liggghts_pkg {

/// The equal-style variable `name`; throws std::invalid_argument if there is none now.  If it has been
/// deleted when it is asked for, the program ends with a message of the fix `fix_id`.
coupling::Value deck_variable(LAMMPS_NS::LAMMPS* lmp, const std::string& fix_id, const std::string& name);

}  // namespace liggghts_pkg
