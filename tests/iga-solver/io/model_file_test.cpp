// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "../structure/material/standard_linear_solid.h"
#include "io/model_file.h"

namespace {

using io::ModelFile;
using io::Vector3;
using nurbs::Face;
using testing::HasSubstr;

const std::string kPlate = R"(units: si
geometry:
  box: {origin: [-1, -2, -0.5], size: [2, 4, 0.5], elements: [4, 3, 2], degree: 2}
material: {law: linear_elastic, youngs_modulus: 210.6e9, poissons_ratio: 0.286, density: 7850}
boundary:
  - {fix: [x, y, z], faces: [xi-, xi+]}
  - {fix: [z], faces: [zeta-]}
surfaces: {top: zeta+}
probes:
  corner: {face: zeta+, at: [1, 1]}
  below: {face: zeta-, at: [0.5, 0.25]}
output: {every: 1.0e-7, file: plate}
loads:
  gravity: [0, 0, -9.81]
  tractions:
    - {face: zeta+, value: [0, 0, -1000]}
    - {face: eta+, value: [5, 0, 0]}
initial: {velocity: [0, 1, 2]}
time: {end: 1.0e-3, step: 1.0e-6}
)";

TEST(ModelFile, ReadsEveryKey) {
  const ModelFile model = io::parse_model_file(kPlate, "plate.yaml");
  EXPECT_EQ(model.geometry.units, geometry_io::Units::si);
  EXPECT_EQ(model.volume().space.element_count(), 24);
  EXPECT_EQ(model.materials.front()->youngs_modulus(), 210.6e9);
  EXPECT_EQ(model.materials.front()->poissons_ratio(), 0.286);
  EXPECT_EQ(model.materials.front()->density(), 7850);
  ASSERT_EQ(model.boundary.size(), 2u);
  for (int a = 0; a < model.volume().space.control_point_count(); ++a) {
    const int i = a % model.volume().space.control_point_count(0);
    EXPECT_EQ(std::count(model.boundary[0].nodes.begin(), model.boundary[0].nodes.end(), a),
              i == 0 || i == model.volume().space.control_point_count(0) - 1);
  }
  EXPECT_THAT(model.boundary[0].directions, testing::ElementsAre(true, true, true));
  EXPECT_THAT(model.boundary[1].directions, testing::ElementsAre(false, false, true));
  EXPECT_EQ(model.geometry.surfaces.at("top").front().face, Face::zeta_plus);
  ASSERT_EQ(model.probes.size(), 2u);
  EXPECT_EQ(model.probes[0].name, "corner");
  EXPECT_EQ(model.probes[1].name, "below");
  const Vector3 below = model.probes[1].value(model.volume().control_points);
  EXPECT_LT((below - Vector3(0, -1, -0.5)).norm(), 1e-14);
  EXPECT_EQ(model.output->every, 1e-7);
  EXPECT_EQ(model.output->file, "plate");
  EXPECT_EQ(model.loads.gravity->value, Vector3(0, 0, -9.81));
  ASSERT_EQ(model.loads.tractions.size(), 2u);
  EXPECT_EQ(model.loads.tractions[1].piece.face, Face::eta_plus);
  EXPECT_EQ(model.loads.tractions[1].value.field({1, 2, 3}, 4), Vector3(5, 0, 0));
  EXPECT_EQ(model.initial_velocity->field({1, 2, 3}, 0), Vector3(0, 1, 2));
  EXPECT_EQ(model.time->end, 1e-3);
  EXPECT_EQ(model.time->step, 1e-6);
}

TEST(ModelFile, LeavesOutWhatIsOptional) {
  const ModelFile model = io::parse_model_file(kPlate.substr(0, kPlate.find("boundary:")), "plate.yaml");
  EXPECT_TRUE(model.boundary.empty());
  EXPECT_TRUE(model.probes.empty());
  EXPECT_FALSE(model.output || model.time);
  EXPECT_FALSE(model.loads.gravity);
  EXPECT_FALSE(model.initial_velocity);
}

TEST(BuildSolver, HasTheMassSupportsLoadsAndVelocitiesOfTheFile) {
  ModelFile model = io::parse_model_file(kPlate, "plate.yaml");
  structure::ExplicitSolver solver = io::build_solver(model);
  const double mass = 7850.0 * 2 * 4 * 0.5;
  EXPECT_NEAR(solver.mass().nodal_mass().sum(), mass, 1e-9 * mass);
  // 6 x 5 x 4 control points: two faces of 5 x 4 fixed in x, y, z; in z also 6 x 5 of zeta-, 2 x 5 of them
  // fixed already.
  EXPECT_EQ(solver.supports().fixed_dofs().size(), 2u * 5 * 4 * 3 + 6 * 5 - 2 * 5);
  EXPECT_EQ(solver.velocities().row(1).maxCoeff(), 1.0);
  // The work of the loads in a uniform displacement is total force times displacement.
  std::vector<double> state = solver.save();
  for (int A = 0; A < solver.body().node_count(); ++A) state[1 + 3 * A] = 2.0, state[3 + 3 * A] = 1.0;
  solver.load(state);
  const double expected = 2.0 * (5 * 2 * 0.5) + (-9.81 * mass - 1000 * 8);
  EXPECT_NEAR(solver.load_work(), expected, 1e-9 * std::abs(expected));
}

TEST(BuildSolver, NamesTheFileAndTheLineOfALeftHandedGeometry) {
  const std::string text = R"(units: si
geometry:
  patches:
    - degrees: [1, 1, 1]
      knots: [[0, 0, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]]
      control_points: [[0,0,1],[1,0,1],[0,1,1],[1,1,1],[0,0,0],[1,0,0],[0,1,0],[1,1,0]]
material: {law: linear_elastic, youngs_modulus: 1, poissons_ratio: 0, density: 1}
)";
  try {
    io::build_solver(io::parse_model_file(text, "mirrored.yaml"));
    FAIL() << "accepted";
  } catch (const geometry_io::InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("mirrored.yaml:"), HasSubstr("left-handed")));
  }
}

struct BadInput {
  const char* given;        // replaced in kPlate ...
  const char* replacement;  // ... by this
  int line;
  std::vector<const char*> said;
};

TEST(ModelFile, RefusesBadInputInOneLineThatNamesFileLineGivenAndExpected) {
  const std::string long_name = "file: " + std::string(300, 'a');
  const BadInput table[] = {
      {"density: 7850", "density: -7850", 4, {"density", "-7850", "> 0"}},
      {"density: 7850", "density: heavy", 4, {"density", "heavy", "number"}},
      {"density: 7850", "density: 1.1e100", 4, {"density", "1.1e100", "at most 1e+100"}},
      {"210.6e9", "1e300", 4, {"youngs_modulus", "1e300", "at most 1e+100"}},
      {"210.6e9", ".inf", 4, {"youngs_modulus", ".inf"}},
      {"210.6e9", "1e400", 4, {"youngs_modulus", "1e400"}},
      {"gravity: [0, 0, -9.81]", "gravity: [0, 0, -1e101]", 14, {"gravity", "-1e101", "at most 1e+100"}},
      {"value: [0, 0, -1000]", "value: [0, 0, 2e200]", 16, {"value", "2e200", "at most 1e+100"}},
      {"velocity: [0, 1, 2]",
       "velocity: [0, .nan, 2]",
       18,
       {"velocity", ".nan", "expected a number or an expression"}},
      {"velocity: [0, 1, 2]", "velocity: [0, 1e101, 2]", 18, {"velocity", "1e101"}},
      {"end: 1.0e-3", "end: 1e101", 19, {"end", "1e101"}},
      {"every: 1.0e-7", "every: 1e101", 12, {"every", "1e101"}},
      {"size: [2, 4, 0.5]", "size: [2, 1e101, 0.5]", 3, {"size", "1e101"}},
      {"elements: [4, 3, 2]",
       "elements: [100000, 100000, 100]",
       3,
       {"elements [100000, 100000, 100]", "1.02e+12 control points", "24.5 TB", "this process may have"}},
      {"elements: [4, 3, 2]",
       "elements: [1000000, 1000000, 1000000]",
       3,
       {"elements", "this process may have"}},
      {"density: 7850", "densty: 7850", 4, {"densty", "did you mean", "density"}},
      {", density: 7850", "", 4, {"density"}},
      {"0.286", "0.5", 4, {"poissons_ratio", "0.5", "-1"}},
      {"0.286", "-1", 4, {"poissons_ratio", "-1", "0.5"}},
      {"210.6e9", "0", 4, {"youngs_modulus", "0", "> 0"}},
      {"210.6e9", ".nan", 4, {"youngs_modulus"}},
      {"linear_elastic",
       "jelly",
       4,
       {"jelly", "linear_elastic", "saint_venant_kirchhoff", "neo_hooke", "orthotropic_elastic"}},
      {"units: si", "units: imperial", 1, {"imperial", "si", "cgs", "mm-g-ms", "mm-t-s"}},
      {"fix: [z]", "fix: [w]", 7, {"'w'", "x, y, z"}},
      {"fix: [z]", "fix: [z, x, z]", 7, {"fix has 'z' twice", "expected once"}},
      {"fix: [z]", "fix: []", 7, {"fix is empty", "expected some of: x, y, z"}},
      {"{fix: [z],", "{move: {},", 7, {"move is empty", "expected some of x, y, z"}},
      {"faces: [zeta-]", "faces: []", 7, {"faces is empty", "expected some of: xi-, xi+"}},
      {"faces: [zeta-]", "faces: [zeta-], patch: []", 7, {"patch is empty", "expected some of 0 to 0"}},
      {"density: 7850", "density: 1e-320", 4, {"density", "1e-320", "at least 1e-100"}},
      {"file: plate", "file: /", 12, {"file is '/'", "ends with no name"}},
      {"file: plate", "file: out/", 12, {"file is 'out/'", "ends with no name"}},
      {"file: plate", "file: out/..", 12, {"file is 'out/..'", "ends with no name"}},
      {"file: plate", long_name.c_str(), 12, {"file has a name of 300 bytes", "'.h5' and '.part'"}},
      {"faces: [zeta-]", "faces: [bottom]", 7, {"bottom", "zeta-"}},
      {"faces: [zeta-]", "face: [zeta-]", 7, {"face", "did you mean", "faces"}},
      {"face: zeta-", "face: lower", 11, {"lower", "zeta-"}},
      {"at: [0.5, 0.25]", "at: [0.5, 1.25]", 11, {"at", "1.25", "0 to 1"}},
      {"at: [0.5, 0.25]", "at: [0.5]", 11, {"at", "1 numbers", "2"}},
      {"every: 1.0e-7", "every: 0", 12, {"every", "0", "> 0"}},
      {"output:", "outptu:", 12, {"outptu", "did you mean", "output"}},
      {"every: 1.0e-7", "fields: [von_misses], every: 1", 12, {"von_misses", "did you mean 'von_mises'"}},
      {"every: 1.0e-7", "fields: [stress, stress], every: 1", 12, {"'stress' twice"}},
      {"every: 1.0e-7", "fields: {of: [stress]}, every: 1", 12, {"'every' and 'steps'"}},
      {"every: 1.0e-7", "fields: {of: [stress], steps: 0}, every: 1", 12, {"steps", "0"}},
      {"every: 1.0e-7", "fields: {of: [stress], evry: 1}, every: 1", 12, {"evry", "'every'"}},
      {"every: 1.0e-7", "fields: {of: [stress], steps: 1, on: [tpo]}, every: 1", 12, {"tpo", "volume, skin"}},
      {"surfaces: {top: zeta+}\nprobes:\n  corner: {face: zeta+, at: [1, 1]}\n  below: {face: zeta-, at: "
       "[0.5, 0.25]}\n"
       "output: {every: 1.0e-7, file: plate}",
       "surfaces: {skin: zeta+}\n\n\n\noutput: {every: 1, file: a, fields: {of: [stress], steps: 1, on: "
       "[skin]}}",
       12,
       {"'skin', which is the whole skin, and a surface"}},
      {"{fix: [z],", "{nam: a, fix: [z],", 7, {"nam", "did you mean 'name'"}},
      {"{fix: [x, y, z], faces: [xi-, xi+]}\n  - {fix: [z],",
       "{name: a, fix: [x], faces: [xi-]}\n  - {name: a, fix: [z],",
       7,
       {"name 'a' is given twice"}},
      {"{fix: [z],", "{name: a/b, fix: [z],", 7, {"name 'a/b' cannot be that of a data set", "without '/'"}},
      {"{fix: [z],", "{name: \"a\\0b\", fix: [z],", 7, {"cannot be that of a data set"}},
      {"below: {face", "..: {face", 11, {"name '..' cannot be that of a data set"}},
      {"gravity: [0, 0, -9.81]", "gravity: -9.81", 14, {"gravity"}},
      {"face: eta+", "face: theta+", 17, {"theta+", "eta+"}},
      {"velocity: [0, 1, 2]", "speed: 3", 18, {"speed", "velocity"}},
      {"end: 1.0e-3", "end: -1", 19, {"end", "-1", "> 0"}},
      {"step: 1.0e-6", "step: 0", 19, {"step", "0", "> 0"}},
      {"boundary:\n  - {fix: [x, y, z], faces: [xi-, xi+]}\n  -",
       "boundary:\n\n   ",
       5,
       {"boundary", "list"}},
      {"material: {", "material: [", 4, {}},
  };
  for (const BadInput& bad : table) {
    SCOPED_TRACE(std::string(bad.given) + " -> " + bad.replacement);
    std::string text = kPlate;
    const std::size_t at = text.find(bad.given);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(bad.given).size(), bad.replacement);
    try {
      io::parse_model_file(text, "plate.yaml");
      ADD_FAILURE() << "accepted";
    } catch (const geometry_io::InputError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, testing::StartsWith("plate.yaml:" + std::to_string(bad.line) + ":"));
      for (const char* words : bad.said) EXPECT_THAT(message, HasSubstr(words));
      EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
    }
  }
}

/// A viscous law is the key's own doing, not the geometry's.
TEST(ModelFile, TellsWhereDampingByTheStiffnessNeedsOneDegree) {
  const std::string text = R"(units: si
geometry:
  shapes:
    - box: {origin: [0, 0, 0], size: [1, 1, 1], elements: [1, 1, 1], degree: 2}
    - box: {origin: [5, 0, 0], size: [1, 1, 1], elements: [1, 1, 1], degree: 3}
material: {law: linear_elastic, youngs_modulus: 1, poissons_ratio: 0.3, density: 1}
damping:
  mass: 1
  stiffness: 1e-3
)";
  EXPECT_THAT(
      [&] { io::build_solver(io::parse_model_file(text, "two.yaml")); },
      testing::ThrowsMessage<geometry_io::InputError>(testing::AllOf(
          testing::StartsWith("two.yaml:9: damping.stiffness is given where patches 0 and 1 have degrees"),
          HasSubstr("2 2 2 and 3 3 3"))));
}

std::string with_material(const std::string& material) {
  const std::size_t begin = kPlate.find("material:"), end = kPlate.find("boundary:");
  return std::string(kPlate).replace(begin, end - begin, "material: {" + material + "}\n");
}

TEST(ModelFile, ReadsEveryLaw) {
  for (const char* law : {"linear_elastic", "saint_venant_kirchhoff", "neo_hooke"}) {
    const ModelFile model = io::parse_model_file(
        with_material(std::string("law: ") + law + ", youngs_modulus: 2, poissons_ratio: 0.3, density: 7"),
        "a.yaml");
    EXPECT_STREQ(model.materials.front()->law(), law);
    EXPECT_EQ(model.materials.front()->youngs_modulus(), 2.0);
  }
  const std::string nine =
      "law: orthotropic_elastic, E_1: 12, E_2: 0.9, E_3: 0.5, nu_12: 0.4, nu_13: 0.45, nu_23: 0.5, G_12: "
      "0.8, G_13: 0.6, G_23: 0.05, density: 500";
  const ModelFile along = io::parse_model_file(with_material(nine), "a.yaml");
  EXPECT_THAT(along.materials.front()->further_constants(),
              testing::ElementsAre(12, 0.9, 0.5, 0.4, 0.45, 0.5, 0.8, 0.6, 0.05, 1, 0, 0, 0, 1, 0));
  const ModelFile turned = io::parse_model_file(
      with_material(nine + ", direction_1: [0, 0, 2], direction_2: [1, 0, 1]"), "a.yaml");
  structure::Matrix3 H = structure::Matrix3::Zero();
  H(2, 2) = 1e-10;
  EXPECT_GT(turned.materials.front()->stress(H, nullptr)(2, 2), 12e-10) << "axis 1 lies along z";
  for (const auto& [wrong, said] :
       {std::pair{"nu_12: 3.7",
                  "a.yaml:4: orthotropic_elastic: nu_12 is 3.7, expected less than sqrt(E_1 / E_2)"},
        {"nu_21: 0.4", "unknown key 'nu_21' in material, did you mean"},
        {"nu_12: 0.4, direction_1: [0, 1, 0]", "span a plane"}}) {
    std::string text = with_material(nine);
    text.replace(text.find("nu_12: 0.4"), 10, wrong);
    EXPECT_THAT([&] { io::parse_model_file(text, "a.yaml"); },
                testing::ThrowsMessage<geometry_io::InputError>(HasSubstr(said)));
  }
}

TEST(ModelFile, RefusesASurfaceWhereASolidIsNeeded) {
  std::string text = kPlate.substr(0, kPlate.find("boundary:"));
  const std::size_t box = text.find("  box:");
  text.replace(box, text.find("material:") - box,
               "  plane: {origin: [0,0,0], edges: [[1,0,0],[0,1,0]], elements: [1, 1], degree: 1}\n");
  EXPECT_THAT([&] { io::parse_model_file(text, "plane.yaml"); },
              testing::ThrowsMessage<geometry_io::InputError>(
                  testing::AllOf(HasSubstr("plane.yaml:"), HasSubstr("volume"))));
}

TEST(SavedState, OfALawWithoutMemoryIsRefusedByOneThatHasIts) {
  ModelFile elastic = io::parse_model_file(kPlate, "plate.yaml"), other = elastic;
  other.materials = {std::make_shared<test::StandardLinearSolid>(1e9, 0.3, 1000.0, 0.5, 1.0)};
  const io::SavedState state = io::state_of(io::build_solver(elastic));
  structure::ExplicitSolver solver = io::build_solver(other);
  EXPECT_THAT([&] { io::start_from(state, solver); },
              testing::ThrowsMessage<geometry_io::InputError>(testing::AllOf(
                  HasSubstr("has a memory of 0 numbers, expected"),
                  HasSubstr("of the law 'standard_linear_solid'; give the material of then"))));
}

TEST(SavedState, OfOtherKnotsIsRefused) {
  const auto model_of = [](const char* knot, const char* weight) {
    return io::parse_model_file(fmt::format(R"(units: si
geometry:
  patches:
    - degrees: [2, 1, 1]
      knots: [[0, 0, 0, {}, 1, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]]
      control_points: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0], [3, 1, 0],
                       [0, 0, 1], [1, 0, 1], [2, 0, 1], [3, 0, 1], [0, 1, 1], [1, 1, 1], [2, 1, 1], [3, 1, 1]]
      weights: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, {}]
material: {{law: linear_elastic, youngs_modulus: 1e9, poissons_ratio: 0.3, density: 1000}}
)",
                                            knot, weight),
                                "bar.yaml");
  };
  const io::SavedState state = io::state_of(io::build_solver(model_of("0.5", "1")));
  structure::ExplicitSolver same = io::build_solver(model_of("0.5", "1"));
  EXPECT_NO_THROW(io::start_from(state, same));
  for (const auto& [knot, weight] : {std::pair{"0.4", "1"}, std::pair{"0.5", "1.1"}}) {
    structure::ExplicitSolver other = io::build_solver(model_of(knot, weight));
    EXPECT_THAT([&] { io::start_from(state, other); },
                testing::ThrowsMessage<geometry_io::InputError>(HasSubstr("knots or weights are others")));
  }
}

TEST(ModelFile, NamesAFileThatCannotBeRead) {
  for (const char* path : {"no/such/plate.yaml", "/"})
    EXPECT_THAT([&] { io::read_model_file(path); }, testing::ThrowsMessage<geometry_io::InputError>(
                                                        HasSubstr(path + std::string(": cannot read"))));
}

}  // namespace
