// SPDX-License-Identifier: GPL-2.0-or-later
#include "look.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <map>
#include <ostream>

#include "read_plainly.h"

namespace step_parts {
namespace {

TopTools_IndexedMapOfShape all(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map;
}

std::string kind_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  const auto degrees = [&surface](const char* name) {
    return name + (" " + std::to_string(surface.UDegree())) + "x" + std::to_string(surface.VDegree()) +
           (surface.IsURational() || surface.IsVRational() ? " rational" : "") +
           (surface.IsUPeriodic() ? " periodic u" : "") + (surface.IsVPeriodic() ? " periodic v" : "");
  };
  switch (surface.GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
      return degrees("Bezier");
    case GeomAbs_BSplineSurface:
      return degrees("spline");
    case GeomAbs_SurfaceOfRevolution:
      return "revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "extrusion";
    case GeomAbs_OffsetSurface:
      return "offset";
    default:
      return "other";
  }
}

struct EdgeCounts {
  int all = 0, seams = 0, degenerate = 0, free = 0, pcurve_degree = 0;
};

EdgeCounts edges_of(const TopoDS_Shape& shape) {
  EdgeCounts counts;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int i = 1; i <= faces_of.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of.FindKey(i));
    ++counts.all;
    counts.degenerate += BRep_Tool::Degenerated(edge);
    const TopTools_ListOfShape& faces = faces_of(i);
    const bool seam = !faces.IsEmpty() && BRep_Tool::IsClosed(edge, TopoDS::Face(faces.First()));
    counts.seams += seam;
    counts.free += faces.Extent() == 1 && !seam && !BRep_Tool::Degenerated(edge);
    for (const TopoDS_Shape& face : faces) {
      double first, last;
      const auto curve = Handle(Geom2d_BSplineCurve)::DownCast(
          BRep_Tool::CurveOnSurface(edge, TopoDS::Face(face), first, last));
      if (!curve.IsNull()) counts.pcurve_degree = std::max(counts.pcurve_degree, curve->Degree());
    }
  }
  return counts;
}

}  // namespace

void look(const std::string& file, std::ostream& out) {
  const TopoDS_Shape shape = read_plainly(file);
  std::map<std::string, int> kinds;
  const TopTools_IndexedMapOfShape faces = all(shape, TopAbs_FACE);
  for (int i = 1; i <= faces.Extent(); ++i) ++kinds[kind_of(TopoDS::Face(faces(i)))];
  out << file.substr(file.rfind('/') + 1) << ": " << all(shape, TopAbs_SOLID).Extent() << " solids, "
      << faces.Extent() << " faces (";
  const char* comma = "";
  for (const auto& [kind, count] : kinds) {
    out << comma << count << " " << kind;
    comma = ", ";
  }
  const EdgeCounts edges = edges_of(shape);
  out << "), " << edges.all << " edges (" << edges.seams << " seams, " << edges.degenerate << " degenerate, "
      << edges.free << " free), splines in (u, v) to degree " << edges.pcurve_degree << ", tolerance "
      << ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1) << " mm, "
      << (BRepCheck_Analyzer(shape).IsValid() ? "valid" : "INVALID") << '\n';
}

}  // namespace step_parts
