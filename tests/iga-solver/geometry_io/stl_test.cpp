// SPDX-License-Identifier: GPL-2.0-or-later
// STL files by hand, as the many programs that write them do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cctype>
#include <limits>

#include "geometry_io/geometry_io.h"
#include "stl_cube.h"

namespace geometry_io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

GeometryFile parsed_stl(const std::string& bytes, const std::string& file = "part.stl") {
  return read_geometry(
      file, [&](const std::string&) { return bytes; }, Units::mm_t_s);
}
const TriangleMesh& mesh(const GeometryFile& file, int patch = 0) {
  return std::get<TriangleMesh>(file.patches.at(patch));
}
std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

// Of the triangles, with their orientation, the volume that they enclose; and their area.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (int t = 0; t < mesh.count(); ++t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.points.col(mesh.triangles[3 * t + k]);
    sum += corners.determinant() / 6.0;
  }
  return sum;
}

void expect_cube(const TriangleMesh& cube) {
  EXPECT_EQ(cube.count(), 12);
  EXPECT_EQ(cube.points.cols(), 8);
  EXPECT_DOUBLE_EQ(volume(cube), 1.0);
  EXPECT_TRUE(gaps_of(cube).empty());
  EXPECT_EQ(cube.degenerate + cube.repeated, 0);
}

TEST(Stl, CubeInAscii) {
  const GeometryFile file = parsed_stl(ascii_stl(cube_facets()));
  expect_cube(mesh(file));
  EXPECT_EQ(file.units, Units::mm_t_s);
  EXPECT_EQ(mesh(file).name, "cube");
  EXPECT_FALSE(mesh(file).binary);
  EXPECT_THAT(std::vector<int>(mesh(file).place.begin(), mesh(file).place.begin() + 3),
              ElementsAre(2, 9, 16));
  EXPECT_EQ(file.surfaces.size(), 2u);
  EXPECT_EQ(file.surfaces.at("all"), file.surfaces.at("cube"));
}

TEST(Stl, CubeInBinaryWhateverItsHeaderSays) {
  for (const std::string header :
       {"", "solid cube", "solid x\nfacet normal 0 0 0", "endsolid", "\x89HDF\r\n"}) {
    const GeometryFile file = parsed_stl(binary_stl(cube_facets(), header));
    expect_cube(mesh(file));
    EXPECT_EQ(mesh(file).name, "");
    EXPECT_TRUE(mesh(file).binary);
    EXPECT_EQ(mesh(file).place.back(), 12);
    EXPECT_EQ(file.surfaces.size(), 1u);
  }
}

TEST(Stl, LastSolidMayLackItsEnd) {
  const std::string text = ascii_stl(cube_facets());
  const GeometryFile file = parsed_stl(text.substr(0, text.rfind("endsolid")));
  expect_cube(mesh(file));
  EXPECT_EQ(mesh(file).name, "cube");
}

TEST(Stl, SolidCalledAllGoesWithAll) {
  const GeometryFile file = parsed_stl(ascii_stl(cube_facets(), "all") + ascii_stl(cube_facets(), "lid"));
  ASSERT_EQ(file.patches.size(), 2u);
  EXPECT_EQ(file.surfaces.at("all").size(), 2u);
  EXPECT_EQ(file.surfaces.at("lid").size(), 1u);
}

TEST(Stl, LayoutOfAsciiIsFree) {
  const std::string text = ascii_stl(cube_facets());
  const std::string capitals = [&] {
    std::string upper = text;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return upper;
  }();
  const std::string exponents = replaced(replaced(text, "1.000000", "+10.0E-01"), "0.000000", "-0e+00");
  const std::string one_line = replaced(text.substr(text.find('\n') + 1), "\n", "\t");
  for (const std::string& layout :
       {capitals, exponents, replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), "\xEF\xBB\xBF" + text,
        "\n\n  " + text + "\n \n", replaced(text, "solid cube", "solid"), "solid\n" + one_line,
        replaced(text, "normal 0 0 0", "normal nan -inf x"), replaced(text, "normal 0 0 0", "normal")})
    expect_cube(mesh(parsed_stl(layout)));
}

TEST(Stl, LinesAreCountedInAnyLayout) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const TriangleMesh cube = mesh(parsed_stl(replaced(ascii_stl(cube_facets()), "\n", end)));
    EXPECT_THAT(std::vector<int>(cube.place.begin(), cube.place.begin() + 2), ElementsAre(2, 9));
  }
}

TEST(Stl, AFileMayBeOneLine) {
  const std::vector<Facet> facets = cube_facets();
  const std::string text = ascii_stl({facets[0], facets[1]}, "solid facet of  steel") +
                           ascii_stl({facets.begin() + 2, facets.end()}, "lid");
  const GeometryFile lines = parsed_stl(text), one_line = parsed_stl(replaced(text, "\n", " "));
  ASSERT_EQ(one_line.patches.size(), 2u);
  for (int block = 0; block < 2; ++block) {
    EXPECT_EQ(mesh(one_line, block).name, mesh(lines, block).name);
    EXPECT_EQ(mesh(one_line, block).points, mesh(lines, block).points);
    EXPECT_EQ(mesh(one_line, block).triangles, mesh(lines, block).triangles);
  }
  EXPECT_EQ(mesh(one_line).name, "solid facet of steel");
  EXPECT_THAT(mesh(one_line, 1).place, testing::Each(1));
}

TEST(Stl, SolidsAreSurfacesByName) {
  const std::vector<Facet> facets = cube_facets();
  const auto side = [&](int d) { return std::vector<Facet>{facets[2 * d], facets[2 * d + 1]}; };
  const std::string text = ascii_stl(side(0), "  lower   cone\t; 3 mm") + ascii_stl({}, "nothing") +
                           ascii_stl(side(1), "lid # of steel") + ascii_stl(side(2), "") +
                           ascii_stl(side(3), "lower cone");
  const GeometryFile file = parsed_stl(text);
  EXPECT_EQ(file.patches.size(), 4u);
  EXPECT_THAT(surface_words(file.surfaces.at("lower cone"), file.patches), ElementsAre("0", "3"));
  EXPECT_THAT(surface_words(file.surfaces.at("lid"), file.patches), ElementsAre("1"));
  EXPECT_THAT(surface_words(file.surfaces.at("all"), file.patches), ElementsAre("all"));
  EXPECT_EQ(file.surfaces.size(), 3u);
  EXPECT_EQ(mesh(file, 1).points.cols(), 4);

  const JoinedMesh cone = named_triangles(file, "lower cone", "part.stl");  // x = 0 and y = 1
  EXPECT_THAT(cone.part, ElementsAre(0, 0, 3, 3));
  EXPECT_EQ(cone.mesh.points.cols(), 6);
  EXPECT_EQ(named_triangles(file, "all", "part.stl").mesh.count(), 8);
  EXPECT_THAT(
      [&] { named_triangles(file, "cone", "part.stl"); },
      ThrowsMessage<InputError>(HasSubstr("unknown surface 'cone', expected one of: all, lid, lower cone")));
}

TEST(Stl, CornersAreOneWithinAMillionthOfTheSize) {
  const float near = 1.0F + 1e-6F, far = 1.0F + 4e-6F;  // size: sqrt(3)
  for (const auto& [shift, points] : {std::pair(near, 8), std::pair(far, 9)}) {
    std::vector<Facet> facets = cube_facets();
    for (Corner& corner : facets[3])  // one triangle of x = 1
      if (corner == Corner{1.0F, 0.0F, 1.0F}) corner[0] = shift;
    EXPECT_EQ(mesh(parsed_stl(binary_stl(facets))).points.cols(), points);
  }
}

TEST(Stl, TrianglesWithoutAreaOrTwiceAreLeftOutAndCounted) {
  std::vector<Facet> facets = cube_facets();
  const Facet first = facets[0];
  facets.insert(facets.begin() + 5, {first[0], first[1], first[1]});
  facets.push_back(first);
  facets.push_back({first[2], first[1], first[0]});  // turned over
  const TriangleMesh cube = mesh(parsed_stl(ascii_stl(facets)));
  EXPECT_EQ(cube.count(), 12);
  EXPECT_EQ(cube.points.cols(), 8);
  EXPECT_EQ(cube.degenerate, 1);
  EXPECT_EQ(cube.repeated, 2);
  EXPECT_EQ(cube.place[5], 2 + 7 * 6);

  // a triangle that two solids have belongs to both, and once to all
  const GeometryFile two = parsed_stl(ascii_stl({first}, "a") + ascii_stl({first, cube_facets()[1]}, "b"));
  EXPECT_EQ(mesh(two, 1).count(), 2);
  const JoinedMesh all = named_triangles(two, "all", "");
  EXPECT_EQ(all.mesh.count(), 2);
  EXPECT_EQ(all.mesh.repeated, 1);
  EXPECT_THAT(all.part, ElementsAre(0, 1));
}

TEST(Stl, GapsAreFound) {
  std::vector<Facet> facets = cube_facets();
  facets.erase(facets.begin() + 8);                      // a triangle of z = 0
  facets.erase(facets.begin() + 2, facets.begin() + 4);  // x = 1
  const std::vector<Gap> gaps = gaps_of(mesh(parsed_stl(ascii_stl(facets))));
  ASSERT_EQ(gaps.size(), 1u);  // they share a corner or an edge
  facets = cube_facets();
  facets.push_back({Corner{5, 0, 0}, Corner{8, 0, 0}, Corner{5, 4, 0}});
  facets.erase(facets.begin() + 2, facets.begin() + 4);
  const std::vector<Gap> two = gaps_of(mesh(parsed_stl(ascii_stl(facets))));
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].edges, 3);
  EXPECT_DOUBLE_EQ(two[0].length, 12.0);
  EXPECT_EQ(two[0].triangle, 10);
  EXPECT_EQ(two[1].edges, 4);
  EXPECT_DOUBLE_EQ(two[1].length, 4.0);
}

TEST(Stl, CornersOnSidesAndNeedlesAreNoGaps) {
  std::vector<Facet> facets = cube_facets();
  const Facet first = facets[0];
  Corner middle;
  for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (first[0][i] + first[1][i]);
  std::vector<Facet> needle = facets;
  needle.push_back({first[0], middle, first[1]});
  EXPECT_TRUE(gaps_of(mesh(parsed_stl(ascii_stl(needle)))).empty());
  facets[0] = {first[0], middle, first[2]};
  facets.push_back({middle, first[1], first[2]});
  EXPECT_TRUE(gaps_of(mesh(parsed_stl(ascii_stl(facets)))).empty());
  facets.pop_back();
  const std::vector<Gap> gaps = gaps_of(mesh(parsed_stl(ascii_stl(facets))));
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].edges, 3);
}

TEST(Stl, IsScaledTurnedAndMovedInYaml) {
  const auto read = [](const std::string& yaml) {
    return read_geometry("wall.yaml", [&](const std::string& path) {
      if (path == "wall.yaml") return "units: si\n" + yaml;
      return ascii_stl(cube_facets(), path.substr(0, path.find('.')));
    });
  };
  const GeometryFile file = read(
      "geometry: {file: cube.STL, scale: [1, 2, 3], rotate: {axis: [0, 0, 1], angle: 90}, move: [10, 0, 0]}\n"
      "surfaces: {wall: cube}\n");
  EXPECT_EQ(file.units, Units::si);
  const TriangleMesh wall = named_triangles(file, "wall", "").mesh;
  EXPECT_NEAR(volume(wall), 6.0, 1e-12);
  EXPECT_TRUE(wall.points.rowwise().minCoeff().isApprox(nurbs::Vector3(8, 0, 0), 1e-12));
  EXPECT_TRUE(wall.points.rowwise().maxCoeff().isApprox(nurbs::Vector3(10, 1, 3), 1e-12));

  const GeometryFile several = read(
      "geometry:\n  shapes:\n    - {file: a.stl}\n    - {file: b.stl, move: [1, 0, 0]}\n    - plane: "
      "{origin: [0, 0, 0], edges: [[1, 0, 0], [0, 1, 0]], elements: [1, 1], degree: 1}\nsurfaces: {both: [a, "
      "b], mixed: [1, 2]}\n");
  EXPECT_EQ(several.surfaces.at("all").size(), 3u);
  const JoinedMesh both = named_triangles(several, "both", "");
  EXPECT_EQ(both.mesh.points.cols(), 12);  // the cubes have a side in common
  EXPECT_EQ(both.mesh.repeated, 2);
  EXPECT_EQ(named_triangles(several, "mixed", "").mesh.count(), 12);
  EXPECT_THAT(
      [&] { read("geometry: {file: cube.stl, refine: {divide: 2}}\n"); },
      ThrowsMessage<InputError>(HasSubstr("wall.yaml:2: refine: a patch is triangles (STL), expected")));
}

TEST(Stl, IsRefusedWhereNurbsAreNeeded) {
  const GeometryFile file = parsed_stl(ascii_stl(cube_facets()));
  EXPECT_THAT(
      [&] { named_surface(file, "cube", "part.stl"); },
      ThrowsMessage<InputError>(HasSubstr("part.stl: surface 'cube' is of triangles (STL), expected")));
  for (const Format format : {format::yaml, format::hdf5, format::xml})
    EXPECT_THAT([&] { write_geometry(file, format); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("holds no triangles (STL), expected")));
}

TEST(Stl, SaysWhatWasGivenAndWhatWasExpected) {
  const std::string ascii = ascii_stl(cube_facets()), binary = binary_stl(cube_facets());
  std::string infinite = binary;
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 50 + 12 + 4, &infinity, 4);
  const std::vector<std::pair<std::string, std::string>> table = {
      {"", "part.stl: the file is empty, expected an STL file"},
      {"solid a\nendsolid a\n", "part.stl: holds no triangle"},
      {"solid a\nfacet normal 0 0 1\nouter loop\n",
       "part.stl:4: the file ends within the solid 'a' of line 1, expected 'vertex'"},
      {"solid a\n",
       "part.stl:2: the file ends within the solid 'a' of line 1, expected 'facet' or 'endsolid': is it "
       "whole?"},
      {ascii.substr(0, ascii.rfind("endsolid") + 4),
       "'ends', expected 'facet' or 'endsolid' in an ASCII STL file, which ends here: is it whole?"},
      {replaced(ascii, "endfacet", "endface"),
       "part.stl:8: 'endface', expected 'endfacet' in an ASCII STL file"},
      {replaced(ascii, "endloop", "vertex 0 0 0"), "part.stl:7: 'vertex', expected 'endloop'"},
      {replaced(ascii, "vertex 1.0", "vertex 1,0"), "part.stl:18: '1,000000', expected a number"},
      {replaced(ascii, "vertex 1.0", "vertex nan.0"), "'nan.000000', expected a number"},
      {replaced(ascii, "vertex 1.000000", "vertex nan"),
       "'nan', expected a number that single precision can hold"},
      {replaced(ascii, "vertex 1.000000", "vertex -inf"), "'-inf', expected a number that"},
      {ascii + "facet", "'facet', expected 'solid'"},
      {"units: si\n", "part.stl:1: 'units:', expected 'solid' in an ASCII STL file"},
      {binary.substr(0, binary.size() - 1),
       "part.stl: 12 triangles are announced at byte 80, expected 684 bytes in a binary STL file, 683 are "
       "there"},
      {binary + "  ", "part.stl: 2 bytes too many behind the last of the 12 triangles"},
      {binary.substr(0, 50) + '\1', "part.stl: 51 bytes, expected 84 at least"},
      {infinite, "part.stl: byte 150: inf as a corner of triangle 2, expected a finite number"},
      {"ISO-10303-21;\n", "part.stl: is a STEP file"},
  };
  const auto parse = [](const std::string& bytes) { return [=] { parsed_stl(bytes); }; };
  for (const auto& [bytes, message] : table)
    EXPECT_THAT(parse(bytes), ThrowsMessage<InputError>(HasSubstr(message))) << message;
}

}  // namespace
}  // namespace geometry_io
