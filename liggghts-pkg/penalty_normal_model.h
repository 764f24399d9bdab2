// SPDX-License-Identifier: GPL-2.0-or-later
// One penalty law (penalty_laws.h) as a normal model of LIGGGHTS.
// Settings: tangential_damping on|off (on), limitForce on|off (off: no pulling at the end of a damped contact
// when on).
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "contact_models.h"
#include "global_properties.h"
#include "penalty_factor.h"
#include "penalty_laws.h"

namespace liggghts_pkg {

template <class Law>
class PenaltyNormalModel final : public LIGGGHTS::ContactModels::NormalModelBase {
  using IntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using CloseData = LIGGGHTS::ContactModels::SurfacesCloseData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;
  using ContactModelBase = LIGGGHTS::ContactModels::ContactModelBase;

 public:
  using NormalModelBase::NormalModelBase;

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
    registry.registerProperty("penaltyFactor", &create_penalty_factor);
    registry.connect("Yeff", E_, caller.c_str());
    registry.connect("Geff", G_, caller.c_str());
    registry.connect("betaeff", beta_, caller.c_str());
    registry.connect("penaltyFactor", lambda_, caller.c_str());
    print_penalty_factor(lmp, Law::word, Law::exponent, lambda_);
    // coarse-grained particles keep forces/length^2 only where lambda has no dimension
    if (Law::exponent != 1.5 && force->cg_active()) error->cg(FLERR, caller.c_str());
  }

  /// n of F ~ d^n.
  double stressStrainExponent() override { return Law::exponent; }

  // Mirrors the arithmetic of LIGGGHTS' hertz term by term; lambda = 1 changes no bit.
  void surfacesIntersect(IntersectData& contact, ForceData& on_i, ForceData& on_j) override {
    using std::sqrt;
    if (contact.contact_flags) *contact.contact_flags |= LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
    const int i = contact.itype, j = contact.jtype;
    const double r =
        contact.is_wall ? contact.radi : contact.radi * contact.radj / (contact.radi + contact.radj);
    const double d = contact.deltan;
    const double m = contact.meff;
    const double E = E_[i][j], lambda = lambda_[i][j], beta = beta_[i][j];

    const double S_n = lambda * Law::tangent_stiffness(E, r, d);
    const double S_t = 8. * G_[i][j] * sqrt(r * d);
    contact.kn = lambda * Law::secant_stiffness(E, r, d) / force->nktv2p;
    contact.kt = S_t / force->nktv2p;
    contact.gamman = -2. * Law::damping_factor * beta * sqrt(S_n * m);  // beta = -zeta <= 0
    contact.gammat = tangential_damping_ ? -2. * HertzLaw::damping_factor * beta * sqrt(S_t * m) : 0.0;

    contact.Fn = -contact.gamman * contact.vn + contact.kn * d;
    if (limit_force_ && contact.Fn < 0.0) contact.Fn = 0.0;
    apply(contact, on_i, on_j);
  }

  void surfacesClose(CloseData& contact, ForceData&, ForceData&) override {
    if (contact.contact_flags) *contact.contact_flags |= LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
  }

  void beginPass(IntersectData&, ForceData&, ForceData&) override {}
  void endPass(IntersectData&, ForceData&, ForceData&) override {}

 private:
  static void apply(const IntersectData& contact, ForceData& on_i, ForceData& on_j) {
    const double Fn = contact.is_wall ? contact.Fn * contact.area_ratio : contact.Fn;
    for (int k = 0; k < 3; ++k) {
      on_i.delta_F[k] += Fn * contact.en[k];
      if (!contact.is_wall) on_j.delta_F[k] += -on_i.delta_F[k];
    }
  }

  // per pair of atom types, index from 1: E*, G*, beta = -zeta, lambda
  double **E_ = nullptr, **G_ = nullptr, **beta_ = nullptr, **lambda_ = nullptr;
  bool tangential_damping_ = true, limit_force_ = false;
  bool elastic_potential_ = false, dissipated_energy_ = false;
};

}  // namespace liggghts_pkg
