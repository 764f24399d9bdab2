// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/geometry_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace geometry_io {
namespace {

using namespace nurbs;

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

GeometryFile parsed(const std::string& text) { return parse_geometry_file(text, "wall.yaml"); }

OrientedSurface the_patch(const GeometryFile& file, const std::string& name) {
  std::vector<OrientedSurface> patches = named_surface(file, name, "wall.yaml");
  EXPECT_EQ(patches.size(), 1u);
  return patches.front();
}

const std::string kBox =
    "units: si\ngeometry:\n  box: {origin: [0, 0, -1], size: [2, 3, 1], elements: [4, 3, 2], degree: [2, 3, "
    "1]}\nsurfaces: {top: zeta+, side: xi-}\n";

const std::string kPlane =
    "units: mm-g-ms\ngeometry:\n  plane: {origin: [1, 0, 0], edges: [[2, 0, 0], [0, 4, 0]], breaks: [[0, "
    "0.25, 1], [0, 1]], degree: 2}\nsurfaces: {floor: all}\n";

const std::string kPatch =
    "units: cgs\ngeometry:\n  patches:\n    - degrees: [2, 1]\n      knots: [[0, 0, 0, 1, 1, 1], [0, 0, 1, "
    "1]]\n      control_points: [[1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 2], [1, 1, 2], [0, 1, 2]]\n      "
    "weights: [1, 0.7071067811865476, 1, 1, 0.7071067811865476, 1]\nsurfaces: {quarter: all}\n";

TEST(GeometryFile, Box) {
  const GeometryFile file = parsed(kBox);
  EXPECT_EQ(file.units, Units::si);
  const Volume& volume = std::get<Volume>(file.patches.front());
  EXPECT_EQ(volume.space.element_count(), 24);
  EXPECT_EQ(volume.space.degree(1), 3);
  EXPECT_NEAR(
      (interpolate(volume.space, volume.control_points, {0.5, 0.5, 0.5}) - Vector3(1, 1.5, -0.5)).norm(), 0.0,
      1e-15);
  const OrientedSurface top = the_patch(file, "top");
  EXPECT_EQ(top.outward_sign, 1);
  EXPECT_NEAR(
      (interpolate(top.surface.space, top.surface.control_points, {0.25, 1.0}) - Vector3(0.5, 3, 0)).norm(),
      0.0, 1e-15);
  const OrientedSurface side = the_patch(file, "side");
  EXPECT_EQ(side.outward_sign, -1);
  EXPECT_NEAR(
      (interpolate(side.surface.space, side.surface.control_points, {1.0, 0.0}) - Vector3(0, 3, -1)).norm(),
      0.0, 1e-15);
}

TEST(GeometryFile, GradedPlane) {
  const GeometryFile file = parsed(kPlane);
  EXPECT_STREQ(units_name(file.units), "mm-g-ms");
  const OrientedSurface floor = the_patch(file, "floor");
  EXPECT_EQ(floor.outward_sign, 0);
  EXPECT_EQ(floor.surface.space.knots(0).breaks(), (std::vector<double>{0, 0.25, 1}));
  EXPECT_NEAR(
      (interpolate(floor.surface.space, floor.surface.control_points, {0.25, 0.5}) - Vector3(1.5, 2, 0))
          .norm(),
      0.0, 1e-15);
}

TEST(GeometryFile, PatchIsAnExactQuarterCircle) {
  const OrientedSurface quarter = the_patch(parsed(kPatch), "quarter");
  for (double xi : {0.0, 0.2, 0.5, 0.9})
    EXPECT_NEAR(
        interpolate(quarter.surface.space, quarter.surface.control_points, {xi, 0.3}).head<2>().norm(), 1.0,
        1e-15);
}

TEST(GeometryFile, VolumePatch) {
  const GeometryFile file = parsed(
      "units: si\ngeometry:\n  patches:\n    - degrees: [1, 1, 1]\n      knots: [[0, 0, 1, 1], [0, 0, 1, 1], "
      "[0, 0, 1, 1]]\n      control_points: "
      "[[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1]]\nsurfaces: {bottom: zeta-}\n");
  EXPECT_EQ(std::get<Volume>(file.patches.front()).space.element_count(), 1);
  EXPECT_EQ(the_patch(file, "bottom").outward_sign, -1);
}

// ------------------------------------------------------------------------------------------ several patches

// Two squares side by side, and a cube beside them.
const std::string kPatches =
    "units: si\ngeometry:\n  patches:\n    - {degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]],\n       "
    "control_points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}\n    - {degrees: [1, 1], knots: [[0, 0, "
    "1, 1], [0, 0, 1, 1]],\n       control_points: [[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0]]}\n    - "
    "{degrees: [1, 1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]],\n       control_points: "
    "[[3,0,0],[4,0,0],[3,1,0],[4,1,0],[3,0,1],[4,0,1],[3,1,1],[4,1,1]]}\nsurfaces: {floor: [0, 1], second: "
    "1, mixed: [2 zeta-, 1, 2 xi+]}\n";

TEST(GeometryFile, SurfacesOfSeveralPatches) {
  const GeometryFile file = parsed(kPatches);
  EXPECT_EQ(file.patches.size(), 3u);
  const std::vector<OrientedSurface> floor = named_surface(file, "floor", ""),
                                     mixed = named_surface(file, "mixed", "");
  ASSERT_EQ(floor.size(), 2u);
  EXPECT_EQ(floor[1].surface.control_points.col(1), Vector3(2, 0, 0));
  EXPECT_EQ(the_patch(file, "second").surface.control_points, floor[1].surface.control_points);
  ASSERT_EQ(mixed.size(), 3u);
  EXPECT_EQ(mixed[0].outward_sign, -1);
  EXPECT_EQ(mixed[0].surface.control_points.col(3), Vector3(4, 1, 0));
  EXPECT_EQ(mixed[1].outward_sign, 0);
  EXPECT_EQ(mixed[2].outward_sign, 1);
  EXPECT_EQ(mixed[2].surface.control_points.col(1), Vector3(4, 1, 0));
}

TEST(GeometryFile, WordsOfASurfaceSayWhatTheyWereReadFrom) {
  const std::vector<Shape> three = parsed(kPatches).patches, two(three.begin(), three.begin() + 2),
                           box = parsed(kBox).patches;
  using Words = std::vector<std::string>;
  const auto again = [](const Words& words, const std::vector<Shape>& patches) {
    return surface_words(parse_surface(words, patches), patches);
  };
  EXPECT_EQ(again({"all"}, two), Words{"all"});
  EXPECT_EQ(again({"0", "1"}, two), Words{"all"});
  EXPECT_EQ(again({"1", "0"}, two), (Words{"1", "0"}));
  EXPECT_EQ(again({"1"}, two), Words{"1"});
  EXPECT_EQ(again({"2 eta-", "0"}, three), (Words{"2 eta-", "0"}));
  EXPECT_EQ(again({"0 zeta+"}, box), Words{"zeta+"});
  EXPECT_EQ(again({"zeta+", "xi-"}, box), (Words{"0 zeta+", "0 xi-"}));
}

GeometryFile open_box(const std::string& path, Units units) {
  EXPECT_EQ(path, "models/drums/box.any");
  EXPECT_EQ(units, Units::cgs);
  return parsed(kBox);
}

TEST(GeometryFile, NamesAnotherFileThatIsRelativeToIt) {
  const std::string text = "units: cgs\ngeometry: {file: drums/box.any}\nsurfaces: {end: eta+}\n";
  const GeometryFile file = parse_geometry_file(text, "models/wall.yaml", open_box);
  EXPECT_EQ(file.surfaces.size(), 3u);
  EXPECT_EQ(file.surfaces.at("end").front(), (SurfacePiece{0, Face::eta_plus}));
}

// ------------------------------------------------------------------------------------------------ round
// shapes

std::string with_shape(const std::string& shape) {
  return "units: si\ngeometry:\n  " + shape + "\nsurfaces: {wall: all}\n";
}

const std::string kCylinder =
    with_shape("cylinder: {origin: [1, 0, 0], axis: [0, 2, 0], radius: 3, length: 5, elements: [8, 4]}");
const std::string kCone = with_shape(
    "cone: {origin: [0, 0, 1], axis: [0, 0, -1], reference: [0, 1, 0], radii: [2, 0], length: 4,\n"
    "    angle: [0, 90], elements: [3, 2], degree: [3, 1]}");
const std::string kSphere = with_shape(
    "sphere: {centre: [0, 0, 0], radius: 2, latitude: [-90, 0], longitude: [0, 180], elements: [4, 2]}");
const std::string kTorus = with_shape(
    "torus: {centre: [0, 0, 0], axis: [0, 0, 1], radius: 3, tube_radius: 1, angle: [0, 90],\n"
    "    tube_angle: [90, 180], elements: [2, 2]}");
const std::string kTube =
    "units: si\ngeometry:\n"
    "  tube: {origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 1, outer_radius: 2, length: 3,\n"
    "    angle: [0, 90], elements: [4, 3, 2]}\nsurfaces: {bore: zeta-, skin: zeta+, end: eta+}\n";

Vector3 point(const OrientedSurface& named, const Parameter<2>& xi) {
  return interpolate(named.surface.space, named.surface.control_points, xi);
}
OrientedSurface wall_of(const std::string& text) { return the_patch(parsed(text), "wall"); }

TEST(GeometryFile, Cylinder) {
  const OrientedSurface wall = wall_of(kCylinder);  // axis y, so angles count from z towards x
  EXPECT_EQ(wall.outward_sign, 0);
  EXPECT_EQ(wall.surface.space.degree(0), 2);
  EXPECT_EQ(wall.surface.space.degree(1), 2);
  EXPECT_EQ(wall.surface.space.element_count(), 32);
  EXPECT_NEAR((point(wall, {0.0, 0.4}) - Vector3(1, 2, 3)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(wall, {0.25, 1.0}) - Vector3(4, 5, 0)).norm(), 0.0, 1e-14);
}

TEST(GeometryFile, Cone) {
  const OrientedSurface wall = wall_of(kCone);  // downwards, so angles count from y towards x
  EXPECT_EQ(wall.surface.space.degree(0), 3);
  EXPECT_EQ(wall.surface.space.degree(1), 1);
  EXPECT_NEAR((point(wall, {0.0, 0.0}) - Vector3(0, 2, 1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(wall, {1.0, 0.5}) - Vector3(1, 0, -1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(wall, {0.3, 1.0}) - Vector3(0, 0, -3)).norm(), 0.0, 1e-14);
}

TEST(GeometryFile, Sphere) {
  const OrientedSurface wall = wall_of(kSphere);
  EXPECT_NEAR((point(wall, {0.5, 1.0}) - Vector3(0, 2, 0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(wall, {0.0, 0.5}) - Vector3(1, 0, -1) * std::sqrt(2)).norm(), 0.0, 1e-14);
  const OrientedSurface whole =
      wall_of(with_shape("sphere: {centre: [0, 0, 0], axis: [1, 0, 0], radius: 2, elements: [4, 2]}"));
  EXPECT_NEAR((point(whole, {0.6, 0.0}) - Vector3(-2, 0, 0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(whole, {0.25, 0.5}) - Vector3(0, 0, 2)).norm(), 0.0, 1e-14);
}

TEST(GeometryFile, Torus) {
  const OrientedSurface wall = wall_of(kTorus);
  EXPECT_NEAR((point(wall, {0.0, 0.0}) - Vector3(3, 0, 1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(wall, {1.0, 1.0}) - Vector3(0, 2, 0)).norm(), 0.0, 1e-14);
}

TEST(GeometryFile, Tube) {
  const GeometryFile file = parsed(kTube);
  EXPECT_EQ(std::get<Volume>(file.patches.front()).space.element_indices(23), (Indices<3>{3, 2, 1}));
  const OrientedSurface bore = the_patch(file, "bore"), skin = the_patch(file, "skin");
  EXPECT_EQ(bore.outward_sign, -1);
  EXPECT_EQ(skin.outward_sign, 1);
  EXPECT_NEAR((point(bore, {0.0, 0.5}) - Vector3(1, 0, 1.5)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((point(skin, {1.0, 0.5}) - Vector3(0, 2, 1.5)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(point(the_patch(file, "end"), {0.7, 0.5}).z(), 3.0, 1e-14);
}

TEST(GeometryFile, ModelFilesMayHaveOtherKeys) {
  const YamlMap document = YamlMap::parse(kBox + "material: {law: linear_elastic}\n", "model.yaml");
  EXPECT_EQ(read_geometry(document).surfaces.size(), 2u);
  EXPECT_THROW(parse_geometry_file(kBox + "material: {law: linear_elastic}\n", "wall.yaml"), InputError);
}

// A good file with one thing changed, and the complaint.
struct BadFile {
  std::string good, from, to, place, message;
};

TEST(GeometryFile, SaysWhatWasGivenAndWhatWasExpected) {
  const std::vector<BadFile> table = {
      {kBox, "units: si\n", "", "wall.yaml:1: ", "units is missing"},
      {kBox, "units: si", "units: inch",
       "wall.yaml:1: ", "units is inch, expected one of: si, cgs, mm-g-ms, mm-t-s"},
      {kBox, "geometry:", "geometri:", "wall.yaml:2: ", "unknown key 'geometri', did you mean 'geometry'?"},
      {kBox, "box:", "bix:", "wall.yaml:3: ", "unknown key 'bix' in geometry, did you mean 'box'?"},
      {kBox, "size:", "sise:", "wall.yaml:3: ", "unknown key 'sise' in geometry.box, did you mean 'size'?"},
      {kBox, "origin: [0, 0, -1], ", "", "wall.yaml:3: ", "geometry.box.origin is missing"},
      {kBox, "origin: [0, 0, -1]", "origin: [0, 0, .inf]",
       "wall.yaml:3: ", "geometry.box.origin is .inf, expected a finite number"},
      {kBox, "[2, 3, 1]", "[2, 0, 1]", "wall.yaml:3: ", "size is [2, 0, 1], expected 3 numbers > 0"},
      {kBox, "[2, 3, 1]", "[2, 3, -1]", "wall.yaml:3: ", "size is [2, 3, -1], expected 3 numbers > 0"},
      {kBox, "[4, 3, 2]", "[4, 0, 2]", "wall.yaml:3: ", "elements is 0, expected a whole number from 1 to"},
      {kBox, "[4, 3, 2]", "[4, 3]", "wall.yaml:3: ", "elements is a list of 2, expected 3"},
      {kBox, "degree: [2, 3, 1]", "degree: 7",
       "wall.yaml:3: ", "degree is 7, expected a whole number from 1 to 6"},
      {kBox, "degree: [2, 3, 1]", "degree: [2, 0, 1]",
       "wall.yaml:3: ", "degree is 0, expected a whole number from 1"},
      {kBox, "degree: [2, 3, 1]", "degree: [2, 3]", "wall.yaml:3: ", "degree is a list of 2, expected 3"},
      {kBox,
       "degree:", "breaks: [[0, 1], [0, 1], [0, 1]], degree:", "wall.yaml:3: ", "'elements' and 'breaks'"},
      {kBox, "elements: [4, 3, 2], ", "", "wall.yaml:3: ", "'elements' and 'breaks'"},
      {kBox, "zeta+", "top",
       "wall.yaml:4: ", "surfaces.top: unknown face 'top', expected xi-, xi+, eta-, eta+, zeta- or zeta+"},
      {kBox, "side: xi-", "\"s\\nt\": top", "wall.yaml:4: ", "surfaces.s t: unknown face 'top'"},
      {kBox, "side:", "top:", "wall.yaml:4: ", "surfaces.top is given twice, expected once"},
      {kBox, "surfaces: {top: zeta+, side: xi-}", "surfaces: zeta+",
       "wall.yaml:4: ", "surfaces is zeta+, expected a mapping"},
      {kBox, "units: si\n", "units: si\nunits: cgs\n",
       "wall.yaml:2: ", "units is given twice, expected once"},
      {kPlane, "[0, 4, 0]", "[4, 0, 0]",
       "wall.yaml:3: ", "are zero or parallel, expected two different directions"},
      {kPlane, "[0, 4, 0]", "[0, 0, 0]", "wall.yaml:3: ", "are zero or parallel"},
      {kPlane, "[0, 4, 0]", "[0, 4]", "wall.yaml:3: ", "edge of 2 numbers, expected 3"},
      {kPlane, ", [0, 4, 0]", "", "wall.yaml:3: ", "edges is a list of 1, expected 2"},
      {kPlane, "[0, 0.25, 1]", "[0, 0.25, 2]", "wall.yaml:3: ", "expected a list from 0 to 1"},
      {kPlane, "[0, 0.25, 1]", "[0, 0.5, 0.5, 1]", "wall.yaml:3: ", "expected strictly increasing ones"},
      {kPlane, "floor: all", "floor: xi-",
       "wall.yaml:4: ", "unknown face 'xi-' of a surface patch, expected all"},
      {kPatch, "[0, 0, 0, 1, 1, 1]", "[0, 0, 0.5, 1, 1, 1]", "wall.yaml:5: ",
       "knots of direction 1: knot vector is not open: first knot 2 times and last knot 3 times"},
      {kPatch, "[0, 0, 1, 1]", "[0, 0, 1, 0.5]",
       "wall.yaml:5: ", "knots of direction 2: knot 4 is 0.5 after 1"},
      {kPatch, "[0, 0, 1, 1]]", "[0, 0, 0.5, 0.5, 1, 1]]",
       "wall.yaml:5: ", "interior knot 0.5 stands 2 times, degree 1 expects at most 1 times"},
      {kPatch, "[0, 0, 0, 1, 1, 1]", "[0, 0, 0, .nan, 1, 1, 1]",
       "wall.yaml:5: ", "is .nan, expected a finite number"},
      {kPatch, ", [0, 0, 1, 1]]", "]", "wall.yaml:5: ", "knots is a list of 1, expected 2"},
      {kPatch, ", [0, 1, 2]]", "]", "wall.yaml:6: ", "5 control points given, expected 6"},
      {kPatch, "[0, 1, 2]]", "[0, 1]]", "wall.yaml:6: ", "control point 6 has 2 coordinates, expected 3"},
      {kPatch, "[1, 1, 2]", "[1, x, 2]", "wall.yaml:6: ", "control_points[4] is x, expected a finite number"},
      {kPatch, ", 1]\nsurfaces", "]\nsurfaces", "wall.yaml:7: ", "5 weights given, expected 6"},
      {kPatch, "weights: [1,", "weights: [0,", "wall.yaml:7: ", "weight 1 is 0, expected a number > 0"},
      {kPatch, "weights: [1,", "weights: [-1,", "wall.yaml:7: ", "weight 1 is -1, expected a number > 0"},
      {kPatch, "degrees: [2, 1]", "degrees: [2]",
       "wall.yaml:4: ", "degrees is a list of 1, expected 2 (a surface) or 3"},
      {kPatch, "degrees: [2, 1]", "degrees: [2, 0]",
       "wall.yaml:4: ", "is 0, expected a whole number from 1 to 16"},
      {kPatch, "surfaces", "    - {}\n    - {}\nsurfaces",
       "wall.yaml:8: ", "geometry.patches[1].degrees is missing"},
      {kPatches, "mixed: [2 zeta-", "mixed: [3 zeta-",
       "wall.yaml:10: ", "surfaces.mixed: patch is '3', expected a number from 0 to 2"},
      {kPatches, "floor: [0, 1]", "floor: all", "wall.yaml:10: ", "'all', but patch 2 is a volume"},
      {kPatches, "floor: [0, 1]", "floor: [0, 0]", "wall.yaml:10: ", "patch 0 is named twice, expected once"},
      {kPatches, "floor: [0, 1]", "floor: [0, 2]",
       "wall.yaml:10: ", "patch 2 is a volume, expected '2 FACE'"},
      {kPatches, "floor: [0, 1]", "floor: []", "wall.yaml:10: ", "the list is empty"},
      {kPatches, "floor: [0, 1]", "floor: zeta-", "wall.yaml:10: ", "'zeta-', but there are 3 patches"},
      {kPatches, "floor: [0, 1]", "floor: 1 xi-", "wall.yaml:10: ", "'xi-' of patch 1, which is a surface"},
      {kPatches, "2 xi+", "2 top", "wall.yaml:10: ", "unknown face 'top', expected xi-, xi+"},
      {kBox, "zeta+", "all", "wall.yaml:4: ", "'all' of a volume, expected xi-, xi+"},
      {"units: si\ngeometry: {patches: []}\n", "[]", "[]",
       "wall.yaml:2: ", "patches is empty, expected one patch at least"},
      {"units: si\ngeometry: {file: a.h5}\n", "a.h5", "a.h5",
       "wall.yaml:2: ", "geometry.file is a.h5 in a file that is itself read for another one"},
      {kPatch, "geometry:\n", "geometry:\n  box: {}\n",
       "wall.yaml:3: ", "2 geometries given, expected one of"},
      {kPatch, "degrees: [2, 1]", "degrees: [2, 1", "wall.yaml:", "broken YAML"},
      {kCylinder, "cylinder:", "cylindre:", "wall.yaml:3: ", "did you mean 'cylinder'?"},
      {kCylinder,
       "radius:", "radios:", "wall.yaml:3: ", "unknown key 'radios' in geometry.cylinder, did you"},
      {kCylinder, "radius: 3, ", "", "wall.yaml:3: ", "geometry.cylinder.radius is missing"},
      {kCylinder, "radius: 3", "radius: -3", "wall.yaml:3: ", "radius is -3, expected a number > 0"},
      {kCylinder, "length: 5", "length: 0", "wall.yaml:3: ", "length is 0, expected a number > 0"},
      {kCylinder, "[0, 2, 0]", "[0, 0, 0]", "wall.yaml:3: ", "axis is [0, 0, 0], expected a direction"},
      {kCylinder, "[0, 2, 0]", "[0, 2]", "wall.yaml:3: ", "axis is a list of 2, expected 3 numbers"},
      {kCylinder, "axis: [0, 2, 0], ", "", "wall.yaml:3: ", "geometry.cylinder.axis is missing"},
      {kCylinder, "[8, 4]", "[6, 4]",
       "wall.yaml:3: ", "angle: 6 elements on a curve of 4 pieces, expected a multiple of 4"},
      {kCylinder, "[8, 4]", "[8]", "wall.yaml:3: ", "elements is a list of 1, expected 2"},
      {kCylinder, "elements:", "breaks:", "wall.yaml:3: ", "unknown key 'breaks' in geometry.cylinder"},
      {kCylinder, "[8, 4]", "[8, 4], degree: 1", "wall.yaml:3: ", "degree of an arc is 1, expected 2 to 16"},
      {kCone, "[2, 0]", "[0, 0]", "wall.yaml:3: ", "radii are [0, 0], expected numbers >= 0, not both 0"},
      {kCone, "[2, 0]", "[2]", "wall.yaml:3: ", "radii is a list of 1, expected 2"},
      {kCone, "[0, 1, 0]", "[0, 0, 3]",
       "wall.yaml:3: ", "reference is [0, 0, 3], expected a direction other than the axis [0, 0, -1]"},
      {kCone, "[0, 90]", "[90, 0]",
       "wall.yaml:4: ", "angle: angles are [90, 0], expected [from, to] in degrees with from < to"},
      {kCone, "[0, 90]", "[0, 90, 180]", "wall.yaml:4: ", "angle is a list of 3, expected 2"},
      {kCone, "[0, 90]", "90", "wall.yaml:4: ", "geometry.cone.angle is 90, expected a list of numbers"},
      {kSphere, "[-90, 0]", "[-100, 0]",
       "wall.yaml:3: ", "latitude goes over a pole, expected angles from -90 to 90"},
      {kSphere, "[0, 180]", "[0, 400]", "wall.yaml:3: ", "longitude: angles are [0, 400], expected"},
      {kTorus, "tube_radius: 1", "tube_radius: 3",
       "wall.yaml:3: ", "radius is 3, expected more than tube_radius 3"},
      {kTube, "inner_radius: 1", "inner_radius: 2",
       "wall.yaml:3: ", "outer_radius is 2, expected more than inner_radius 2"},
      {kTube, "[4, 3, 2]", "[4, 3]", "wall.yaml:4: ", "elements is a list of 2, expected 3"},
  };
  for (const BadFile& bad : table) {
    std::string text = bad.good;
    const size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos) << bad.from;
    text.replace(at, bad.from.size(), bad.to);
    SCOPED_TRACE(text);
    try {
      parsed(text);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(bad.place));
      EXPECT_THAT(error.what(), HasSubstr(bad.message));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(GeometryFile, UnknownSurfaceListsThoseThereAre) {
  try {
    named_surface(parsed(kBox), "botom", "wall.yaml");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), EndsWith("unknown surface 'botom', expected one of: side, top"));
  }
}

}  // namespace
}  // namespace geometry_io
