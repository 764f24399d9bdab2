// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <cmath>
#include <gp_Circ.hxx>

#include "edges_between.h"
#include "parts.h"

namespace step_parts {
namespace {

/// 0.1 mm wide, and a triangle in the corner.
TopoDS_Shape tiny_faces() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(100.0, 80.0, 60.0).Shape();
  BRepFilletAPI_MakeChamfer chamfer(box);
  const auto edges = edges_between(box, GeomAbs_Plane, GeomAbs_Plane);
  for (int i : {0, 1, 2, 3, 4}) chamfer.Add(0.1, edges[i]);
  return chamfer.Shape();
}

TopoDS_Face rectangle(const gp_Pnt& p, const gp_Vec& a, const gp_Vec& b) {
  return BRepBuilderAPI_MakeFace(
             BRepBuilderAPI_MakePolygon(p, p.Translated(a), p.Translated(a + b), p.Translated(b), true)
                 .Wire(),
             true)
      .Face();
}

/// A trough of two planes and a quarter of a cylinder between them, and an end wall; they miss each other by
/// 0.01 mm, once with a gap, once with an overlap.
TopoDS_Shape gaps() {
  const double miss = 0.01;
  const Handle(Geom_CylindricalSurface) bend =
      new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(0, 0, 20), gp_Dir(0, 1, 0), gp_Dir(-1, 0, 0)), 20.0);
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, BRepBuilderAPI_MakeFace(bend, 1.5 * M_PI, 2.0 * M_PI, 0.0, 60.0, 1e-7).Face());
  builder.Add(shell, rectangle(gp_Pnt(miss, 0, 0), gp_Vec(100, 0, 0), gp_Vec(0, 60, 0)));
  builder.Add(shell, rectangle(gp_Pnt(-20, 0, 20 - miss), gp_Vec(0, 60, 0), gp_Vec(0, 0, 50)));
  builder.Add(shell, rectangle(gp_Pnt(100, 0, miss), gp_Vec(0, 60, 0), gp_Vec(0, 0, 50)));
  return shell;
}

TopoDS_Shape sheet_of(const std::vector<TopoDS_Face>& faces) {
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  for (const TopoDS_Face& face : faces) builder.Add(shell, face);
  return shell;
}

/// A plate with four others at its sides that are all shorter: one over a gap, one that hangs down, and two
/// side by side.
TopoDS_Shape unequal_plates() {
  const double gap = 0.015;
  return sheet_of({rectangle(gp_Pnt(0, 0, 0), gp_Vec(50, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(50 + gap, 10, 0), gp_Vec(50, 0, 0), gp_Vec(0, 40, 0)),
                   rectangle(gp_Pnt(0, 20, 0), gp_Vec(0, 25, 0), gp_Vec(-30, 0, -10)),
                   rectangle(gp_Pnt(0, 60, 0), gp_Vec(20, 0, 0), gp_Vec(0, 30, 0)),
                   rectangle(gp_Pnt(20, 60, 0), gp_Vec(30, 0, 0), gp_Vec(0, 30, 0))});
}

/// Like the pages of a book: the rims of two miss each other by 1e-4 of the size, those of a third are
/// inside.
TopoDS_Shape parallel_plates() {
  return sheet_of({rectangle(gp_Pnt(0, 0, 0), gp_Vec(50, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(0, 0, 0.0075), gp_Vec(50, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(10, 10, -0.0075), gp_Vec(20, 5, 0), gp_Vec(-5, 20, 0))});
}

/// One stands across the middle of another, over a gap of 1e-4 of the size.
TopoDS_Shape tee() {
  return sheet_of({rectangle(gp_Pnt(0, 0, 0), gp_Vec(100, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(50, 0, 0.012), gp_Vec(0, 60, 0), gp_Vec(0, 0, 40))});
}

/// On a plate of two faces: a wall that goes on beyond the plate and over the seam, an angle of two walls
/// that ends inside, a tube; a wall that stands in a gutter which the plate ends in.
TopoDS_Shape standing_faces() {
  const Handle(Geom_CylindricalSurface) tube =
      new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(75, 40, 0), gp_Dir(0, 0, 1)), 12.0);
  const Handle(Geom_CylindricalSurface) gutter =
      new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(120, 0, 0), gp_Dir(0, 1, 0), gp_Dir(1, 0, 0)), 20.0);
  return sheet_of({rectangle(gp_Pnt(0, 0, 0), gp_Vec(60, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(60, 0, 0), gp_Vec(40, 0, 0), gp_Vec(0, 60, 0)),
                   rectangle(gp_Pnt(-10, 15, 0), gp_Vec(90, 0, 0), gp_Vec(0, 4, 30)),
                   rectangle(gp_Pnt(15, 30, 0), gp_Vec(25, 0, 0), gp_Vec(0, 0, 20)),
                   rectangle(gp_Pnt(40, 30, 0), gp_Vec(0, 20, 0), gp_Vec(0, 0, 20)),
                   BRepBuilderAPI_MakeFace(tube, 0.0, 2.0 * M_PI, 0.0, 25.0, 1e-7).Face(),
                   BRepBuilderAPI_MakeFace(gutter, 0.0, M_PI, 0.0, 60.0, 1e-7).Face(),
                   rectangle(gp_Pnt(120, 10, -20), gp_Vec(0, 30, 0), gp_Vec(0, 0, 45))});
}

/// A disc in a hole that is wider by 1e-4 of the size; their circles begin elsewhere.
TopoDS_Shape patched_hole() {
  const auto circle = [](double radius, double turned, bool forward) {
    const gp_Ax2 axes(gp_Pnt(50, 30, 0), gp_Dir(0, 0, forward ? 1 : -1),
                      gp_Dir(std::cos(turned), std::sin(turned), 0));
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, radius)).Edge()).Wire();
  };
  const TopoDS_Face plate = rectangle(gp_Pnt(0, 0, 0), gp_Vec(100, 0, 0), gp_Vec(0, 60, 0));
  return sheet_of({BRepBuilderAPI_MakeFace(plate, circle(15.0, 0.0, false)).Face(),
                   BRepBuilderAPI_MakeFace(circle(14.99, 0.7, true), true).Face()});
}

/// The sides of a box, each by itself.
TopoDS_Shape loose_faces() {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape();
  for (TopExp_Explorer face(box, TopAbs_FACE); face.More(); face.Next())
    builder.Add(all, BRepBuilderAPI_Transform(face.Current(), gp_Trsf(), true).Shape());
  return all;
}

double height(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(shape, properties);
  return properties.CentreOfMass().Z();
}

/// An open tray, 2 mm thick and 200 mm long, with round corners.
TopoDS_Shape thin_sheet() {
  const double depth = 50.0, thickness = 2.0;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(200.0, 100.0, depth).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  for (const TopoDS_Edge& edge : edges_between(box, GeomAbs_Plane, GeomAbs_Plane)) {
    if (height(edge) < 0.9 * depth) fillet.Add(15.0, edge);
  }
  TopTools_ListOfShape open;
  for (TopExp_Explorer face(fillet.Shape(), TopAbs_FACE); face.More(); face.Next()) {
    if (height(face.Current()) > 0.99 * depth) open.Append(face.Current());
  }
  BRepOffsetAPI_MakeThickSolid sheet;
  sheet.MakeThickSolidByJoin(fillet.Shape(), open, -thickness, 1e-4);
  return sheet.Shape();
}

/// A bar whose profile turns by 0.2 degrees at a time, up, down, and into an arc.
TopoDS_Shape near_tangent() {
  const double turn = 0.2 * M_PI / 180.0;
  BRepBuilderAPI_MakeWire wire;
  gp_Pnt p(0, 0, 0);
  for (int heading : {0, 1, 2, 1, 0, -1}) {
    const gp_Pnt next =
        p.Translated(gp_Vec(20.0 * std::cos(heading * turn), 0, 20.0 * std::sin(heading * turn)));
    wire.Add(BRepBuilderAPI_MakeEdge(p, next).Edge());
    p = next;
  }
  const gp_Pnt top(p.X() + 40.0, 0, p.Z() + 25.0), below(top.X(), 0, -30.0), start(0, 0, -30.0);
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(p, gp_Vec(1, 0, 0), top).Value()).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(top, below).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(below, start).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(start, gp::Origin()).Edge());
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 40, 0)).Shape();
}

}  // namespace

std::vector<Part> border_parts() {
  return {{"tiny_faces.step", "faces 1e-3 of the part wide, a triangle of 1e-3 in a corner", tiny_faces},
          {"gaps.step", "faces that miss each other by 1e-4 of the size", gaps},
          {"unequal_plates.step", "faces side by side of which one goes on beyond the other", unequal_plates},
          {"patched_hole.step", "a disc in a hole, circles that begin elsewhere", patched_hole},
          {"loose_faces.step", "sides of a box that are sheets of their own", loose_faces},
          {"tee.step", "a face that stands on another, over a gap", tee},
          {"standing_faces.step", "feet of faces that cross borders, end inside, go round", standing_faces},
          {"parallel_plates.step", "faces that lie 1e-4 of the size above each other", parallel_plates},
          {"thin_sheet.step", "both skins of a sheet of 1 % thickness", thin_sheet},
          {"near_tangent.step", "edges that turn by 0.2 degrees", near_tangent}};
}

}  // namespace step_parts
