// SPDX-License-Identifier: GPL-2.0-or-later
// `integration: {shear: corrected}`: which patches have a plate's material.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "io/model_file.h"
#include "structure/material/plate_material.h"

namespace {

using io::ModelFile;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

ModelFile model_of(const std::string& geometry, const std::string& law = "linear_elastic",
                   const std::string& shear = "corrected", const std::string& boundary = "") {
  return io::parse_model_file(
      fmt::format(
          "units: si\ngeometry: {{{}}}\nmaterial: {{law: {}, youngs_modulus: 1e9, poissons_ratio: 0.3, "
          "density: 1000}}\nintegration: {{shear: {}}}\n{}",
          geometry, law, shear, boundary),
      "plate.yaml");
}

std::string box(const std::string& origin, const std::string& elements, const std::string& degree = "2") {
  return fmt::format("box: {{origin: {}, size: [1, 1, 0.1], elements: {}, degree: {}}}", origin, elements,
                     degree);
}
const std::string kSingleLayer = box("[0, 0, 0]", "[3, 3, 1]");

bool is_plate(const ModelFile& model, int patch = 0) {
  return structure::has_plate_shear(*model.materials[patch]);
}

TEST(CorrectedShear, IsOfFlatSingleLayers) {
  EXPECT_TRUE(is_plate(model_of(kSingleLayer)));
  EXPECT_TRUE(is_plate(model_of(kSingleLayer, "saint_venant_kirchhoff")));
  EXPECT_TRUE(is_plate(model_of(box("[0, 0, 0]", "[3, 1, 3]", "[3, 2, 3]"))));
  EXPECT_FALSE(is_plate(model_of(kSingleLayer, "neo_hooke", "plain")));
}

// Side by side they are plates; one on the other they are two layers, which need no correction.
TEST(CorrectedShear, LeavesOtherPatchesAsTheyAre) {
  const auto shapes = [](const std::string& second) {
    return model_of(fmt::format("shapes: [{{{}}}, {{{}}}]", kSingleLayer, second));
  };
  const ModelFile beside = shapes(box("[1, 0, 0]", "[3, 3, 1]"));
  EXPECT_TRUE(is_plate(beside) && is_plate(beside, 1));
  EXPECT_EQ(beside.materials[0], beside.materials[1]);
  const ModelFile apart = shapes(box("[3, 0, 0]", "[3, 3, 2]"));
  EXPECT_TRUE(is_plate(apart) && !is_plate(apart, 1));
  EXPECT_THAT([&] { shapes(box("[0, 0, 0.1]", "[3, 3, 1]")); },
              ThrowsMessage<geometry_io::InputError>(HasSubstr("no patch is a single quadratic element")));
}

// What lies on a floor shears evenly in truth; a rim or a bed of springs leaves the plate what it is.
TEST(CorrectedShear, LeavesLayersWhoseSideIsHeld) {
  const auto held = [](const std::string& entry) {
    return model_of(kSingleLayer, "linear_elastic", "corrected", "boundary: [{" + entry + "}]\n");
  };
  for (const char* entry : {"fix: [x, y, z], faces: [xi-, xi+, eta-, eta+]",
                            "name: bed, spring: {stiffness: 1e9, per: area}, faces: [zeta-]",
                            "fix: [z], box: [[0, 0, 0], [0.5, 1, 0]]"})
    EXPECT_TRUE(is_plate(held(entry))) << entry;
  for (const char* entry : {"fix: [x, y, z], faces: [zeta-]", "symmetry: zeta+",
                            "name: base, move: {z: 1e-3}, faces: [zeta-], time: {sine: {frequency: 50}}",
                            "fix: [z], box: [[0, 0, 0], [1, 1, 0]]"})
    EXPECT_THAT([&] { held(entry); },
                ThrowsMessage<geometry_io::InputError>(HasSubstr("with neither side welded or held")))
        << entry;
}

TEST(CorrectedShear, SaysWhyItCannotBe) {
  const auto refused = [](const std::string& geometry, const std::string& law, const std::string& shear,
                          const char* expected) {
    EXPECT_THAT(
        [&] { model_of(geometry, law, shear); },
        ThrowsMessage<geometry_io::InputError>(AllOf(HasSubstr("plate.yaml:4: "), HasSubstr(expected))));
  };
  const char* const none = "no patch is a single quadratic element";
  refused(box("[0, 0, 0]", "[3, 3, 2]"), "linear_elastic", "corrected", none);
  refused(box("[0, 0, 0]", "[3, 3, 1]", "[2, 2, 3]"), "linear_elastic", "corrected", none);
  refused(box("[0, 0, 0]", "[3, 1, 1]"), "linear_elastic", "corrected", none);
  refused(kSingleLayer, "neo_hooke", "corrected",
          "patch 0 has the law 'neo_hooke', expected 'linear_elastic' or");
  refused(kSingleLayer, "linear_elastic", "full", "shear is full, expected one of: plain, corrected");
  refused(
      "tube: {origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 0.4, outer_radius: 0.5, length: 1, angle: "
      "[0, "
      "90], elements: [3, 3, 1]}",
      "linear_elastic", "corrected", "patch 0 is one quadratic element thick and no flat plate");
}

}  // namespace
