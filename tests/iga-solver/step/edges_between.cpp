// SPDX-License-Identifier: GPL-2.0-or-later
#include "edges_between.h"

#include <BRepAdaptor_Surface.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>

namespace step_parts {

std::vector<TopoDS_Edge> edges_between(const TopoDS_Shape& shape, GeomAbs_SurfaceType a,
                                       GeomAbs_SurfaceType b) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  std::vector<TopoDS_Edge> edges;
  for (int i = 1; i <= faces_of.Extent(); ++i) {
    const TopTools_ListOfShape& faces = faces_of(i);
    if (faces.Extent() != 2 || faces.First().IsSame(faces.Last())) continue;
    const auto first = BRepAdaptor_Surface(TopoDS::Face(faces.First())).GetType();
    const auto last = BRepAdaptor_Surface(TopoDS::Face(faces.Last())).GetType();
    if ((first == a && last == b) || (first == b && last == a))
      edges.push_back(TopoDS::Edge(faces_of.FindKey(i)));
  }
  return edges;
}

}  // namespace step_parts
