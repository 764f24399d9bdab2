// SPDX-License-Identifier: GPL-2.0-or-later
#include "hopper.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Trsf.hxx>

#include "edges_between.h"
#include "named_parts.h"

namespace step_parts {
namespace {

constexpr double kDegree = M_PI / 180.0;
// The inner skin, from the outlet at z = 0 upwards.
constexpr double kSheet = 5.0, kOutletRadius = 65.0, kSpout = 40.0, kRadius = 240.0, kKnuckle = 60.0,
                 kTop = 600.0;
constexpr double kHalfAngle = 30.0 * kDegree;  // of the cone, from the vertical
// Of the nozzle, which enters the cone where that has radius kNozzleAt; it is turned out of the radial plane
// and leans from the horizontal.
constexpr double kNozzleRadius = 40.0, kNozzleAt = 150.0, kNozzleAzimuth = 120.0 * kDegree;
constexpr double kNozzleTurn = 12.0 * kDegree, kNozzleRise = -12.0 * kDegree;
constexpr double kNozzleInside = 100.0, kNozzleOutside = 180.0;  // lengths from there
constexpr double kRoot = 20.0;                                   // radius of the blend outside
constexpr double kFlangeRadius = 120.0, kFlange = 12.0, kBoltCircle = 95.0, kBoltHole = 7.0;
constexpr int kBolts = 8;
constexpr double kChuteSlope = 35.0 * kDegree, kChuteDrop = 200.0, kChuteLength = 610.0, kChuteWidth = 270.0;
constexpr double kChuteWall = 70.0, kChuteSheet = 4.0, kChuteBend = 30.0;

gp_Pnt at(double r, double z) { return {r, 0.0, z}; }

/// What a skin encloses that lies `out` outside the inner one; `beyond`: longer by so much at both ends.
TopoDS_Shape vessel(double out, double beyond) {
  const double outlet = kOutletRadius + out, radius = kRadius + out, knuckle = kKnuckle + out;
  // The skins of the cone are `out` apart, so the corner over the spout lies lower outside.
  const double corner = kSpout - out * std::tan(kHalfAngle / 2.0);
  const double turn = radius - knuckle + knuckle * std::cos(kHalfAngle);
  const double joint = corner + (turn - outlet) / std::tan(kHalfAngle);
  const double knuckle_top = joint + knuckle * std::sin(kHalfAngle);
  // Only with its x axis radial is a circle seen to turn into a torus.
  const gp_Circ bend(gp_Ax2(at(radius - knuckle, knuckle_top), -gp::DY(), gp::DX()), knuckle);
  BRepBuilderAPI_MakeWire wire;
  const gp_Pnt points[] = {at(0, -beyond), at(outlet, -beyond), at(outlet, corner), at(turn, joint)};
  for (int i = 0; i < 3; ++i) wire.Add(BRepBuilderAPI_MakeEdge(points[i], points[i + 1]).Edge());
  const gp_Pnt shoulder = at(radius, knuckle_top), rim = at(radius, kTop + beyond),
               top = at(0, kTop + beyond);
  wire.Add(BRepBuilderAPI_MakeEdge(bend, points[3], shoulder).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(shoulder, rim).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(rim, top).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(top, points[0]).Edge());
  const TopoDS_Face profile = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  return BRepPrimAPI_MakeRevol(profile, gp_Ax1(gp::Origin(), gp::DZ())).Shape();
}

/// With the nozzle, whose blind end is a sheet too; blends outside and inside are one sheet apart.
TopoDS_Shape skin(double out, double beyond) {
  const double azimuth = kNozzleAzimuth + kNozzleTurn;
  const gp_Dir along(std::cos(kNozzleRise) * std::cos(azimuth), std::cos(kNozzleRise) * std::sin(azimuth),
                     std::sin(kNozzleRise));
  const gp_Pnt entry(kNozzleAt * std::cos(kNozzleAzimuth), kNozzleAt * std::sin(kNozzleAzimuth),
                     kSpout + (kNozzleAt - kOutletRadius) / std::tan(kHalfAngle));
  const gp_Ax2 axis(entry.Translated(gp_Vec(along) * -kNozzleInside), along);
  const TopoDS_Shape nozzle =
      BRepPrimAPI_MakeCylinder(axis, kNozzleRadius + out, kNozzleInside + kNozzleOutside + out).Shape();
  const TopoDS_Shape sharp = BRepAlgoAPI_Fuse(vessel(out, beyond), nozzle).Shape();
  BRepFilletAPI_MakeFillet fillet(sharp);
  fillet.SetParams(1e-2, 1e-4, 1e-5, 1e-3, 1e-5,
                   1e-3);  // all but the fourth, 1 um, as they are: it halves the poles
  for (const TopoDS_Edge& edge : edges_between(sharp, GeomAbs_Cone, GeomAbs_Cylinder)) {
    const TopoDS_Vertex v = TopoDS::Vertex(TopExp_Explorer(edge, TopAbs_VERTEX).Current());
    if (BRep_Tool::Pnt(v).Z() > kSpout + 1.0) fillet.Add(kRoot + kSheet - out, edge);
  }
  return fillet.Shape();
}

gp_Pnt middle_of(const TopoDS_Face& face) {
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  return BRepAdaptor_Surface(face).Value(0.5 * (u0 + u1), 0.5 * (v0 + v1));
}

std::string name_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  switch (surface.GetType()) {
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Torus:
      return "knuckle";
    case GeomAbs_Plane:
      return "cap";
    case GeomAbs_Cylinder: {
      const double radius = surface.Cylinder().Radius();
      return radius > kRadius - 1.0 ? "cylinder" : radius > kOutletRadius - 1.0 ? "spout" : "pipe";
    }
    default:
      return "root";
  }
}

void add_bin(NamedParts& parts, const TDF_Label& assembly) {
  const TopoDS_Shape inside = skin(0.0, 10.0);
  const TopoDS_Shape bin = BRepAlgoAPI_Cut(skin(kSheet, 0.0), inside).Shape();
  const TDF_Label label = parts.solid("bin", TopExp_Explorer(bin, TopAbs_SOLID).Current());
  parts.colour(label, "B0B7BF");
  for (TopExp_Explorer faces(bin, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    if (BRepClass3d_SolidClassifier(inside, middle_of(face), 0.01).State() != TopAbs_ON) continue;
    const std::string name = name_of(face);
    parts.name_face(label, face, name);
    if (name == "cone") parts.colour_face(label, face, "FF8800");
    if (name == "root") parts.colour_face(label, face, "2A9D8F");
  }
  parts.place(assembly, label, TopLoc_Location(), "bin");
}

void add_flange(NamedParts& parts, const TDF_Label& assembly) {
  TopoDS_Shape ring = BRepPrimAPI_MakeCylinder(kFlangeRadius, kFlange).Shape();
  ring = BRepAlgoAPI_Cut(ring, BRepPrimAPI_MakeCylinder(kOutletRadius + kSheet, kFlange).Shape()).Shape();
  for (int i = 0; i < kBolts; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / kBolts;
    const gp_Pnt p(kBoltCircle * std::cos(angle), kBoltCircle * std::sin(angle), 0.0);
    ring = BRepAlgoAPI_Cut(ring, BRepPrimAPI_MakeCylinder(gp_Ax2(p, gp::DZ()), kBoltHole, kFlange).Shape())
               .Shape();
  }
  const TDF_Label label = parts.solid("flange", TopExp_Explorer(ring, TopAbs_SOLID).Current());
  parts.colour(label, "4A6FA5");
  parts.place(assembly, label, TopLoc_Location(), "flange");
}

/// A channel along x, its floor at z = 0, whose upper end is closed; the inner skin is `out` = 0.
TopoDS_Shape trough(double out, double start, double height) {
  const double half = kChuteWidth / 2.0 + out;
  const TopoDS_Shape block =
      BRepPrimAPI_MakeBox(gp_Pnt(start, -half, -out),
                          gp_Pnt(kChuteLength + (out > 0.0 ? 0.0 : 10.0), half, height))
          .Shape();
  BRepFilletAPI_MakeFillet fillet(block);
  for (const TopoDS_Edge& edge : edges_between(block, GeomAbs_Plane, GeomAbs_Plane)) {
    double first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const gp_Pnt p = curve->Value(first), q = curve->Value(last);
    if (std::abs(p.Z() - q.Z()) < 1.0 && p.Z() < 1.0 && std::abs(p.X() - q.X()) > 1.0) {
      fillet.Add(kChuteBend + out, edge);
    }
  }
  return fillet.Shape();
}

void add_chute(NamedParts& parts, const TDF_Label& assembly) {
  const TopoDS_Shape chute =
      BRepAlgoAPI_Cut(trough(kChuteSheet, -kChuteSheet, kChuteWall), trough(0.0, 0.0, kChuteWall + 10.0))
          .Shape();
  const TDF_Label label = parts.solid("chute", TopExp_Explorer(chute, TopAbs_SOLID).Current());
  parts.colour(label, "C9A227");
  for (TopExp_Explorer faces(chute, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    if (BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane && std::abs(middle_of(face).Z()) < 1e-3)
      parts.name_face(label, face, "floor");
  }
  gp_Trsf tilt, move;
  tilt.SetRotation(gp_Ax1(gp::Origin(), gp::DY()), kChuteSlope);
  move.SetTranslation(gp_Vec(-150.0, 0.0, -kChuteDrop + 150.0 * std::tan(kChuteSlope)));
  parts.place(assembly, label, TopLoc_Location(move * tilt), "chute");
}

}  // namespace

Handle(TDocStd_Document) hopper() {
  NamedParts parts;
  const TDF_Label assembly = parts.assembly("hopper");
  add_bin(parts, assembly);
  add_flange(parts, assembly);
  add_chute(parts, assembly);
  return parts.document();
}

}  // namespace step_parts
