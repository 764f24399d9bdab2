// SPDX-License-Identifier: GPL-2.0-or-later
// The words that move a rigid wall, as LIGGGHTS has them:
//   motion VERB ...                              fix move/mesh
//   servo com X Y Z ctrlPV ...                   mesh module servo
//   surface_vel VX VY VZ, surface_ang_vel ...    fix mesh/surface
#pragma once

#include <string>
#include <vector>

#include "coupling/rigid/rigid_surface.h"
#include "word_reader.h"

namespace liggghts_pkg {

/// The keywords, each of which stands before the words that read_drive reads.
const std::vector<std::string>& drive_keywords();

/// Reads the words after `keyword`, one of drive_keywords, and adds them to the drive.  Throws
/// std::invalid_argument: what was given, what was expected.  `mode auto` of a servo leaves its two callbacks
/// to be set.
void read_drive(const std::string& keyword, WordReader& words, const VariableLookup& variable,
                coupling::RigidDrive& drive);

/// Reads one of LIGGGHTS' fix_modify words, or all consecutive motions, and changes the wall between runs:
///   motion none | motion VERB ... [motion VERB ...]
///   servo/integrate start|stop, servo/target_val T, servo/vel_max V, servo/ctrlParam KP KI KD, servo/ratio R
/// Throws std::invalid_argument as read_drive does.
void change_drive(WordReader& words, const VariableLookup& variable, coupling::RigidSurface& wall);

/// "motion", "servo" or "surface_vel": what drives the wall, or "" if nothing does.
std::string drive_name(const coupling::RigidDrive& drive);

/// All these words with their values, as the manual shows them: "rotate origin Px Py Pz axis ax ay az period
/// P".
std::vector<std::string> motion_syntax();

}  // namespace liggghts_pkg
