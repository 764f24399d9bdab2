// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopoDS.hxx>
#include <cmath>

#include "parts.h"

namespace step_parts {
namespace {

constexpr double kTolerance = 1e-7;  // mm, OpenCASCADE's own

struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

/// Of a curve closed after `count` poles, or with its ends at the first and the last pole.
Knots uniform(int count, int degree, bool periodic) {
  const int spans = periodic ? count : count - degree;
  Knots knots{{1, spans + 1}, {1, spans + 1}};
  for (int i = 1; i <= spans + 1; ++i) {
    knots.values(i) = i - 1;
    knots.multiplicities(i) = periodic || (i > 1 && i <= spans) ? 1 : degree + 1;
  }
  return knots;
}

Handle(Geom_BSplineSurface) cubic(const TColgp_Array2OfPnt& poles, bool u_periodic, bool v_periodic) {
  const Knots u = uniform(poles.NbRows(), 3, u_periodic), v = uniform(poles.NbColumns(), 3, v_periodic);
  return new Geom_BSplineSurface(poles, u.values, v.values, u.multiplicities, v.multiplicities, 3, 3,
                                 u_periodic, v_periodic);
}

TopoDS_Solid inside_of(const TopoDS_Shell& shell) {
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(shell).Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

TopoDS_Shape sewn_solid(const std::vector<TopoDS_Shape>& faces) {
  BRepBuilderAPI_Sewing sewing(1e-5);
  for (const TopoDS_Shape& face : faces) sewing.Add(face);
  sewing.Perform();
  return inside_of(TopoDS::Shell(sewing.SewedShape()));
}

TopoDS_Face lid(const Handle(Geom_BSplineSurface) & side, double v) {
  const TopoDS_Edge rim = BRepBuilderAPI_MakeEdge(side->VIso(v)).Edge();
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(rim).Wire(), true).Face();
}

TopoDS_Shape closed_spline() {
  TColgp_Array2OfPnt poles(1, 8, 1, 6);
  for (int i = 1; i <= 8; ++i) {
    for (int j = 1; j <= 6; ++j) {
      const double angle = 2.0 * M_PI * i / 8.0, r = 40.0 + 12.0 * std::sin(1.3 * j) + (i % 2 ? 4.0 : 0.0);
      poles(i, j) = gp_Pnt(r * std::cos(angle), 0.8 * r * std::sin(angle), 18.0 * j);
    }
  }
  const Handle(Geom_BSplineSurface) side = cubic(poles, true, false);
  double u0, u1, v0, v1;
  side->Bounds(u0, u1, v0, v1);
  return sewn_solid({BRepBuilderAPI_MakeFace(side, kTolerance).Face(), lid(side, v0), lid(side, v1)});
}

TopoDS_Shape spline_ring() {
  TColgp_Array2OfPnt poles(1, 10, 1, 6);
  for (int i = 1; i <= 10; ++i) {
    for (int j = 1; j <= 6; ++j) {
      const double a = 2.0 * M_PI * i / 10.0, b = 2.0 * M_PI * j / 6.0, r = 14.0 + 3.0 * std::sin(3.0 * a);
      const double big = 50.0 + r * std::cos(b);
      poles(i, j) = gp_Pnt(big * std::cos(a), big * std::sin(a), r * std::sin(b) + 6.0 * std::cos(2.0 * a));
    }
  }
  TopoDS_Shell shell;
  BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, BRepBuilderAPI_MakeFace(cubic(poles, true, true), kTolerance).Face());
  shell.Closed(true);
  return inside_of(shell);
}

Handle(Geom_BSplineSurface) wavy() {
  TColgp_Array2OfPnt poles(1, 7, 1, 6);
  for (int i = 1; i <= 7; ++i) {
    for (int j = 1; j <= 6; ++j) {
      poles(i, j) = gp_Pnt(20.0 * i, 20.0 * j, 12.0 * std::sin(1.7 * i) * std::cos(1.1 * j));
    }
  }
  return cubic(poles, false, false);
}

/// A closed spline in the parameter plane of a surface: an oval with `waves` waves.
TopoDS_Wire oval(const Handle(Geom_Surface) & surface, gp_Pnt2d centre, double a, double b, int waves) {
  const int count = 12;
  Handle(TColgp_HArray1OfPnt2d) points = new TColgp_HArray1OfPnt2d(1, count);
  for (int i = 1; i <= count; ++i) {
    const double t = 2.0 * M_PI * i / count, r = 1.0 + 0.1 * std::sin(waves * t);
    points->SetValue(i, centre.Translated(gp_Vec2d(a * r * std::cos(t), b * r * std::sin(t))));
  }
  Geom2dAPI_Interpolate interpolate(points, true, 1e-9);
  interpolate.Perform();
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(interpolate.Curve(), surface).Edge()).Wire();
}

TopoDS_Shape spline_plate_hole() {
  const Handle(Geom_BSplineSurface) surface = wavy();
  BRepBuilderAPI_MakeFace face(surface, oval(surface, gp_Pnt2d(2.0, 1.5), 1.6, 1.2, 3), true);
  face.Add(TopoDS::Wire(oval(surface, gp_Pnt2d(2.2, 1.4), 0.6, 0.4, 4).Reversed()));
  TopoDS_Shape shape = face.Face();
  BRepLib::BuildCurves3d(shape);
  BRepLib::SameParameter(shape, 1e-6, true);
  return shape;
}

/// Knots 0, 1, 2, ... each once, of which the spline uses those from 3 on.
TopoDS_Shape unclamped() {
  const TColgp_Array2OfPnt poles = wavy()->Poles();
  TColStd_Array1OfReal u_knots(1, poles.NbRows() + 4), v_knots(1, poles.NbColumns() + 4);
  TColStd_Array1OfInteger u_once(1, u_knots.Length()), v_once(1, v_knots.Length());
  for (int i = 1; i <= u_knots.Length(); ++i) u_knots(i) = i - 1;
  for (int i = 1; i <= v_knots.Length(); ++i) v_knots(i) = i - 1;
  u_once.Init(1);
  v_once.Init(1);
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, u_knots, v_knots, u_once, v_once, 3, 3);
  return BRepBuilderAPI_MakeFace(surface, kTolerance).Face();
}

TopoDS_Shape offset() {
  return BRepBuilderAPI_MakeFace(new Geom_OffsetSurface(wavy(), 3.0), 0.4, 3.7, 0.3, 2.8, kTolerance).Face();
}

TopoDS_Shape bezier_2_14() {
  TColgp_Array2OfPnt poles(1, 3, 1, 15);
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 15; ++j) {
      poles(i, j) = gp_Pnt(15.0 * i, 10.0 * j, (i == 2 ? 20.0 : 0.0) + 30.0 * std::sin(1.9 * j + 0.3 * i));
    }
  }
  return BRepBuilderAPI_MakeFace(new Geom_BezierSurface(poles), kTolerance).Face();
}

TopoDS_Shape spline_tip() {
  TColgp_Array2OfPnt poles(1, 5, 1, 5);
  for (int i = 1; i <= 5; ++i) {
    for (int j = 1; j <= 5; ++j) {
      const double r = 12.0 * (j - 1), angle = 0.4 * i;
      poles(i, j) = gp_Pnt(r * std::cos(angle), r * std::sin(angle), 10.0 * std::sin(0.9 * j));
    }
  }
  return BRepBuilderAPI_MakeFace(cubic(poles, false, false), kTolerance).Face();
}

Handle(Geom_BSplineCurve) through(const std::vector<gp_Pnt>& points, bool closed) {
  const int count = static_cast<int>(points.size());
  Handle(TColgp_HArray1OfPnt) array = new TColgp_HArray1OfPnt(1, count);
  for (int i = 0; i < count; ++i) array->SetValue(i + 1, points[i]);
  GeomAPI_Interpolate interpolate(array, closed, kTolerance);
  interpolate.Perform();
  return interpolate.Curve();
}

TopoDS_Shape turned(const std::vector<gp_Pnt>& profile, double angle) {
  const gp_Ax1 axis(gp::Origin(), gp::DZ());
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeEdge(through(profile, false)).Edge(), axis, angle).Shape();
}

TopoDS_Shape revolution() {
  return turned({{40, 0, 0}, {55, 0, 20}, {35, 0, 45}, {30, 0, 70}, {42, 0, 90}}, 2.0 * M_PI);
}

TopoDS_Shape trumpet() {
  TColgp_Array1OfPnt poles(1, 3);
  poles(1) = {10, 0, 0}, poles(2) = {11, 0, 39}, poles(3) = {45, 0, 40};
  const Handle(Geom_BezierCurve) profile = new Geom_BezierCurve(poles);
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeEdge(profile).Edge(), gp_Ax1(gp::Origin(), gp::DZ()))
      .Shape();
}

TopoDS_Shape revolution_pole() { return turned({{0, 0, 0}, {30, 0, 6}, {50, 0, 30}, {45, 0, 60}}, 4.0); }

TopoDS_Shape extrusion() {
  const auto curve =
      through({{40, 0, 0}, {25, 25, 0}, {0, 45, 0}, {-30, 20, 0}, {-20, -15, 0}, {5, -35, 0}}, true);
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve).Edge()).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(10, 5, 60)).Shape();
}

}  // namespace

std::vector<Part> spline_parts() {
  return {
      {"closed_spline.step", "a spline periodic in u, with a seam, between plane lids", closed_spline},
      {"spline_ring.step", "a spline periodic in both directions", spline_ring},
      {"spline_plate_hole.step", "a spline trimmed by splines, outside and round a hole", spline_plate_hole},
      {"spline_tip.step", "a spline with one side of length zero", spline_tip},
      {"unclamped.step", "a spline whose end knots stand once", unclamped},
      {"bezier_2_14.step", "degree 14 by nature", bezier_2_14},
      {"offset.step", "an offset surface, which is to be refused", offset},
      {"revolution.step", "a surface of revolution of a spline, full circle", revolution},
      {"trumpet.step", "a sheet closed in a circle, of four long elements", trumpet},
      {"revolution_pole.step", "a surface of revolution that reaches its axis", revolution_pole},
      {"extrusion.step", "an oblique extrusion of a closed spline", extrusion},
      {"closed_spline.igs", "the periodic spline as IGES", closed_spline}};
}

}  // namespace step_parts
