// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "contact_laws.h"
#include "contact_model_constants.h"
#include "keyword_table.h"

namespace liggghts_pkg {

namespace {

using namespace LIGGGHTS::ContactModels;

// LIGGGHTS' lists of models are X-macros: each style_<kind>_model.h calls <KIND>_MODEL(identifier, word, id)
// per model.
#define LIST_ENTRY(identifier, word, id) {#word, id},

std::vector<ModelWord> normal_models() {
  std::vector<ModelWord> models = {
      {"off", NORMAL_OFF},
#define NORMAL_MODEL LIST_ENTRY
#include "style_normal_model.h"
#undef NORMAL_MODEL
  };
  for_each_law([&](auto law) { models.push_back({law.word, law.id}); });
  return models;
}

std::vector<ModelWord> tangential_models() {
  return {
      {"off", TANGENTIAL_OFF},
#define TANGENTIAL_MODEL LIST_ENTRY
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
  };
}

std::vector<ModelWord> cohesion_models() {
  return {
      {"off", COHESION_OFF},
#define COHESION_MODEL LIST_ENTRY
#include "style_cohesion_model.h"
#undef COHESION_MODEL
  };
}

std::vector<ModelWord> rolling_models() {
  return {
      {"off", ROLLING_OFF},
#define ROLLING_MODEL LIST_ENTRY
#include "style_rolling_model.h"
#undef ROLLING_MODEL
  };
}

std::vector<ModelWord> surface_models() {
  return {
#define SURFACE_MODEL LIST_ENTRY
#include "style_surface_model.h"
#undef SURFACE_MODEL
  };
}

#undef LIST_ENTRY

/// A keyword, the models it chooses from and where the choice goes; in the order that LIGGGHTS demands.
struct ModelKeyword {
  const char* word;
  const char* syntax;
  ModelKind kind;
  std::string ModelChoice::*choice;
};
const ModelKeyword kModelKeywords[] = {
    {"model", "model M", ModelKind::normal, &ModelChoice::normal},
    {"tangential", "tangential T", ModelKind::tangential, &ModelChoice::tangential},
    {"cohesion", "cohesion C", ModelKind::cohesion, &ModelChoice::cohesion},
    {"rolling_friction", "rolling_friction R", ModelKind::rolling, &ModelChoice::rolling},
    {"surface", "surface default", ModelKind::surface, &ModelChoice::surface},
};

std::vector<std::string> names_of(const std::vector<ModelWord>& models) {
  std::vector<std::string> words;
  for (const ModelWord& model : models) words.push_back(model.word);
  return words;
}

bool is_known(const ModelKeyword& keyword, const std::string& given) {
  const std::vector<ModelWord>& known = known_models(keyword.kind);
  return std::any_of(known.begin(), known.end(), [&](const ModelWord& model) { return model.word == given; });
}

void check_known(const ModelKeyword& keyword, const std::string& given) {
  if (is_known(keyword, given)) return;
  throw std::invalid_argument(
      unknown_word(fmt::format("{} model", keyword.kind == ModelKind::normal ? "contact" : keyword.word),
                   given, names_of(known_models(keyword.kind))));
}

bool is_contact_law(const std::string& word) {
  bool found = false;
  for_each_law([&](auto law) { found |= word == law.word; });
  return found;
}

}  // namespace

const std::vector<ModelWord>& known_models(ModelKind kind) {
  // Local, since law_register.cpp asks while the program's static objects are still being made.
  static const std::vector<ModelWord> normal = normal_models(), tangential = tangential_models(),
                                      cohesion = cohesion_models(), rolling = rolling_models(),
                                      surface = surface_models();
  switch (kind) {
    case ModelKind::normal:
      return normal;
    case ModelKind::tangential:
      return tangential;
    case ModelKind::cohesion:
      return cohesion;
    case ModelKind::rolling:
      return rolling;
    default:
      return surface;
  }
}

ModelChoice model_choice(std::int64_t hash) {
  ModelChoice models;
  int shift = 0;
  for (const ModelKeyword& keyword : kModelKeywords) {
    const int id = (hash >> shift) & 63;
    shift += 6;
    const std::vector<ModelWord>& known = known_models(keyword.kind);
    const auto model =
        std::find_if(known.begin(), known.end(), [&](const ModelWord& m) { return m.id == id; });
    if (model == known.end())
      throw std::invalid_argument(
          fmt::format("no {} model has the id {} in LIGGGHTS' headers", keyword.word, id));
    models.*keyword.choice = model->word;
  }
  return models;
}

std::string why_refused(const ModelChoice& models, bool is_wall) {
  if (models.surface != "default" && is_contact_law(models.normal))
    return fmt::format("surface model '{}' needs a normal model of LIGGGHTS' own, given '{}'", models.surface,
                       models.normal);
  if (models.surface != "default" && is_wall)
    return fmt::format("surface model '{}' needs {}, expected 'default'", models.surface,
                       models.surface == "superquadric" ? "a LIGGGHTS that is built for superquadrics"
                                                        : "a triangle mesh as wall");
  // these two read the history of the normal model luding, whoever has written it
  if (models.tangential == "tan_luding" && models.normal != "luding")
    return fmt::format("tangential model 'tan_luding' needs model 'luding', given '{}'", models.normal);
  if (models.rolling == "luding" && models.normal != "luding")
    return fmt::format("rolling_friction model 'luding' needs model 'luding', given '{}'", models.normal);
  // after the contact it looks up the velocity of particle j; a wall without mesh has a negative j
  if (is_wall && models.cohesion == "easo/capillary/viscous")
    return "cohesion model 'easo/capillary/viscous' needs a triangle mesh as wall, expected another cohesion "
           "model ('washino/capillary/viscous' works)";
  // nobody sets the stiffness that tangential and rolling models use
  if (is_wall && models.normal == "off")
    return "model 'off' leaves a wall without stiffness, expected a normal model";
  return "";
}

bool is_hertzian(const std::string& normal_model) {
  return normal_model == "hertz" || normal_model == HertzLaw::word;
}

ModelChoice model_of(const std::vector<std::string>& words) {
  ModelChoice models;
  for (const ModelKeyword& keyword : kModelKeywords) {
    const auto found = std::find(words.begin(), words.end(), keyword.word);
    if (found != words.end() && found + 1 != words.end()) models.*keyword.choice = found[1];
  }
  return models;
}

std::vector<std::string> model_syntax() { return syntax_of(kModelKeywords); }

std::size_t check_contact_models(const std::vector<std::string>& words) {
  if (words.empty() || words[0] != kModelKeywords[0].word)
    throw std::invalid_argument(
        fmt::format("first comes '{}', expected 'model NORMAL' (such as 'model hertz')",
                    words.empty() ? "nothing" : words[0]));
  ModelChoice models;
  std::size_t next = 0;
  for (const ModelKeyword& keyword : kModelKeywords) {
    if (next == words.size() || words[next] != keyword.word) continue;
    if (next + 1 == words.size())
      throw std::invalid_argument(fmt::format("'{}' is the last word, expected one of {} after it",
                                              keyword.word,
                                              fmt::join(names_of(known_models(keyword.kind)), ", ")));
    if (keyword.kind == ModelKind::surface && !is_known(keyword, words[next + 1]))
      break;  // `surface NAME` of the wall
    check_known(keyword, words[next + 1]);
    models.*keyword.choice = words[next + 1];
    next += 2;
  }
  const std::string reason = why_refused(models, true);
  if (!reason.empty()) throw std::invalid_argument(reason);
  return next;
}

void check_model_settings(const std::vector<std::string>& words) {
  for (const char* setting : {"computeElasticPotential", "computeDissipatedEnergy"}) {
    const auto found = std::find(words.begin(), words.end(), setting);
    if (found != words.end() && found + 1 != words.end() && found[1] == "on")
      throw std::invalid_argument(
          fmt::format("'{} on' needs a triangle mesh as wall, expected off", setting));
  }
}

}  // namespace liggghts_pkg
