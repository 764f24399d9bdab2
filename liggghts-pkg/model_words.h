// SPDX-License-Identifier: GPL-2.0-or-later
// The words of a contact model, `model N tangential T cohesion C rolling_friction R surface S`: which there
// are, and which are unsafe.  LIGGGHTS takes some words that then read memory out of bounds; those are
// refused here first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace liggghts_pkg {

enum class ModelKind { normal, tangential, cohesion, rolling, surface };

struct ModelWord {
  std::string word;
  int id;  ///< LIGGGHTS' number of the model, unique within its kind
};

/// All models of a kind: those of LIGGGHTS' installed headers, "off" where it exists, and this package's own.
const std::vector<ModelWord>& known_models(ModelKind kind);

/// One choice of each kind.
struct ModelChoice {
  std::string normal = "off", tangential = "off", cohesion = "off", rolling = "off", surface = "default";
};

/// The choice behind LIGGGHTS' hash (GranStyle::HASHCODE); throws std::invalid_argument if an id is unknown.
ModelChoice model_choice(std::int64_t hash);

/// Why these models must not be used together, or "" if they may.  `is_wall`: a wall without triangle mesh,
/// else particle pairs.
std::string why_refused(const ModelChoice& models, bool is_wall);

/// Whether a normal model's elastic force is K x^(3/2).
bool is_hertzian(const std::string& normal_model);

/// The choice that these words make, which check_contact_models has let pass.
ModelChoice model_of(const std::vector<std::string>& words);

/// Checks the model words of a wall, which stand first in `words`; returns how many of them they are.  Throws
/// std::invalid_argument for an unknown, missing or refused model.
std::size_t check_contact_models(const std::vector<std::string>& words);

/// Checks the on/off settings of a wall's models; throws std::invalid_argument for those that need a triangle
/// mesh.
void check_model_settings(const std::vector<std::string>& words);

/// The keywords with their values, as the manual shows them: "tangential T".
std::vector<std::string> model_syntax();

}  // namespace liggghts_pkg
