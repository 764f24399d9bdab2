// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure_words.h"

namespace liggghts_pkg {

void read_state(WordReader& words, coupling::SolidOptions& solid) {
  solid.state = words.value("the file of a state, as 'save' of an analysis writes it");
}

void read_modes(WordReader& words, coupling::SolidOptions& solid) {
  words.value_of("body", {"modal"});
  solid.modes = words.count("body modal", "how many modes it keeps, the lowest", coupling::kMostModes);
}

std::optional<PluginWords> read_plugin(WordReader& words) {
  if (!words.next_is_one_of({"plugin"})) return std::nullopt;
  words.keyword();
  const std::string library = words.value("a shared library and what it calls a model");
  return PluginWords{library, words.value("what the library calls a model, a file as a rule")};
}

}  // namespace liggghts_pkg
