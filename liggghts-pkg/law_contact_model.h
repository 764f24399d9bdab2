// SPDX-License-Identifier: GPL-2.0-or-later
// A contact model whose normal part is a law of contact_laws.h and whose other parts are any of LIGGGHTS'
// own, chosen at run time. It has the interface of LIGGGHTS' ContactModel<GranStyle<...>>, so it goes into
// Walls::Granular and PairStyles::Granular as it is; one class stands for all combinations.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "contact_models.h"

namespace liggghts_pkg {

class LawContactModel final : public LIGGGHTS::ContactModels::ContactModelBase {
  using IntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using CloseData = LIGGGHTS::ContactModels::SurfacesCloseData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;

 public:
  /// `hash` names the parts (GranStyle::HASHCODE).  Stops LIGGGHTS if they do not go together.
  LawContactModel(LAMMPS_NS::LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* history, bool is_wall,
                  std::int64_t hash);

  std::int64_t hashcode() const { return hash_; }
  double stressStrainExponent() { return normal_->stressStrainExponent(); }
  bool contact_match(const std::string& kind, const std::string& word) const;

  void registerSettings(Settings& settings);
  void postSettings(LIGGGHTS::IContactHistorySetup* history);
  void connectToProperties(PropertyRegistry& registry);

  void beginPass(IntersectData& contact, ForceData& on_i, ForceData& on_j);
  void endPass(IntersectData& contact, ForceData& on_i, ForceData& on_j);
  bool checkSurfaceIntersect(IntersectData& contact) { return surface_.checkSurfaceIntersect(contact); }
  void surfacesIntersect(IntersectData& contact, ForceData& on_i, ForceData& on_j);
  void endSurfacesIntersect(IntersectData& contact, LAMMPS_NS::TriMesh* mesh, ForceData& on_i,
                            ForceData& on_j);
  void surfacesClose(CloseData& contact, ForceData& on_i, ForceData& on_j);

  void tally_pp(double value, int i, int j, int index) override { surface_.tally_pp(value, i, j, index); }
  void tally_pw(double value, int i, int j, int index) override { surface_.tally_pw(value, i, j, index); }

 private:
  std::int64_t hash_;
  LIGGGHTS::ContactModels::SurfaceModel<LIGGGHTS::ContactModels::SURFACE_DEFAULT> surface_;
  // shared, though by nobody: a shared_ptr destroys the class it was made with, and LIGGGHTS' bases have no
  // virtual destructor.  Declared in the order in which LIGGGHTS builds the parts, which is that of the
  // history values.
  std::shared_ptr<LIGGGHTS::ContactModels::NormalModelBase> normal_;
  std::shared_ptr<LIGGGHTS::ContactModels::CohesionModelBase> cohesion_;
  std::shared_ptr<LIGGGHTS::ContactModels::TangentialModelBase> tangential_;
  std::shared_ptr<LIGGGHTS::ContactModels::RollingModelBase> rolling_;
};

}  // namespace liggghts_pkg
