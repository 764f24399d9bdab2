// SPDX-License-Identifier: GPL-2.0-or-later
// The parts are what they are called: they survive being written and read, and have the volumes of theory.
#include "parts.h"

#include <gtest/gtest.h>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "occt_judge.h"
#include "read_plainly.h"
#include "write_files.h"

namespace {

using namespace step_parts;

constexpr double kQuadrature = 2e-5;  // of OpenCASCADE's areas, relative: 7e-6 seen on a cut sphere

std::string folder() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string folder = testing::TempDir() + "step_parts_" + test;  // tests run at the same time
  std::filesystem::create_directories(folder);
  return folder;
}

double volume(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

double area(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

TopoDS_Shape written_and_read(const TopoDS_Shape& shape, const Part& part) {
  const std::string path = folder() + "/" + part.file;
  write(part, shape, path);
  return read_plainly(path);
}

/// Also in inches, metres and IGES.
void survive(const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    SCOPED_TRACE(part.file);
    const TopoDS_Shape before = part.shape(), after = written_and_read(before, part);
    EXPECT_TRUE(BRepCheck_Analyzer(after).IsValid());
    EXPECT_NEAR(area(after) / area(before), 1.0, kQuadrature);
  }
}

TEST(Parts, TrimmedOnesSurvive) { survive(trimmed_parts()); }
TEST(Parts, SplinesSurvive) { survive(spline_parts()); }
TEST(Parts, BlendsSurvive) { survive(blended_parts()); }
TEST(Parts, BordersSurvive) { survive(border_parts()); }

TEST(Parts, VolumesOfTheory) {
  const double cylinder = M_PI * 900.0 * 80.0;
  const std::map<std::string, double> theory = {
      {"box.step", 240000.0},
      {"cylinder.step", cylinder},
      {"cylinder_2.step", cylinder},
      {"cylinder_4.step", cylinder},
      {"cylinder_8.step", cylinder},
      {"cone.step", M_PI * 1600.0 * 60.0 / 3.0},
      {"frustum.step", M_PI * 60.0 / 3.0 * (1600.0 + 600.0 + 225.0)},
      {"frustum.igs", M_PI * 60.0 / 3.0 * (1600.0 + 600.0 + 225.0)},
      {"sphere.step", 4.0 / 3.0 * M_PI * 64000.0},
      {"torus.step", 2.0 * M_PI * M_PI * 50.0 * 225.0}};
  for (const Part& part : closed_form_parts()) {
    SCOPED_TRACE(part.file);
    const TopoDS_Shape shape = written_and_read(part.shape(), part);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    EXPECT_NEAR(volume(shape) / theory.at(part.file), 1.0, 1e-6);
  }
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(Parts, NestedAssemblyHasItsNames) {
  write(assemblies()[0], folder());
  const std::string file = folder() + "/nested.step", text = text_of(file);
  for (const char* name :
       {"'frame'", "'leg'", "'left leg'", "'right leg'", "ADVANCED_FACE('sole'", "ADVANCED_FACE('top'"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(count(text, "MANIFOLD_SOLID_BREP("), 3);  // each once, whatever its places
  const double post = M_PI * 64.0 * 100.0, foot = 40.0 * 30.0 * 6.0, plate = 160.0 * 80.0 * 10.0;
  EXPECT_NEAR(volume(read_plainly(file)), 2.0 * (post + foot) + plate, 0.1);
}

TEST(Parts, FilesSayTheirProtocol) {
  const std::map<std::string, std::string> schemas = {
      {"inches.step", "AUTOMOTIVE_DESIGN"},
      {"ap203.step", "CONFIG_CONTROL_DESIGN"},
      {"ap242.step", "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING"}};
  for (const Part& part : trimmed_parts()) {
    const auto schema = schemas.find(part.file);
    if (schema == schemas.end()) continue;
    write(part, folder());
    const std::string text = text_of(folder() + "/" + part.file);
    EXPECT_NE(text.find("'" + schema->second), std::string::npos) << part.file;
  }
}

/// The file of the deck.  A ring with holes by theory; the rest by names.
TEST(Parts, HopperOfTheDeck) {
  const std::string file = HOPPER_STEP, text = text_of(file);
  for (const char* name : {"cone", "knuckle", "cylinder", "spout", "pipe", "cap", "root", "floor"}) {
    EXPECT_EQ(count(text, std::string("ADVANCED_FACE('") + name + "'"), 1) << name;
  }
  const TopoDS_Shape shape = read_plainly(file);
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
}

/// Corners on the faces, and no triangle's middle further off than the chord may be.
TEST(Parts, TrianglesLieNearTheHopper) {
  const double deviation = 1.0, single_precision = 1e-4;  // mm
  const std::string file = folder() + "/hopper.stl";
  write_stl(HOPPER_STEP, deviation, file);
  const std::string bytes = text_of(file);
  const std::size_t count = (bytes.size() - 84) / 50;
  ASSERT_GT(count, 1000u);
  const OcctJudge judge(HOPPER_STEP);
  for (std::size_t i = 0; i < count; i += 40) {
    std::array<float, 9> x;
    std::memcpy(x.data(), bytes.data() + 84 + 50 * i + 12, sizeof x);
    EXPECT_LT(judge.nearest({x[0], x[1], x[2]}).distance, single_precision + judge.tolerance());
    EXPECT_LT(judge.nearest({(x[0] + x[3] + x[6]) / 3, (x[1] + x[4] + x[7]) / 3, (x[2] + x[5] + x[8]) / 3})
                  .distance,
              deviation);
  }
}

}  // namespace
