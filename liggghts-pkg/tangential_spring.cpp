// SPDX-License-Identifier: GPL-2.0-or-later
#include "tangential_spring.h"

#include <algorithm>

#include "contact_models.h"
#include "law_normal_model.h"
#include "model_words.h"

namespace liggghts_pkg {

namespace {

using namespace LIGGGHTS::ContactModels;
using LAMMPS_NS::LAMMPS;

/// Counts what models would keep.
struct HistoryCount final : LIGGGHTS::IContactHistorySetup {
  virtual ~HistoryCount() = default;
  int add_history_value(std::string, std::string) override { return count++; }
  int count = 0;
};

/// Stands where models expect what they are part of.
struct NoOwner final : ContactModelBase {
  explicit NoOwner(LAMMPS* lmp) : ContactModelBase(lmp, true) {}
  void tally_pp(double, int, int, int) override {}
  void tally_pw(double, int, int, int) override {}
};

std::string word_after(const std::string& keyword, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), keyword);
  return found == words.end() ? "off" : *(found + 1);
}

}  // namespace

// LIGGGHTS tells nobody where its tangential model keeps what.  It builds the parts of a contact model in
// this order: surface, normal, cohesion, tangential; so the first two kinds that keep anything are built here
// once more.
int tangential_spring_place(LAMMPS* lmp, const std::vector<std::string>& model_words) {
  if (word_after("tangential", model_words) != "history") return -1;
  const std::string normal = word_after("model", model_words), cohesion = word_after("cohesion", model_words);
  HistoryCount history;
  NoOwner owner(lmp);
#define NORMAL_MODEL(identifier, word, id) \
  if (normal == #word) NormalModel<id>(lmp, &history, &owner);
#include "style_normal_model.h"
#undef NORMAL_MODEL
  for_each_law([&](auto law) {
    if (normal == law.word) LawNormalModel<decltype(law)>(lmp, &history, &owner);
  });
#define COHESION_MODEL(identifier, word, id) \
  if (cohesion == #word) CohesionModel<id>(lmp, &history, &owner);
#include "style_cohesion_model.h"
#undef COHESION_MODEL
  return history.count;
}

}  // namespace liggghts_pkg
