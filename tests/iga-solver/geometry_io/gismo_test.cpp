// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geometry_io/geometry_io.h"

namespace geometry_io {
namespace {

using nurbs::Surface;
using nurbs::Vector3;
using nurbs::Volume;
using testing::HasSubstr;
using testing::StartsWith;

GeometryFile parsed_xml(const std::string& text, Units units = Units::si) {
  return read_geometry(
      "wall.xml", [&](const std::string&) { return text; }, units);
}

// A quarter of a cylinder of radius 1 about z (xi round it, eta along it) and a plate, glued along z = 2.
const std::string kTwo = R"(<?xml version="1.0" encoding="UTF-8"?>
<xml>
 <Geometry type="TensorNurbs2" id="7">
  <Basis type="TensorNurbsBasis2">
   <Basis type="TensorBSplineBasis2">
    <Basis type="BSplineBasis" index="0"><KnotVector degree="2">0 0 0 1 1 1</KnotVector></Basis>
    <Basis type="BSplineBasis" index="1"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
   </Basis>
   <weights>1 0.70710678118654757 1 1 0.70710678118654757 1</weights>
  </Basis>
  <coefs geoDim="3">1 0 0  1 1 0  0 1 0
   1 0 2  1 1 2  0 1 2</coefs>
 </Geometry>
 <Geometry type="TensorBSpline2" id="4">
  <Basis type="TensorBSplineBasis2">
   <Basis type="BSplineBasis"><KnotVector degree="1">0 0 1/3 1 1</KnotVector></Basis>
   <Basis type="BSplineBasis"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
  </Basis>
  <coefs geoDim="2">0 0  +1 0  3 0  0 1e0  1 1  3 1</coefs>
 </Geometry>
 <Function type="FunctionExpr" id="8" dim="2">x*y</Function>
 <MultiPatch parDim="2" id="9">
  <patches type="id_index">4 7</patches>
 </MultiPatch>
</xml>
)";

const std::string kCube = R"(<xml units="cgs">
 <Geometry type="TensorBSpline3" id="1">
  <Basis type="TensorBSplineBasis3">
   <Basis type="BSplineBasis"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
   <Basis type="BSplineBasis"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
   <Basis type="BSplineBasis"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
  </Basis>
  <coefs geoDim="3">0 0 0  2 0 0  0 3 0  2 3 0  0 0 4  2 0 4  0 3 4  2 3 4</coefs>
 </Geometry>
 <MultiPatch parDim="3">
  <patches type="id_range">1 1</patches>
  <boundary name="lid">1 6</boundary>
  <boundary>1 1 1 2</boundary>
  <boundary name="sides">1 4 1 3</boundary>
 </MultiPatch>
</xml>
)";

TEST(Gismo, PatchesInTheOrderOfTheMultiPatch) {
  const GeometryFile file = parsed_xml(kTwo, Units::cgs);
  EXPECT_EQ(file.units, Units::cgs);  // G+Smo has none
  ASSERT_EQ(file.patches.size(), 2u);
  const Surface& plate = std::get<Surface>(file.patches[0]);
  EXPECT_FALSE(plate.space.rational());
  EXPECT_EQ(plate.space.knots(0).knots(), (std::vector<double>{0, 0, 1.0 / 3.0, 1, 1}));
  EXPECT_EQ(plate.control_points.col(1), Vector3(1, 0, 0));  // geoDim 2: z = 0
  EXPECT_EQ(plate.control_points.col(5), Vector3(3, 1, 0));
  const Surface& quarter = std::get<Surface>(file.patches[1]);
  for (const double xi : {0.0, 0.3, 1.0}) {
    const Vector3 point = interpolate(quarter.space, quarter.control_points, {xi, 0.25});
    EXPECT_NEAR(point.head<2>().norm(), 1.0, 1e-15);
    EXPECT_NEAR(point.z(), 0.5, 1e-15);
  }
  EXPECT_EQ(file.surfaces.at("all").size(), 2u);
}

TEST(Gismo, WithoutMultiPatchAllGeometriesInTheOrderOfTheFile) {
  std::string text = kTwo;
  const size_t begin = text.find(" <MultiPatch"), end = text.find("</xml>");
  text.erase(begin, end - begin);
  EXPECT_TRUE(std::get<Surface>(parsed_xml(text).patches[0]).space.rational());
}

TEST(Gismo, NamedBoundariesOfVolumesAreSurfaces) {
  const GeometryFile file = parsed_xml(kCube);
  EXPECT_EQ(file.units, Units::cgs);
  ASSERT_EQ(file.surfaces.size(), 2u);
  const auto lid = named_surface(file, "lid", "wall.xml");
  EXPECT_EQ(lid.front().surface.control_points.row(2).minCoeff(), 4.0);
  EXPECT_EQ(lid.front().outward_sign, 1);
  const auto sides = named_surface(file, "sides", "wall.xml");
  EXPECT_EQ(sides[0].surface.control_points.row(1).minCoeff(), 3.0);
  EXPECT_EQ(sides[1].surface.control_points.row(1).maxCoeff(), 0.0);
}

TEST(Gismo, AVolumeWithoutNamesOffersItsFaces) {
  std::string text = kCube;
  for (size_t at; (at = text.find(" name=")) != std::string::npos;) text.erase(at, text.find('>', at) - at);
  const GeometryFile file = parsed_xml(text);
  EXPECT_EQ(file.surfaces.size(), 6u);
  EXPECT_EQ(named_surface(file, "xi+", "").front().surface.control_points.row(0).minCoeff(), 2.0);
}

TEST(Gismo, WritesInterfacesAndBoundaryOfCoincidingEdges) {
  // Unit squares side by side; the second one's xi runs against the first one's eta.
  const std::string text = R"(units: si
geometry:
  patches:
    - {degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control_points: [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]}
    - {degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control_points: [[1,1,0],[1,0,0],[2,1,0],[2,0,0]]}
)";
  const GeometryFile squares = parse_geometry_file(text, "squares.yaml");
  const std::string xml = write_geometry(squares, format::xml);
  // patch 0 side xi+ (2), patch 1 side eta- (3); xi of 0 is eta of 1, same way; eta of 0 is xi of 1,
  // reversed.
  EXPECT_THAT(xml, HasSubstr("<interfaces>\n0 2 1 3 1 0 1 0\n</interfaces>"));
  EXPECT_THAT(xml, HasSubstr("<boundary>\n0 1\n0 3\n0 4\n1 1\n1 2\n1 4\n</boundary>"));
}

struct BadXml {
  std::string good, from, to;
  int line;
  std::string message;
};

TEST(Gismo, SaysWhatWasGivenAndWhatWasExpected) {
  const std::vector<BadXml> table = {
      {kTwo, "TensorNurbs2", "THBSpline2", 3,
       "geometry of type 'THBSpline2', expected TensorBSpline2, TensorBSpline3, TensorNurbs2 or "
       "TensorNurbs3, not trimmed"},
      {kTwo, "TensorNurbs2", "HBSpline2", 3, "geometry of type 'HBSpline2', expected"},
      {kTwo, "TensorBSpline2", "TensorBSpline4", 14, "geometry of type 'TensorBSpline4', expected"},
      {kTwo, "TensorBSpline2", "BSpline", 14, "geometry of type 'BSpline', expected"},
      {kTwo, " type=\"TensorNurbs2\"", "", 3, "<Geometry> has no attribute 'type'"},
      {kTwo, "<Function", "<TrimSurface/><Function", 21,
       "<TrimSurface>, expected <Geometry> or <MultiPatch>: Tensor"},
      {kTwo, "<Function", "<PlanarDomain/><Function", 21, "<PlanarDomain>, expected <Geometry>"},
      {kTwo, " </Geometry>", " <CurveLoop/></Geometry>", 13,
       "<CurveLoop> in <Geometry>, expected <Basis> and <coefs> only: no trimming"},
      {kTwo, " </Geometry>", " <transform/></Geometry>", 13, "<transform> in <Geometry>, expected"},
      {kTwo, "0 0 0 1 1 1", "0 0 0.5 1 1 1", 6,
       "<KnotVector>: knot vector is not open: first knot 2 times and last knot 3 times"},
      {kTwo, "0 0 0 1 1 1", "0 0 0 1 0.5 1", 6, "knot 5 is 0.5 after 1"},
      {kTwo, "0 0 0 1 1 1", "0 0 0 1 1", 6, "<KnotVector>: 5 knots given, degree 2 expects at least 6"},
      {kTwo, "0 0 0 1 1 1", "0 0 0 l 1 1", 6, "number 4 of <KnotVector> is 'l', expected a number"},
      {kTwo, "0 0 0 1 1 1", "", 6, "<KnotVector>: 0 knots given"},
      {kTwo, "degree=\"2\"", "degree=\"17\"", 6, "degree is 17, expected 1 to 16"},
      {kTwo, "degree=\"2\"", "degree=\"two\"", 6,
       "attribute 'degree' of <KnotVector> is 'two', expected a whole number"},
      {kTwo, "degree=\"2\"", "mode=\"uniform\" degree=\"2\"", 6, "<KnotVector> has mode='uniform'"},
      {kTwo, "index=\"0\"", "index=\"1\"", 6, "index of <Basis> is '1', expected '0'"},
      {kTwo, "BSplineBasis\" index=\"1\"", "NurbsBasis\" index=\"1\"", 7,
       "type of <Basis> is 'NurbsBasis', expected 'BSplineBasis'"},
      {kTwo, "\"TensorNurbsBasis2\"", "\"TensorBSplineBasis2\"", 4, "expected 'TensorNurbsBasis2'"},
      {kTwo, "<weights>1 0.7", "<weights>1 -0.7", 9, "<weights>: weight 2 is -0.7"},
      {kTwo, "<weights>1 ", "<weights>0 ", 9, "<weights>: weight 1 is 0, expected a number > 0"},
      {kTwo, "<weights>1 ", "<weights>", 9, "<weights>: 5 weights given, expected 6"},
      {kTwo, "<weights>1 0.70710678118654757 1 1 0.70710678118654757 1</weights>", "", 4,
       "<Basis> has no <weights>"},
      {kTwo, "<coefs geoDim=\"3\">1 0 0", "<coefs geoDim=\"3\">1 0", 11,
       "17 numbers in <coefs>, expected 18: 6 control points of 3 coordinates"},
      {kTwo, "<coefs geoDim=\"3\">1 0 0", "<coefs geoDim=\"3\">1 nan 0", 11,
       "<coefs>: control point 1 is not finite"},
      {kTwo, "<coefs geoDim=\"3\">1 0 0", "<coefs geoDim=\"3\">1 1/0 0", 11,
       "<coefs>: control point 1 is not finite"},
      {kTwo, "geoDim=\"3\"", "geoDim=\"4\"", 11, "geoDim is 4, expected 3, or 2 for z = 0"},
      {kTwo, " geoDim=\"3\"", "", 11, "<coefs> has no attribute 'geoDim'"},
      {kTwo, "geoDim=\"3\"", "format=\"B64Float64\" geoDim=\"3\"", 11,
       "<coefs> has format='B64Float64', expected numbers written out"},
      {kTwo, "geoDim=\"3\"", "order=\"coordinates\" geoDim=\"3\"", 11, "<coefs> has order='coordinates'"},
      {kTwo, "id_index\">4 7", "id_index\">4 5", 23, "no <Geometry> with id 5 in this file"},
      {kTwo, "id_index\">4 7", "id_range\">7 4", 23, "id_range is '7 4', expected its first and last id"},
      {kTwo, "id_index\">4 7", "id_list\">4 7", 23,
       "type of <patches> is 'id_list', expected id_range or id_index"},
      {kTwo, "id=\"7\"", "id=\"4\"", 14, "second <Geometry> with id 4, expected one"},
      {kTwo, "parDim=\"2\"", "parDim=\"3\"", 22, "geometry 4 has 2 parameters, expected parDim 3"},
      {kTwo, "</coefs>", "</coef>", 12, "broken XML"},
      {kTwo, "</xml>", "", 25, "broken XML"},
      {kTwo, kTwo, "", 1, "broken XML"},
      {kTwo, kTwo, "<VTKFile/>", 1, "<VTKFile> at the top, expected <xml>"},
      {kTwo, kTwo, "<xml/>", 1, "no <Geometry> in this file"},
      {kCube, "units=\"cgs\"", "units=\"inch\"", 1,
       "units is 'inch', expected one of: si, cgs, mm-g-ms, mm-t-s"},
      {kCube, "geoDim=\"3\"", "geoDim=\"2\"", 8, "geoDim is 2, expected 3"},
      {kCube, "<Basis type=\"BSplineBasis\"><KnotVector degree=\"1\">0 0 1 1</KnotVector></Basis>", "", 3,
       "2 bases of one direction, expected 3"},
      {kCube, "\"lid\">1 6", "\"lid\">1 7", 12, "side is 7, expected 1 to 6"},
      {kCube, "\"lid\">1 6", "\"lid\">1", 12, "1 numbers in <boundary>, expected pairs of patch and side"},
  };
  for (const BadXml& bad : table) {
    std::string text = bad.good;
    const size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos) << bad.from;
    text.replace(at, bad.from.size(), bad.to);
    SCOPED_TRACE(bad.from + " -> " + bad.to);
    try {
      parsed_xml(text);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith("wall.xml:" + std::to_string(bad.line) + ": "));
      EXPECT_THAT(error.what(), HasSubstr(bad.message));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace geometry_io
