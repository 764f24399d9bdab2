// SPDX-License-Identifier: GPL-2.0-or-later
// One contact law (contact_laws.h) as a normal model of LIGGGHTS.
// Settings: tangential_damping on|off (on), limitForce on|off (off: no pulling at the end of a damped contact
// when on).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "contact_laws.h"
#include "contact_models.h"
#include "global_properties.h"
#include "law_properties.h"
#include "neighbor.h"
#include "update.h"

namespace liggghts_pkg {

template <class Law>
class LawNormalModel final : public LIGGGHTS::ContactModels::NormalModelBase {
  using IntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using CloseData = LIGGGHTS::ContactModels::SurfacesCloseData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;
  using ContactModelBase = LIGGGHTS::ContactModels::ContactModelBase;

 public:
  LawNormalModel(LAMMPS_NS::LAMMPS* lmp, LIGGGHTS::IContactHistorySetup* memory, ContactModelBase* owner)
      : NormalModelBase(lmp, memory, owner), values_(Law::properties.begin(), Law::properties.end()) {
    // "0": they are the same for both particles; offsets follow each other
    for (std::size_t k = 0; k < kHistoryCount; ++k) {
      const int offset = memory->add_history_value(Law::history[k], "0");
      if (k == 0) history_offset_ = offset;
    }
  }

  void registerSettings(Settings& settings) override {
    settings.registerOnOff("tangential_damping", tangential_damping_, true);
    settings.registerOnOff("limitForce", limit_force_, false);
    settings.registerOnOff("computeElasticPotential", elastic_potential_, false);
    settings.registerOnOff("computeDissipatedEnergy", dissipated_energy_, false);
  }

  // Other parts of the contact model accept these two words as well, so they would pass without effect.
  void postSettings(LIGGGHTS::IContactHistorySetup*, ContactModelBase*) override {
    if (elastic_potential_ || dissipated_energy_)
      error->all(FLERR,
                 fmt::format("Model {} knows neither computeElasticPotential nor computeDissipatedEnergy: "
                             "leave them off",
                             Law::word)
                     .c_str());
  }

  void connectToProperties(PropertyRegistry& registry) override {
    const std::string caller = std::string("model ") + Law::word;
    registry.registerProperty("Yeff", &MODEL_PARAMS::createYeff);
    registry.registerProperty("Geff", &MODEL_PARAMS::createGeff);
    registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff);
    registry.connect("Yeff", E_, caller.c_str());
    registry.connect("Geff", G_, caller.c_str());
    registry.connect("betaeff", beta_, caller.c_str());
    values_.read(registry, Law::word);
    // coarse-grained particles keep forces/length^2 only where no constant has a length
    if (values_.have_lengths() && force->cg_active()) error->cg(FLERR, caller.c_str());
    // a contact between particles is told of its end only where they are seen close to each other
    if (kHistoryCount > 0) neighbor->register_contact_dist_factor(1.01);
  }

  /// n of F ~ d^n.
  double stressStrainExponent() override { return Law::exponent; }

  // Mirrors the arithmetic of LIGGGHTS' hertz term by term; penalty/hertz with lambda = 1 changes no bit.
  void surfacesIntersect(IntersectData& contact, ForceData& on_i, ForceData& on_j) override {
    using std::sqrt;
    if (contact.contact_flags) *contact.contact_flags |= LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
    const int i = contact.itype, j = contact.jtype;
    const double m = contact.meff, beta = beta_[i][j];
    const LawForce law = evaluate(contact);

    const double S_n = law.tangent;
    const double S_t = 8. * G_[i][j] * law.contact_radius;
    contact.kn = law.secant / force->nktv2p;
    contact.kt = S_t / force->nktv2p;
    contact.gamman = -2. * Law::damping_factor * beta * sqrt(S_n * m);  // beta = -zeta <= 0
    contact.gammat = tangential_damping_ ? -2. * HertzLaw::damping_factor * beta * sqrt(S_t * m) : 0.0;

    contact.Fn = -contact.gamman * contact.vn + contact.kn * contact.deltan;
    if (limit_force_ && contact.Fn < 0.0) contact.Fn = 0.0;
    apply(contact, on_i, on_j);
  }

  // A contact that ends is forgotten.
  void surfacesClose(CloseData& contact, ForceData&, ForceData&) override {
    if (kHistoryCount == 0) {
      if (contact.contact_flags) *contact.contact_flags |= LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
      return;
    }
    if (contact.contact_flags) *contact.contact_flags &= ~LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
    if (contact.contact_history) std::fill_n(contact.contact_history + history_offset_, kHistoryCount, 0.0);
  }

  void beginPass(IntersectData&, ForceData&, ForceData&) override {}
  void endPass(IntersectData&, ForceData&, ForceData&) override {}

 private:
  static constexpr std::size_t kHistoryCount = Law::history.size();

  // The history goes on in a time step alone, not when a run is set up or forces are looked at.
  LawForce evaluate(const IntersectData& contact) const {
    const double r =
        contact.is_wall ? contact.radi : contact.radi * contact.radj / (contact.radi + contact.radj);
    const LawContact seen = {r, contact.deltan, E_[contact.itype][contact.jtype],
                             values_.of_types(contact.itype, contact.jtype)};
    double* const history = contact.contact_history + history_offset_;
    if (kHistoryCount > 0 && began_in_this_step(contact)) std::fill_n(history, kHistoryCount, 0.0);
    std::array<double, kHistoryCount> next;
    const LawForce law = Law::evaluate(seen, history, next.data());
    if (contact.computeflag && contact.shearupdate) std::copy(next.begin(), next.end(), history);
    return law;
  }

  // A pair that came apart by more than the distance at which LIGGGHTS looks at it has not been told so.
  bool began_in_this_step(const IntersectData& contact) const {
    return !contact.is_wall && contact.deltan + contact.vn * update->dt <= 0.0;
  }

  static void apply(const IntersectData& contact, ForceData& on_i, ForceData& on_j) {
    const double Fn = contact.is_wall ? contact.Fn * contact.area_ratio : contact.Fn;
    for (int k = 0; k < 3; ++k) {
      on_i.delta_F[k] += Fn * contact.en[k];
      if (!contact.is_wall) on_j.delta_F[k] += -on_i.delta_F[k];
    }
  }

  double **E_ = nullptr, **G_ = nullptr, **beta_ = nullptr;  // of two types, from 1: E*, G*, -zeta
  LawPropertyValues values_;
  int history_offset_ = 0;
  bool tangential_damping_ = true, limit_force_ = false;
  bool elastic_potential_ = false, dissipated_energy_ = false;
};

}  // namespace liggghts_pkg
