// SPDX-License-Identifier: GPL-2.0-or-later
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <gp_Trsf.hxx>

#include "hopper.h"
#include "named_parts.h"
#include "parts.h"

namespace step_parts {
namespace {

TopLoc_Location placed(const gp_Dir& axis, double degrees, const gp_Vec& by) {
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp::Origin(), axis), degrees * M_PI / 180.0);
  move.SetTranslation(by);
  return TopLoc_Location(move * turn);
}

TopoDS_Face face(const TopoDS_Shape& shape, int number) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return TopoDS::Face(faces(number));
}

/// A frame of two legs, each of a post and a foot, and a plate: the foot stands there twice, turned and moved
/// twice.
Handle(TDocStd_Document) nested() {
  NamedParts parts;
  const TopoDS_Shape post = BRepPrimAPI_MakeCylinder(8.0, 100.0).Shape();
  const TopoDS_Shape foot = BRepPrimAPI_MakeBox(gp_Pnt(-20, -15, -6), 40.0, 30.0, 6.0).Shape();
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(-80, -40, 0), 160.0, 80.0, 10.0).Shape();
  const TDF_Label frame = parts.assembly("frame"), leg = parts.assembly("leg");
  const TDF_Label post_part = parts.solid("post", post), foot_part = parts.solid("foot", foot);
  const TDF_Label plate_part = parts.solid("plate", plate);
  parts.place(leg, post_part, TopLoc_Location(), "post");
  parts.place(leg, foot_part, placed(gp::DZ(), 30.0, gp_Vec(2, 1, 0)), "foot");
  parts.place(frame, leg, placed(gp::DY(), 10.0, gp_Vec(-60, 0, 0)), "left leg");
  parts.place(frame, leg, placed(gp_Dir(1, 2, 3), -25.0, gp_Vec(60, 5, 0)), "right leg");
  parts.place(frame, plate_part, placed(gp::DX(), 5.0, gp_Vec(0, 0, 110)), "table");
  parts.colour(post_part, "808080");
  parts.colour(foot_part, "2A9D8F");
  parts.name_face(foot_part, face(foot, 5), "sole");
  parts.name_face(plate_part, face(plate, 6), "top");
  parts.colour_face(plate_part, face(plate, 6), "FF8800");
  parts.colour_face(plate_part, face(plate, 1), "0000FF");
  return parts.document();
}

}  // namespace

std::vector<Assembly> assemblies() {
  return {{"nested.step", "two levels, one part in several places, turned; names and colours", nested},
          {"nested.igs", "the same as faces in groups; inches", nested},
          {"hopper.step", "a whole bin with flange and chute, blends of high degree", hopper}};
}

}  // namespace step_parts
