// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_entities.h"

#include <fmt/format.h>

#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Direction.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_FaceBound.hxx>
#include <StepShape_FaceOuterBound.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <gp_XYZ.hxx>
#include <map>
#include <stdexcept>
#include <unordered_set>

#include "nurbs/usable_number.h"

namespace geometry_io {
namespace {

using Model = Handle(StepData_StepModel);

Model model_of(const STEPControl_Reader& reader) { return reader.StepModel(); }

bool begins(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

// Shapes and geometry: what is wrong with anything else does no harm to a wall.
bool matters(const Handle(Standard_Transient) & entity) {
  const std::string type = entity->DynamicType()->Name();
  return begins(type, "StepShape_") || begins(type, "StepGeom_");
}

std::string name_of(const Handle(StepRepr_RepresentationItem) & item) {
  return item->Name().IsNull() ? "" : item->Name()->ToCString();
}

// Colours, styles of lines.
bool is_drawn_only(const Handle(Standard_Transient) & entity) {
  return begins(entity->DynamicType()->Name(), "StepVisual_");
}

std::string named(const Model& model, const Handle(Standard_Transient) & entity) {
  const std::string type = model->TypeName(entity, false);
  return fmt::format("#{} ({})", model->IdentLabel(entity), type);
}

// Of a placement; an axis that is not given is that of space (ISO 10303-42, base_axis).
gp_XYZ axis_of(const Handle(StepGeom_Direction) & direction, const gp_XYZ& of_space) {
  if (direction.IsNull() || direction->NbDirectionRatios() != 3) return of_space;
  return {direction->DirectionRatiosValue(1), direction->DirectionRatiosValue(2),
          direction->DirectionRatiosValue(3)};
}

// OpenCASCADE leaves the scale out and turns what is mirrored.
std::string problem_of(const Handle(StepGeom_CartesianTransformationOperator3d) & placement) {
  constexpr double kSame = 1e-12;
  if (placement->HasScale() && std::abs(placement->Scale() - 1.0) > kSame)
    return fmt::format("a part placed with the scale {}, expected 1: export the part in its own size",
                       placement->Scale());
  const gp_XYZ x = axis_of(placement->Axis1(), {1.0, 0.0, 0.0}),
               y = axis_of(placement->Axis2(), {0.0, 1.0, 0.0}),
               z = axis_of(placement->Axis3(), {0.0, 0.0, 1.0});
  if (x.Dot(y.Crossed(z)) < 0.0)
    return "a part placed as a mirror image, expected right-handed axes: export the mirrored part as one of "
           "its own";
  return "";
}

// OpenCASCADE takes these and then does not end, or makes up something.
std::string problem_of(const Handle(Standard_Transient) & entity) {
  if (const auto point = Handle(StepGeom_CartesianPoint)::DownCast(entity); !point.IsNull()) {
    for (int i = 1; i <= point->NbCoordinates(); ++i)
      if (const double x = point->CoordinatesValue(i); !nurbs::is_usable(x))
        return fmt::format("coordinate {}, expected a finite number of at most 1e+100", x);
  } else if (const auto direction = Handle(StepGeom_Direction)::DownCast(entity); !direction.IsNull()) {
    double square = 0.0;
    for (int i = 1; i <= direction->NbDirectionRatios(); ++i)
      square += direction->DirectionRatiosValue(i) * direction->DirectionRatiosValue(i);
    if (!(square > 0.0 && nurbs::is_usable(square))) return "a direction of no length, expected one";
  } else if (const auto placement = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(entity);
             !placement.IsNull()) {
    return problem_of(placement);
  }
  return "";
}

std::string first_fail(const Handle(Interface_Check) & check) {
  return check->NbFails() > 0 ? check->CFail(1) : "";
}

using Process = Handle(Transfer_TransientProcess);

TopoDS_Shape result_of(const Process& process, const Handle(Standard_Transient) & entity) {
  const Handle(Transfer_Binder) binder = process->Find(entity);
  return binder.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(binder);
}

// Edges of what became of a face, as its loops run about the normal of its surface.
using Edges = std::multimap<int, bool>;  // number in a map of edges; forward
Edges edges_of(const TopoDS_Shape& faces, TopTools_IndexedMapOfShape& numbers) {
  Edges edges;
  for (TopExp_Explorer face(faces, TopAbs_FACE); face.More(); face.Next())
    for (TopExp_Explorer it(face.Current().Oriented(TopAbs_FORWARD), TopAbs_EDGE); it.More(); it.Next())
      edges.emplace(numbers.Add(it.Current()), it.Current().Orientation() == TopAbs_FORWARD);
  return edges;
}

// OpenCASCADE turns loops round that have the face outside of them all, as if the file meant that.
bool is_turned_round(const Process& process, const Handle(StepShape_FaceSurface) & face,
                     const TopoDS_Shape& result) {
  TopTools_IndexedMapOfShape numbers;
  const Edges edges = edges_of(result, numbers);
  int turned = 0;
  for (int b = 1; b <= face->NbBounds(); ++b) {
    const Handle(StepShape_FaceBound) bound = face->BoundsValue(b);
    const auto loop = Handle(StepShape_EdgeLoop)::DownCast(bound->Bound());
    if (loop.IsNull() || bound->IsKind(STANDARD_TYPE(StepShape_FaceOuterBound))) return false;
    for (int i = 1; i <= loop->NbEdgeList(); ++i) {
      const Handle(StepShape_OrientedEdge) use = loop->EdgeListValue(i);
      const auto curve = Handle(StepShape_EdgeCurve)::DownCast(use->EdgeElement());
      const int number = curve.IsNull() ? 0 : numbers.FindIndex(result_of(process, curve));
      if (number == 0 || edges.count(number) != 1) continue;  // a seam, or made anew
      bool along = use->Orientation() == bound->Orientation();
      if (!curve->SameSense()) along = !along;
      if (!face->SameSense()) along = !along;
      if (edges.find(number)->second == along) return false;
      ++turned;
    }
  }
  return turned > 0;
}

}  // namespace

void refuse_broken_entities(const STEPControl_Reader& reader) {
  const Model model = model_of(reader);
  if (model.IsNull() || model->NbEntities() == 0)
    throw std::runtime_error("no entity in it, expected STEP with a DATA section");
  std::unordered_set<int> numbers;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Interface_Check) check = model->Check(i, true);
    const Handle(Standard_Transient) entity = model->Value(i);
    if (check->HasFailed() && (matters(entity) || (model->IsRedefinedContent(i) && !is_drawn_only(entity))))
      throw std::runtime_error(fmt::format("{}: {}", named(model, entity), first_fail(check)));
    const std::string problem = problem_of(entity);
    if (!problem.empty()) throw std::runtime_error(fmt::format("{}: {}", named(model, entity), problem));
    const int number = model->IdentLabel(entity);
    if (number > 0 && !numbers.insert(number).second)
      throw std::runtime_error(named(model, entity) + ": a number that two entities have, expected one");
  }
}

namespace {

// OpenCASCADE leaves an open one at the faces, and of a part's only solid it keeps the part's name alone.
void note_solids(const Model& model, const Process& process, StepLabels& labels,
                 std::vector<std::string>& lines) {
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const auto solid = Handle(StepShape_ManifoldSolidBrep)::DownCast(process->Mapped(i));
    if (solid.IsNull()) continue;
    const TopoDS_Shape shape = result_of(process, solid);
    if (!shape.IsNull() && !TopExp_Explorer(shape, TopAbs_SOLID).More())
      lines.push_back(named(model, solid) + " encloses nothing: it is a sheet, not a body");
    for (TopExp_Explorer it(shape, TopAbs_SOLID); !shape.IsNull() && it.More(); it.Next())
      labels.Bind(it.Current().Located(TopLoc_Location()), {name_of(solid), -1, model->IdentLabel(solid)});
  }
}

}  // namespace

std::vector<std::string> note_entities(const STEPControl_Reader& reader, StepLabels& labels) {
  std::vector<std::string> lines;
  const Model model = model_of(reader);
  const Process process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(process->Mapped(i));
    if (face.IsNull()) continue;
    const Handle(Transfer_Binder) binder = process->MapItem(i);
    const TopoDS_Shape shape = binder.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(binder);
    if (shape.IsNull())
      throw std::runtime_error(fmt::format(
          "{}: OpenCASCADE can make no face of it{}", named(model, face),
          binder.IsNull() || !binder->Check()->HasFailed() ? "" : ": " + first_fail(binder->Check())));
    if (is_turned_round(process, face, shape))
      throw std::runtime_error(
          named(model, face) +
          ": its borders are holes, with the face outside of them, expected an outer border that has the "
          "face at its left: put it back, or export the part again");
    int count = 0;
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next(), ++count)
      labels.Bind(it.Current().Located(TopLoc_Location()), {name_of(face), -1, model->IdentLabel(face)});
    if (count != 1) lines.push_back(fmt::format("{} became {} faces", named(model, face), count));
  }
  note_solids(model, process, labels, lines);
  return lines;
}

std::vector<std::string> messages_of(const XSControl_Reader& reader) {
  std::map<std::string, int> count;
  const Process process = reader.WS()->TransferReader()->TransientProcess();
  Interface_CheckIterator checks = process->CheckList(false);
  for (checks.Start(); checks.More(); checks.Next()) {
    const Handle(Interface_Check)& check = checks.Value();
    for (int i = 1; i <= check->NbWarnings(); ++i) ++count[check->CWarning(i)];
    for (int i = 1; i <= check->NbFails(); ++i) ++count[check->CFail(i)];
  }
  std::vector<std::string> lines;
  for (const auto& [text, times] : count) lines.push_back(fmt::format("{} x {}", times, text));
  return lines;
}

}  // namespace geometry_io
