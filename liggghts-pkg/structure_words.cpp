// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure_words.h"

#include <stdexcept>

#include "keyword_table.h"

namespace liggghts_pkg {

namespace {

using coupling::SolidOptions;

constexpr Keyword<void(WordReader&, SolidOptions&)> kSolidKeywords[] = {
    {"state", "state STATE",
     [](WordReader& words, SolidOptions& solid) {
       if (!solid.state.empty()) throw std::invalid_argument("'state' is given twice, expected once");
       solid.state = words.value("the file of a state, as 'save' of an analysis writes it");
     }},
    {"body", "body modal N",
     [](WordReader& words, SolidOptions& solid) {
       if (solid.modes) throw std::invalid_argument("'body' is given twice, expected once");
       words.value_of("body", {"modal"});
       solid.modes = words.count("body modal", "how many modes it keeps, the lowest", coupling::kMostModes);
     }},
};

}  // namespace

coupling::SolidOptions read_solid(WordReader& words) {
  SolidOptions solid;
  while (words.next_is_one_of(words_of(kSolidKeywords)))
    find_row(kSolidKeywords, words.keyword())->read(words, solid);
  return solid;
}

std::optional<PluginWords> read_plugin(WordReader& words) {
  if (!words.next_is_one_of({"plugin"})) return std::nullopt;
  words.keyword();
  const std::string library = words.value("a shared library and what it calls a model");
  return PluginWords{library, words.value("what the library calls a model, a file as a rule")};
}

std::vector<std::string> solid_syntax() {
  std::vector<std::string> lines = syntax_of(kSolidKeywords);
  lines.emplace_back("structure plugin LIBRARY MODEL");
  return lines;
}

}  // namespace liggghts_pkg
