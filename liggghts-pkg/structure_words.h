// SPDX-License-Identifier: GPL-2.0-or-later
// What is to be done with the solid of `structure`, and the plug-in that may stand in its place.
#pragma once

#include <optional>
#include <string>

#include "coupling/solid_options.h"
#include "word_reader.h"

namespace liggghts_pkg {

/// What stands after `state` and after `body`.  Throws std::invalid_argument: what was given, what was
/// expected.
void read_state(WordReader& words, coupling::SolidOptions& solid);
void read_modes(WordReader& words, coupling::SolidOptions& solid);

/// What `structure plugin LIBRARY MODEL` names, in place of a file.
struct PluginWords {
  std::string library, model;
};
/// Nothing if the next word is not `plugin`.  Throws as above.
std::optional<PluginWords> read_plugin(WordReader& words);

}  // namespace liggghts_pkg
