// SPDX-License-Identifier: GPL-2.0-or-later
// The head of all of the fix's messages.
#pragma once

#include <fmt/format.h>

#include <string>

namespace LAMMPS_NS {

/// "Fix wall/nurbs (id plate): ..."
inline std::string wall_nurbs_message(const char* id, const std::string& what) {
  return fmt::format("Fix wall/nurbs (id {}): {}", id, what);
}

}  // namespace LAMMPS_NS
