// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeHalfSpace.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <cmath>
#include <gp_Elips.hxx>
#include <gp_Pln.hxx>

#include "parts.h"

namespace step_parts {
namespace {

/// The part of a solid below a plane.
TopoDS_Shape below(const TopoDS_Shape& solid, const gp_Pnt& p, const gp_Dir& normal) {
  const TopoDS_Face plane = BRepBuilderAPI_MakeFace(gp_Pln(p, normal)).Face();
  const gp_Pnt inside = p.Translated(gp_Vec(normal) * -1.0);
  return BRepAlgoAPI_Common(solid, BRepPrimAPI_MakeHalfSpace(plane, inside).Solid()).Shape();
}

TopoDS_Shape torus_cut() {
  return below(BRepPrimAPI_MakeTorus(50.0, 15.0).Shape(), gp_Pnt(4.0, 0.0, 3.0), gp_Dir(0.25, 0.1, 1.0));
}

TopoDS_Shape sphere_cut() {
  const TopoDS_Shape cap =
      below(BRepPrimAPI_MakeSphere(40.0).Shape(), gp_Pnt(5.0, 0.0, 10.0), gp_Dir(1.0, 0.4, 0.7));
  return below(cap, gp_Pnt(0.0, -12.0, 0.0), gp_Dir(0.2, -1.0, 0.3));
}

TopoDS_Shape drill(const gp_Pnt& p, const gp_Dir& axis, double radius, double depth) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(p, axis), radius, depth).Shape();
}

/// The third hole lies on the seam.
TopoDS_Shape branch_holes() {
  TopoDS_Shape tube = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(40.0, 200.0).Shape(),
                                      BRepPrimAPI_MakeCylinder(36.0, 200.0).Shape())
                          .Shape();
  tube = BRepAlgoAPI_Cut(tube, drill(gp_Pnt(0, 0, 50), gp_Dir(0, 1, 0), 20.0, 100.0)).Shape();
  tube = BRepAlgoAPI_Cut(tube, drill(gp_Pnt(0, 0, 60), gp_Dir(-1, -0.2, 0.6), 12.0, 100.0)).Shape();
  return BRepAlgoAPI_Cut(tube, drill(gp_Pnt(0, 0, 140), gp_Dir(1, 0.1, 0.2), 15.0, 100.0)).Shape();
}

TopoDS_Shape pipes_and_cone() {
  const TopoDS_Shape cone = BRepPrimAPI_MakeCone(60.0, 20.0, 100.0).Shape();
  const TopoDS_Shape pipe = drill(gp_Pnt(0, 0, 40), gp_Dir(1, 0.3, 0.5), 14.0, 110.0);
  return BRepAlgoAPI_Fuse(cone, pipe).Shape();
}

TopoDS_Shape elliptic_hole(double x, double y) {
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(x, y, -1.0), gp_Dir(0, 0, 1), gp_Dir(0.8, 0.6, 0.0)), 18.0, 7.0);
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse).Edge()).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(0, 0, 10)).Shape();
}

TopoDS_Shape star_hole(double x, double y) {
  BRepBuilderAPI_MakePolygon polygon;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 ? 6.0 : 15.0, angle = 2.0 * M_PI * i / 10.0;
    polygon.Add(gp_Pnt(x + r * std::cos(angle), y + r * std::sin(angle), -1.0));
  }
  polygon.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 10)).Shape();
}

TopoDS_Shape holes() {
  TopoDS_Shape plate = BRepPrimAPI_MakeBox(200.0, 100.0, 8.0).Shape();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 2; ++j) {
      const gp_Pnt p(30.0 + 45.0 * i, 15.0 + 70.0 * j, -1.0);
      plate = BRepAlgoAPI_Cut(plate, drill(p, gp_Dir(0, 0, 1), 3.0 + 2.0 * i, 10.0)).Shape();
    }
  }
  plate = BRepAlgoAPI_Cut(plate, elliptic_hole(60.0, 50.0)).Shape();
  return BRepAlgoAPI_Cut(plate, star_hole(140.0, 50.0)).Shape();
}

/// Half of it an odd number of inches.
TopoDS_Shape bracket() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 63.5, 38.1, 25.4).Shape();
  return BRepAlgoAPI_Cut(block, drill(gp_Pnt(30.0, 19.05, -1.0), gp_Dir(0.1, 0, 1), 9.525, 40.0)).Shape();
}

}  // namespace

std::vector<Part> trimmed_parts() {
  return {{"torus_cut.step", "a torus trimmed by curves that follow no parameter", torus_cut},
          {"sphere_cut.step", "a sphere without pole, cut twice by oblique planes", sphere_cut},
          {"branch_holes.step", "cylinders with three loops more, one across the seam", branch_holes},
          {"branch_holes.igs", "the same as IGES: no solid, faces that share no edge", branch_holes},
          {"pipe_on_cone.step", "a cone trimmed by an oblique cylinder, sharp", pipes_and_cone},
          {"holes.step", "plane faces with ten holes: circles, an ellipse, a star", holes},
          {"inches.step", "inches as unit", bracket, "INCH"},
          {"metres.step", "metres as unit", bracket, "M"},
          {"ap203.step", "the oldest application protocol", bracket, "MM", "AP203"},
          {"ap242.step", "the newest application protocol", bracket, "MM", "AP242DIS"}};
}

}  // namespace step_parts
