// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <cmath>
#include <gp_Circ.hxx>

#include "parts.h"

namespace step_parts {
namespace {

constexpr double kCylinderRadius = 30.0, kCylinderHeight = 80.0;

TopoDS_Shape box() { return BRepPrimAPI_MakeBox(gp_Pnt(-50.0, -30.0, -20.0), 100.0, 60.0, 40.0).Shape(); }
TopoDS_Shape cylinder() { return BRepPrimAPI_MakeCylinder(kCylinderRadius, kCylinderHeight).Shape(); }
TopoDS_Shape cone() { return BRepPrimAPI_MakeCone(40.0, 0.0, 60.0).Shape(); }
TopoDS_Shape frustum() { return BRepPrimAPI_MakeCone(40.0, 15.0, 60.0).Shape(); }
TopoDS_Shape sphere() { return BRepPrimAPI_MakeSphere(40.0).Shape(); }
TopoDS_Shape torus() { return BRepPrimAPI_MakeTorus(50.0, 15.0).Shape(); }

/// A circle of arcs, swept upwards.
TopoDS_Shape split_cylinder(int count) {
  const gp_Circ circle(gp::XOY(), kCylinderRadius);
  BRepBuilderAPI_MakeWire wire;
  for (int i = 0; i < count; ++i) {
    const double step = 2.0 * M_PI / count;
    wire.Add(BRepBuilderAPI_MakeEdge(circle, i * step, (i + 1) * step).Edge());
  }
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0.0, 0.0, kCylinderHeight))
      .Shape();
}

TopoDS_Shape cylinder_2() { return split_cylinder(2); }
TopoDS_Shape cylinder_4() { return split_cylinder(4); }
TopoDS_Shape cylinder_8() { return split_cylinder(8); }

}  // namespace

std::vector<Part> closed_form_parts() {
  return {{"box.step", "nothing: for comparison", box},
          {"cylinder.step", "a full face meets itself in a seam edge", cylinder},
          {"cylinder_2.step", "the same cylinder: smooth edges between faces on one surface", cylinder_2},
          {"cylinder_4.step", "the same in four", cylinder_4},
          {"cylinder_8.step", "the same in eight", cylinder_8},
          {"cone.step", "a degenerate edge at the tip", cone},
          {"frustum.step", "a full conical face with a seam", frustum},
          {"frustum.igs", "the same as IGES' solid of faces", frustum, "MM", "BREP"},
          {"sphere.step", "one face whose borders are a seam and two poles", sphere},
          {"torus.step", "one face with two seams, closed both ways", torus}};
}

}  // namespace step_parts
