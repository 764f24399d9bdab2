// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepLib.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <gp_Circ.hxx>

#include "edges_between.h"
#include "parts.h"

namespace step_parts {
namespace {

TopoDS_Shape blend_cone_pipe() {
  const TopoDS_Shape cone = BRepPrimAPI_MakeCone(60.0, 20.0, 100.0).Shape();
  const gp_Ax2 axis(gp_Pnt(0, 0, 40), gp_Dir(-1, 0.3, 0.5));
  const TopoDS_Shape sharp =
      BRepAlgoAPI_Fuse(cone, BRepPrimAPI_MakeCylinder(axis, 14.0, 110.0).Shape()).Shape();
  BRepFilletAPI_MakeFillet fillet(sharp);
  for (const TopoDS_Edge& edge : edges_between(sharp, GeomAbs_Cone, GeomAbs_Cylinder)) fillet.Add(6.0, edge);
  return fillet.Shape();
}

TopoDS_Shape variable_fillet() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(100.0, 60.0, 40.0).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  const auto edges = edges_between(box, GeomAbs_Plane, GeomAbs_Plane);
  fillet.Add(5.0, 15.0, edges[0]);
  fillet.Add(4.0, edges[1]);
  fillet.Add(12.0, 6.0, edges[2]);
  return fillet.Shape();
}

TopoDS_Shape loft() {
  BRepBuilderAPI_MakePolygon square(gp_Pnt(50, 50, 0), gp_Pnt(-50, 50, 0), gp_Pnt(-50, -50, 0),
                                    gp_Pnt(50, -50, 0), true);
  const gp_Circ circle(gp_Ax2(gp_Pnt(10, 0, 80), gp_Dir(0.1, 0, 1)), 25.0);
  BRepOffsetAPI_ThruSections loft(true);
  loft.AddWire(square.Wire());
  loft.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire());
  return loft.Shape();
}

TopoDS_Shape helix() {
  const double radius = 30.0, pitch = 25.0, turns = 2.0;
  const Handle(Geom_CylindricalSurface) drum = new Geom_CylindricalSurface(gp::XOY(), radius);
  const Handle(Geom2d_Line) line = new Geom2d_Line(gp_Pnt2d(0, 0), gp_Dir2d(2.0 * M_PI, pitch));
  const double length = turns * std::hypot(2.0 * M_PI, pitch);
  TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(line, drum, 0.0, length).Edge();
  BRepLib::BuildCurves3d(edge);
  const gp_Circ section(gp_Ax2(gp_Pnt(radius, 0, 0), gp_Dir(0, 2.0 * M_PI * radius, pitch)), 5.0);
  BRepOffsetAPI_MakePipeShell pipe(BRepBuilderAPI_MakeWire(edge).Wire());
  pipe.SetMode(true);
  pipe.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(section).Edge()).Wire());
  pipe.Build();
  pipe.MakeSolid();
  return pipe.Shape();
}

}  // namespace

std::vector<Part> blended_parts() {
  return {
      {"blend_cone_pipe.step", "a fillet between a cone and an oblique pipe: high degree", blend_cone_pipe},
      {"variable_fillet.step", "fillets of changing radius that meet in a corner", variable_fillet},
      {"loft.step", "ruled splines between a square and a tilted circle", loft},
      {"helix.step", "a circle swept along a helix", helix}};
}

}  // namespace step_parts
