// SPDX-License-Identifier: GPL-2.0-or-later
#include "placement_words.h"

#include <stdexcept>

#include "keyword_table.h"

namespace liggghts_pkg {

namespace {

using geometry_io::Placement;

Placement read_rotation(WordReader& words) {
  words.expect("axis");
  const nurbs::Vector3 axis = words.vector("rotate axis");
  if (axis.isZero(0.0)) throw std::invalid_argument("rotate axis is 0 0 0, expected a direction");
  words.expect("angle");
  return geometry_io::turning(axis, words.number("rotate angle"));
}

constexpr Keyword<Placement(WordReader&)> kPlacementKeywords[] = {
    {"scale", "scale S",
     [](WordReader& words) {
       return geometry_io::scaling(nurbs::Vector3::Constant(words.number_above_zero("scale")));
     }},
    {"move", "move X Y Z", [](WordReader& words) { return geometry_io::shifting(words.vector("move")); }},
    {"rotate", "rotate axis X Y Z angle A", read_rotation},
};

}  // namespace

const std::vector<std::string>& placement_keywords() {
  static const std::vector<std::string> keywords = words_of(kPlacementKeywords);
  return keywords;
}

void read_placement(const std::string& keyword, WordReader& words, std::optional<Placement>& placement) {
  const Placement next = find_row(kPlacementKeywords, keyword)->read(words);
  placement = placement ? next * *placement : next;
}

}  // namespace liggghts_pkg
