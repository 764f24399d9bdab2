// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/analysis_keys.h"

#include <algorithm>
#include <iterator>

#include "io/run_keys.h"

namespace io {

using geometry_io::YamlMap;

namespace {

structure::PreconditionerKind read_preconditioner(const YamlMap& map) {
  using Kind = structure::PreconditionerKind;
  const std::string word = map.word_of("preconditioner", {"auto", "sparse", "tensor", "nodes"});
  return word == "sparse"   ? Kind::sparse
         : word == "tensor" ? Kind::tensor
         : word == "nodes"  ? Kind::nodes
                            : Kind::automatic;
}

StaticAnalysis read_static(const YamlMap& map) {
  map.allow_only({"kind", "load_steps", "tolerance", "iterations", "preconditioner", "save"});
  StaticAnalysis analysis;
  if (map.has("load_steps")) analysis.options.load_steps = map.integer("load_steps", 1, 100000);
  if (map.has("tolerance")) analysis.options.tolerance = map.number("tolerance", {0.0, 0.1});
  if (map.has("iterations")) analysis.options.most_iterations = map.integer("iterations", 1, 10000);
  if (map.has("preconditioner")) analysis.options.preconditioner = read_preconditioner(map);
  if (map.has("save")) analysis.save = map.word("save");
  return analysis;
}

RelaxAnalysis read_relax(const YamlMap& map) {
  map.allow_only({"kind", "tolerance", "steps", "save"});
  RelaxAnalysis analysis;
  if (map.has("tolerance")) analysis.options.tolerance = map.number("tolerance", {0.0, 0.1});
  if (map.has("steps")) analysis.options.most_steps = map.integer("steps", 1, 2'000'000'000);
  if (map.has("save")) analysis.save = map.word("save");
  return analysis;
}

ModeAnalysis read_modes(const YamlMap& map) {
  map.allow_only({"kind", "count", "tolerance", "preconditioner", "mass"});
  ModeAnalysis analysis;
  if (map.has("mass") && map.word_of("mass", {"lumped", "consistent"}) == "consistent")
    analysis.options.mass = structure::MassKind::consistent;
  if (map.has("count")) analysis.options.count = map.integer("count", 1, 1000);
  if (map.has("tolerance")) analysis.options.tolerance = map.number("tolerance", {0.0, 0.1});
  if (map.has("preconditioner")) analysis.options.preconditioner = read_preconditioner(map);
  return analysis;
}

struct Kind {
  const char* word;
  Analysis (*read)(const YamlMap& map);
  Analysis usual;
};
const Kind kKinds[] = {
    {"static", [](const YamlMap& map) -> Analysis { return read_static(map); }, StaticAnalysis{}},
    {"relax", [](const YamlMap& map) -> Analysis { return read_relax(map); }, RelaxAnalysis{}},
    {"modes", [](const YamlMap& map) -> Analysis { return read_modes(map); }, ModeAnalysis{}},
};

const Kind& kind_of(const YamlMap& map, const std::string& key) {
  const std::string word = map.word_of(key, {"static", "relax", "modes"});
  return *std::find_if(std::begin(kKinds), std::end(kKinds),
                       [&](const Kind& kind) { return kind.word == word; });
}

}  // namespace

Analysis read_analysis(const YamlMap& document, const std::vector<std::string>& inputs,
                       const std::optional<HistoryOutput>& output) {
  if (!document.is_map("analysis")) return kind_of(document, "analysis").usual;
  const YamlMap map = document.map("analysis");
  if (map.has("save")) read_save(map, inputs, output);
  return kind_of(map, "kind").read(map);
}

const char* analysis_word(const Analysis& analysis) {
  return std::find_if(std::begin(kKinds), std::end(kKinds),
                      [&](const Kind& kind) { return kind.usual.index() == analysis.index(); })
      ->word;
}

}  // namespace io
