// SPDX-License-Identifier: GPL-2.0-or-later
// The words after `structure`: the file, and what is to be done with the solid in it; or a plug-in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/solid_options.h"
#include "word_reader.h"

namespace liggghts_pkg {

/// Reads as many as are ours.  Throws std::invalid_argument: what was given, what was expected.
coupling::SolidOptions read_solid(WordReader& words);

/// What `structure plugin LIBRARY MODEL` names, in place of a file.
struct PluginWords {
  std::string library, model;
};
/// Nothing if the next word is not `plugin`.  Throws as above.
std::optional<PluginWords> read_plugin(WordReader& words);

/// As the manual shows them: "state STATE", "plugin LIBRARY MODEL".
std::vector<std::string> solid_syntax();

}  // namespace liggghts_pkg
