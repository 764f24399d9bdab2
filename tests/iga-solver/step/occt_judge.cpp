// SPDX-License-Identifier: GPL-2.0-or-later
#include "occt_judge.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <stdexcept>
#include <vector>

#include "read_plainly.h"

namespace step_parts {

struct OcctJudge::Shapes {
  TopoDS_Shape whole;
  TopoDS_Compound skin;  ///< the faces alone: from within a solid the distance from it is zero
  std::vector<TopoDS_Face> faces;
  std::vector<TopoDS_Shape> solids;
  std::vector<std::unique_ptr<BRepClass3d_SolidClassifier>> solid_classifiers;
  std::vector<std::unique_ptr<BRepTopAdaptor_FClass2d>> polygons;
};

namespace {

Place place(TopAbs_State state) {
  switch (state) {
    case TopAbs_IN:
      return Place::kIn;
    case TopAbs_ON:
      return Place::kOn;
    case TopAbs_OUT:
      return Place::kOut;
    default:
      return Place::kUnknown;
  }
}

gp_Pnt point_of(const Point& p) { return {p[0], p[1], p[2]}; }
Point point_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

Nearest nearest_of(const TopoDS_Shape& shape, const Point& point) {
  const BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(point_of(point)).Vertex(), shape);
  if (!distance.IsDone() || distance.NbSolution() == 0) {
    throw std::runtime_error("BRepExtrema_DistShapeShape found no distance");
  }
  return {distance.Value(), point_of(distance.PointOnShape2(1))};
}

TopTools_IndexedMapOfShape all(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map;
}

}  // namespace

OcctJudge::OcctJudge(const std::string& file) : shapes_(std::make_unique<Shapes>()) {
  shapes_->whole = read_plainly(file);
  const auto faces = all(shapes_->whole, TopAbs_FACE), solids = all(shapes_->whole, TopAbs_SOLID);
  BRep_Builder builder;
  builder.MakeCompound(shapes_->skin);
  for (int i = 1; i <= faces.Extent(); ++i) {
    shapes_->faces.push_back(TopoDS::Face(faces(i)));
    shapes_->polygons.push_back(std::make_unique<BRepTopAdaptor_FClass2d>(shapes_->faces.back(), 1e-9));
    builder.Add(shapes_->skin, faces(i));
  }
  for (int i = 1; i <= solids.Extent(); ++i) {
    shapes_->solids.push_back(solids(i));
    shapes_->solid_classifiers.push_back(std::make_unique<BRepClass3d_SolidClassifier>(solids(i)));
  }
}

OcctJudge::~OcctJudge() = default;

int OcctJudge::face_count() const { return static_cast<int>(shapes_->faces.size()); }
int OcctJudge::solid_count() const { return static_cast<int>(shapes_->solids.size()); }
double OcctJudge::tolerance() const { return ShapeAnalysis_ShapeTolerance().Tolerance(shapes_->whole, 1); }

double OcctJudge::volume(int solid) const {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shapes_->solids.at(solid), properties, 1e-9);
  return properties.Mass();
}

double OcctJudge::area(int face) const {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shapes_->faces.at(face), properties, 1e-9);
  return properties.Mass();
}

Nearest OcctJudge::nearest(const Point& point) const { return nearest_of(shapes_->skin, point); }

Nearest OcctJudge::nearest_on(int face, const Point& point) const {
  return nearest_of(shapes_->faces.at(face), point);
}

Place OcctJudge::in_solid(int solid, const Point& point, double tolerance) const {
  BRepClass3d_SolidClassifier& classifier = *shapes_->solid_classifiers.at(solid);
  classifier.Perform(point_of(point), tolerance);
  return place(classifier.State());
}

Window OcctJudge::window(int face) const {
  Window window{};
  BRepTools::UVBounds(shapes_->faces.at(face), window.u[0], window.u[1], window.v[0], window.v[1]);
  return window;
}

Point OcctJudge::value(int face, double u, double v) const {
  return point_of(BRepAdaptor_Surface(shapes_->faces.at(face), false).Value(u, v));
}

Place OcctJudge::in_face(int face, double u, double v, double tolerance) const {
  return place(BRepClass_FaceClassifier(shapes_->faces.at(face), gp_Pnt2d(u, v), tolerance).State());
}

Place OcctJudge::in_face_by_polygon(int face, double u, double v) const {
  return place(shapes_->polygons.at(face)->Perform(gp_Pnt2d(u, v)));
}

}  // namespace step_parts
