// SPDX-License-Identifier: GPL-2.0-or-later
// What is refused of IGES.  Numbers of types are those of IGES 5.3.
#include <fmt/format.h>

#include <IGESCAFControl.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGraph_Color.hxx>
#include <Interface_Check.hxx>
#include <Quantity_Color.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <gp_GTrsf.hxx>
#include <gp_Mat.hxx>
#include <initializer_list>
#include <stdexcept>

#include "geometry_io/step_entities.h"

namespace geometry_io {
namespace {

using Entity = Handle(IGESData_IGESEntity);

constexpr int kSubfigure = 408, kGroup = 402, kSolidInstance = 430;

bool is_one_of(int type, std::initializer_list<int> types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

// Curves and surfaces, shells and solids, and what places them.
bool is_of_a_shape(int type) {
  return type < 200 || type / 100 == 5 || is_one_of(type, {kGroup, kSubfigure, kSolidInstance});
}

// Lines, planes and splines, whose points say all, and surfaces of revolution, which OpenCASCADE itself
// writes so.  Of circles that are mirrored it takes the wrong part.
bool may_be_mirrored(int type) { return is_one_of(type, {106, 108, 110, 116, 120, 126, 128}); }

// Curves on surfaces; solids, and what shells consist of.
bool is_left_in_place(int type) { return is_one_of(type, {141, 142, 186, 502, 504, 508, 510, 514}); }

// Trimmed and bounded surfaces, faces of solids.
bool is_a_face(int type) { return is_one_of(type, {143, 144, 510}); }

int colour_of(const Entity& entity) {
  const auto byte = [](double share) {
    return static_cast<int>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
  };
  const auto own = Handle(IGESGraph_Color)::DownCast(entity->Color());
  double r = 0.0, g = 0.0, b = 0.0;
  if (!own.IsNull()) {
    own->RGBIntensity(r, g, b);  // per cent
    return (byte(0.01 * r) << 16) | (byte(0.01 * g) << 8) | byte(0.01 * b);
  }
  if (entity->RankColor() <= 0) return -1;
  IGESCAFControl::DecodeColor(entity->RankColor()).Values(r, g, b, Quantity_TOC_sRGB);
  return (byte(r) << 16) | (byte(g) << 8) | byte(b);
}

// A name, or else a label of up to 8 letters.  OpenCASCADE adds the label's number; 0 is none.
std::string name_of(const Entity& entity) {
  if (!entity->HasName()) return "";
  std::string name = entity->NameValue()->ToCString();
  const std::string no_number = "(0)";
  if (entity->HasSubScriptNumber() && name.size() >= no_number.size() &&
      name.compare(name.size() - no_number.size(), no_number.size(), no_number) == 0)
    name.erase(name.size() - no_number.size());
  return name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
}

void note(const TopoDS_Shape& face, const Entity& entity, StepLabels& labels) {
  StepLabel* known = labels.ChangeSeek(face);
  if (known == nullptr) known = labels.Bound(face, {});
  const std::string name = name_of(entity);
  const int colour = colour_of(entity);
  if (!name.empty()) known->name = name;
  if (colour >= 0) known->colour = colour;
}

// Of the matrix of its place; empty: none.
std::string problem_of_place(const Entity& entity) {
  constexpr double kSame = 1e-6;  // matrices are written with so many digits at least
  if (!entity->HasTransf()) return "";
  const gp_GTrsf place = entity->Location();
  const gp_Mat turn = place.VectorialPart();
  const gp_Mat square = turn.Transposed().Multiplied(turn);
  double off = 0.0, moved = place.TranslationPart().Modulus();
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 3; ++j) {
      const double one = i == j ? 1.0 : 0.0;
      off = std::max(off, std::abs(square(i, j) - one));
      moved = std::max(moved, std::abs(turn(i, j) - one));
    }
  if (!(off <= kSame))
    return "placed by a matrix that scales or skews, expected one that turns and shifts: export the part in "
           "its own size";
  if (turn.Determinant() < 0.0 && !may_be_mirrored(entity->TypeNumber()))
    return "placed as a mirror image, expected a matrix that turns and shifts: export the mirrored part as "
           "one of its own";
  if (is_left_in_place(entity->TypeNumber()) && moved > 0.0)
    return "placed by a matrix, which OpenCASCADE leaves out, expected it where it is: export it without";
  return "";
}

std::string named(const Handle(IGESData_IGESModel) & model, const Entity& entity) {
  return fmt::format("entity D{} (of type {})", 2 * model->Number(entity) - 1, entity->TypeNumber());
}

}  // namespace

void refuse_broken_entities(const IGESControl_Reader& reader) {
  const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Entity(i);
    if (!is_of_a_shape(entity->TypeNumber())) continue;
    const Handle(Interface_Check) check = model->Check(i, true);
    if (check->HasFailed()) {
      std::string fail = check->CFail(1);
      for (int k = 2; k <= check->NbFails() && fail.find('%') != std::string::npos; ++k)
        fail = check->CFail(k);
      throw std::runtime_error(
          fmt::format("{}: {} Expected a whole entity: export the file again", named(model, entity), fail));
    }
    const std::string problem = problem_of_place(entity);
    if (!problem.empty()) throw std::runtime_error(fmt::format("{}: {}", named(model, entity), problem));
  }
}

void refuse_lost_entities(const IGESControl_Reader& reader) {
  const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Entity(i);
    const int type = entity->TypeNumber();
    const bool has_faces = (type >= 143 && type < 190) || type == kSubfigure || type == kSolidInstance;
    if (!has_faces) continue;
    const Handle(Transfer_Binder) binder = process->Find(entity);
    if (binder.IsNull() || TransferBRep::ShapeResult(binder).IsNull())
      throw std::runtime_error(named(model, entity) +
                               ": OpenCASCADE can make no shape of it, expected trimmed or bounded surfaces "
                               "(144, 143) or a solid of faces (186)");
  }
}

void note_entities(const IGESControl_Reader& reader, StepLabels& labels) {
  const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Entity(i);
    const Handle(Transfer_Binder) binder = process->Find(entity);
    if (!is_a_face(entity->TypeNumber()) || binder.IsNull()) continue;
    for (TopExp_Explorer it(TransferBRep::ShapeResult(binder), TopAbs_FACE); it.More(); it.Next())
      note(it.Current().Located(TopLoc_Location()), entity, labels);
  }
}

}  // namespace geometry_io
