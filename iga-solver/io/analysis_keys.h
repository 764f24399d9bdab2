// SPDX-License-Identifier: GPL-2.0-or-later
// The key `analysis` of a model file: what iga-solve finds out in place of a motion in time.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "io/output_keys.h"
#include "structure/analysis/modes.h"
#include "structure/analysis/relaxation.h"
#include "structure/analysis/static_equilibrium.h"

namespace io {

/// `kind: static`: the equilibrium under `loads`.
struct StaticAnalysis {
  structure::StaticOptions options;
  std::optional<std::string> save;  ///< state file of the result
};

/// `kind: relax`: the same by kinetic damping.
struct RelaxAnalysis {
  structure::RelaxOptions options;
  std::optional<std::string> save;
};

/// `kind: modes`: free vibrations.
struct ModeAnalysis {
  structure::ModeOptions options;
};

using Analysis = std::variant<StaticAnalysis, RelaxAnalysis, ModeAnalysis>;

/// `analysis: static` or `analysis: {kind: static, ...}`, with the keys of its kind; `inputs` are files that
/// it must not replace, nor those of `output`.  Throws geometry_io::InputError.
Analysis read_analysis(const geometry_io::YamlMap& document, const std::vector<std::string>& inputs,
                       const std::optional<HistoryOutput>& output);

/// "static", "relax" or "modes".
const char* analysis_word(const Analysis& analysis);

}  // namespace io
