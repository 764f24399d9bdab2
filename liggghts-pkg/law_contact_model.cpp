// SPDX-License-Identifier: GPL-2.0-or-later
#include "law_contact_model.h"

#include "error.h"
#include "law_normal_model.h"
#include "model_words.h"

namespace liggghts_pkg {

namespace {

using namespace LIGGGHTS::ContactModels;
using LAMMPS_NS::LAMMPS;
using LIGGGHTS::IContactHistorySetup;

/// What a part's constructor takes.
struct PartContext {
  LAMMPS* lmp;
  IContactHistorySetup* history;
  ContactModelBase* owner;
};

template <class Part>
std::shared_ptr<Part> make_part(const PartContext& context) {
  return std::make_shared<Part>(context.lmp, context.history, context.owner);
}

std::int64_t checked(LAMMPS* lmp, std::int64_t hash, bool is_wall) {
  const std::string reason = why_refused(model_choice(hash), is_wall);
  if (!reason.empty()) lmp->error->all(FLERR, reason.c_str());
  return hash;
}

std::shared_ptr<NormalModelBase> make_normal(std::int64_t hash, const PartContext& context) {
  std::shared_ptr<NormalModelBase> normal;
  for_each_law([&](auto law) {
    if (law.id == (hash & 63)) normal = make_part<LawNormalModel<decltype(law)>>(context);
  });
  return normal;
}

std::shared_ptr<CohesionModelBase> make_cohesion(std::int64_t hash, const PartContext& context) {
  switch (hash >> 12 & 63) {
#define COHESION_MODEL(identifier, word, id) \
  case id:                                   \
    return make_part<CohesionModel<id>>(context);
#include "style_cohesion_model.h"
#undef COHESION_MODEL
    default:
      return make_part<CohesionModel<COHESION_OFF>>(context);
  }
}

std::shared_ptr<TangentialModelBase> make_tangential(std::int64_t hash, const PartContext& context) {
  switch (hash >> 6 & 63) {
#define TANGENTIAL_MODEL(identifier, word, id) \
  case id:                                     \
    return make_part<TangentialModel<id>>(context);
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
    default:
      return make_part<TangentialModel<TANGENTIAL_OFF>>(context);
  }
}

std::shared_ptr<RollingModelBase> make_rolling(std::int64_t hash, const PartContext& context) {
  switch (hash >> 18 & 63) {
#define ROLLING_MODEL(identifier, word, id) \
  case id:                                  \
    return make_part<RollingModel<id>>(context);
#include "style_rolling_model.h"
#undef ROLLING_MODEL
    default:
      return make_part<RollingModel<ROLLING_OFF>>(context);
  }
}

}  // namespace

LawContactModel::LawContactModel(LAMMPS* lmp, IContactHistorySetup* history, bool is_wall, std::int64_t hash)
    : ContactModelBase(lmp, is_wall),
      hash_(checked(lmp, hash, is_wall)),
      surface_(lmp, history, this),
      normal_(make_normal(hash, {lmp, history, this})),
      cohesion_(make_cohesion(hash, {lmp, history, this})),
      tangential_(make_tangential(hash, {lmp, history, this})),
      rolling_(make_rolling(hash, {lmp, history, this})) {}

bool LawContactModel::contact_match(const std::string& kind, const std::string& word) const {
  const ModelChoice models = model_choice(hash_);
  if (kind == "surface") return models.surface == word;
  if (kind == "normal") return models.normal == word;
  if (kind == "cohesion") return models.cohesion == word;
  if (kind == "tangential") return models.tangential == word;
  return kind == "rolling_friction" && models.rolling == word;
}

// The parts take their turns in the order of LIGGGHTS' ContactModel.

void LawContactModel::registerSettings(Settings& settings) {
  surface_.registerSettings(settings);
  normal_->registerSettings(settings);
  cohesion_->registerSettings(settings);
  tangential_->registerSettings(settings);
  rolling_->registerSettings(settings);
}

void LawContactModel::postSettings(IContactHistorySetup* history) {
  normal_->postSettings(history,
                        this);  // first: it refuses settings that the surface model would stumble over
  surface_.postSettings(history, this);
  cohesion_->postSettings(history, this);
  tangential_->postSettings(history, this);
  rolling_->postSettings(history, this);
}

void LawContactModel::connectToProperties(PropertyRegistry& registry) {
  surface_.connectToProperties(registry);
  normal_->connectToProperties(registry);
  cohesion_->connectToProperties(registry);
  tangential_->connectToProperties(registry);
  rolling_->connectToProperties(registry);
}

void LawContactModel::beginPass(IntersectData& contact, ForceData& on_i, ForceData& on_j) {
  surface_.beginPass(contact, on_i, on_j);
  normal_->beginPass(contact, on_i, on_j);
  cohesion_->beginPass(contact, on_i, on_j);
  tangential_->beginPass(contact, on_i, on_j);
  rolling_->beginPass(contact, on_i, on_j);
}

void LawContactModel::endPass(IntersectData& contact, ForceData& on_i, ForceData& on_j) {
  rolling_->endPass(contact, on_i, on_j);
  tangential_->endPass(contact, on_i, on_j);
  cohesion_->endPass(contact, on_i, on_j);
  normal_->endPass(contact, on_i, on_j);
  surface_.endPass(contact, on_i, on_j);
}

void LawContactModel::surfacesIntersect(IntersectData& contact, ForceData& on_i, ForceData& on_j) {
  surface_.surfacesIntersect(contact, on_i, on_j);
  normal_->surfacesIntersect(contact, on_i, on_j);
  cohesion_->surfacesIntersect(contact, on_i, on_j);
  tangential_->surfacesIntersect(contact, on_i, on_j);
  rolling_->surfacesIntersect(contact, on_i, on_j);
}

void LawContactModel::endSurfacesIntersect(IntersectData& contact, LAMMPS_NS::TriMesh* mesh, ForceData& on_i,
                                           ForceData& on_j) {
  surface_.endSurfacesIntersect(contact, mesh, on_i.delta_F);
  cohesion_->endSurfacesIntersect(contact, on_i, on_j);
}

void LawContactModel::surfacesClose(CloseData& contact, ForceData& on_i, ForceData& on_j) {
  surface_.surfacesClose(contact, on_i, on_j);
  normal_->surfacesClose(contact, on_i, on_j);
  cohesion_->surfacesClose(contact, on_i, on_j);
  tangential_->surfacesClose(contact, on_i, on_j);
  rolling_->surfacesClose(contact, on_i, on_j);
}

}  // namespace liggghts_pkg
