// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_words.h"

#include <gmock/gmock.h>

#include <sstream>
#include <stdexcept>

#include "utils.h"

namespace {

using liggghts_pkg::check_contact_models;
using liggghts_pkg::ModelKind;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> split(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// What the check says about a fix's words; "" if it accepts them.
std::string complaint(const std::string& words) {
  try {
    check_contact_models(split(words));
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "";
}

TEST(ModelWords, CountsTheWordsOfTheModels) {
  EXPECT_EQ(check_contact_models(split("model hertz")), 2u);
  EXPECT_EQ(check_contact_models(split("model hertz type 2 geometry g.yaml surface top")), 2u);
  EXPECT_EQ(check_contact_models(split("model penalty/linear tangential no_history type 2")), 4u);
  EXPECT_EQ(check_contact_models(split("model hooke rolling_friction cdt limitForce on")), 4u);
  EXPECT_EQ(check_contact_models(split("model hertz tangential history cohesion sjkr rolling_friction epsd2 "
                                       "surface default type 2")),
            10u);
  EXPECT_EQ(check_contact_models(split("model hertz cohesion washino/capillary/viscous type 2")), 4u);
  EXPECT_EQ(check_contact_models(split("model luding tangential tan_luding rolling_friction luding type 2")),
            6u);
}

TEST(ModelWords, OrderIsThatOfLiggghts) {
  // the word out of order is left over, for the fix to complain about
  EXPECT_EQ(check_contact_models(split("model hertz cohesion sjkr tangential history")), 4u);
}

TEST(ModelWords, UnknownModelsAreNamedWithTheKnownOnes) {
  EXPECT_THAT(complaint("model herz tangential history"),
              AllOf(HasSubstr("unknown contact model 'herz'"), HasSubstr("did you mean 'hertz'?"),
                    HasSubstr("hooke/stiffness"), HasSubstr("penalty/quadratic")));
  EXPECT_THAT(complaint("model penalty/lineer"), HasSubstr("did you mean 'penalty/linear'?"));
  EXPECT_THAT(
      complaint("model hertz tangential histroy"),
      AllOf(HasSubstr("unknown tangential model 'histroy' (did you mean 'history'?), expected one of off, "),
            HasSubstr("no_history")));
  EXPECT_THAT(complaint("model hertz cohesion glue"), HasSubstr("unknown cohesion model 'glue'"));
  EXPECT_THAT(complaint("model hertz rolling_friction epsd9"),
              HasSubstr("unknown rolling_friction model 'epsd9'"));
  EXPECT_EQ(check_contact_models(split("model hertz surface top")), 2u) << "that is the wall's";
}

TEST(ModelWords, MissingWords) {
  EXPECT_THAT(complaint(""), HasSubstr("first comes 'nothing', expected 'model NORMAL'"));
  EXPECT_THAT(complaint("type 2"), HasSubstr("first comes 'type'"));
  EXPECT_THAT(complaint("model"), HasSubstr("'model' is the last word"));
  EXPECT_THAT(complaint("model hertz tangential"), HasSubstr("'tangential' is the last word"));
}

TEST(ModelWords, RefusesWhatReadsOutOfBoundsWithoutATriangleMesh) {
  EXPECT_THAT(complaint("model hertz surface multicontact"),
              HasSubstr("'multicontact' needs a triangle mesh"));
  EXPECT_THAT(complaint("model hertz surface superquadric"), HasSubstr("'superquadric' needs"));
  EXPECT_THAT(complaint("model hertz cohesion easo/capillary/viscous"), HasSubstr("needs a triangle mesh"));
  EXPECT_THAT(complaint("model hertz tangential tan_luding"),
              HasSubstr("needs model 'luding', given 'hertz'"));
  EXPECT_THAT(complaint("model hooke rolling_friction luding"),
              HasSubstr("needs model 'luding', given 'hooke'"));
  EXPECT_THAT(complaint("model off tangential history"), HasSubstr("model 'off'"));
}

TEST(ModelWords, PairsMayHaveWhatWallsMayNot) {
  liggghts_pkg::ModelChoice models;
  models.normal = "penalty/hertz";
  models.cohesion = "easo/capillary/viscous";
  EXPECT_EQ(liggghts_pkg::why_refused(models, false), "");
  EXPECT_NE(liggghts_pkg::why_refused(models, true), "");
}

TEST(ModelWords, SettingsThatNeedAMesh) {
  using liggghts_pkg::check_model_settings;
  EXPECT_NO_THROW(check_model_settings(split("limitForce on tangential_damping off")));
  EXPECT_NO_THROW(check_model_settings(split("computeElasticPotential off computeDissipatedEnergy off")));
  EXPECT_THROW(check_model_settings(split("limitForce on computeElasticPotential on")),
               std::invalid_argument);
  EXPECT_THROW(check_model_settings(split("computeDissipatedEnergy on")), std::invalid_argument);
}

TEST(ModelWords, HashLeadsBackToTheWords) {
  for (const auto& normal : liggghts_pkg::known_models(ModelKind::normal))
    for (const auto& tangential : liggghts_pkg::known_models(ModelKind::tangential))
      for (const auto& cohesion : liggghts_pkg::known_models(ModelKind::cohesion))
        for (const auto& rolling : liggghts_pkg::known_models(ModelKind::rolling))
          for (const auto& surface : liggghts_pkg::known_models(ModelKind::surface)) {
            const auto models = liggghts_pkg::model_choice(LIGGGHTS::Utils::generate_gran_hashcode(
                normal.id, tangential.id, cohesion.id, rolling.id, surface.id));
            EXPECT_EQ(models.normal, normal.word);
            EXPECT_EQ(models.tangential, tangential.word);
            EXPECT_EQ(models.cohesion, cohesion.word);
            EXPECT_EQ(models.rolling, rolling.word);
            EXPECT_EQ(models.surface, surface.word);
          }
  EXPECT_THROW(liggghts_pkg::model_choice(63), std::invalid_argument);
}

}  // namespace
