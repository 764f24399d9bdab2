// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_document.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <BRep_Builder.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_ExternFile.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "geometry_io/step_entities.h"

namespace geometry_io {
namespace {

constexpr const char* kFormat = "BinXCAF";

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument(kFormat, document);
  return document;
}

// Of one line, without blanks around it.
std::string clean(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, ' ');
  name.erase(name.find_last_not_of(' ') + 1);
  return name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
}

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  TCollection_AsciiString text(name->Get());  // UTF-8
  return clean(text.ToCString());
}

// A name that a program made up: of an occurrence in STEP, of a label in OpenCASCADE, of a kind of shape.
bool says_something(const std::string& name) {
  static const std::regex made_up(
      "NAUO[0-9]*|=>\\[[0-9:]*\\]|[0-9]*|NONE|"
      "Open CASCADE STEP translator.*|(SOLID|COMPOUND|COMPSOLID|SHELL|FACE|ASSEMBLY|Assembly)");
  return !name.empty() && !std::regex_match(name, made_up);
}

int colour_of(const TDF_Label& label) {
  const Handle(XCAFDoc_ColorTool) tool = XCAFDoc_DocumentTool::ColorTool(label);
  for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
    Quantity_Color colour;
    if (!tool->GetColor(label, type, colour)) continue;
    double r, g, b;
    colour.Values(r, g, b, Quantity_TOC_sRGB);
    const auto byte = [](double x) { return static_cast<int>(std::lround(255.0 * std::clamp(x, 0.0, 1.0))); };
    return (byte(r) << 16) | (byte(g) << 8) | byte(b);
  }
  return -1;
}

// The tree of assemblies, down to bodies in their places.
class Collector {
 public:
  explicit Collector(StepDocument& out) : out_(out) {}

  void collect(const Handle(TDocStd_Document) & document) {
    TDF_LabelSequence roots;
    XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(roots);
    for (const TDF_Label& root : roots) add(root, TopLoc_Location(), "", -1);
  }

 private:
  void add(const TDF_Label& label, const TopLoc_Location& place, std::string path, int colour) {
    const auto enter = [&](const TDF_Label& at) {
      const std::string name = name_of(at);
      if (says_something(name) && path.substr(path.rfind('/') + 1) != name)
        path += (path.empty() ? "" : "/") + name;
      const int own = colour_of(at);
      if (own >= 0) colour = own;
    };
    TDF_Label shape = label;
    TopLoc_Location here = place;
    if (XCAFDoc_ShapeTool::IsReference(label)) {
      XCAFDoc_ShapeTool::GetReferredShape(label, shape);
      here = place * XCAFDoc_ShapeTool::GetLocation(label);
      // What the component's own colour says goes before that of its shape.
      enter(shape);
    }
    enter(label);
    if (XCAFDoc_ShapeTool::IsAssembly(shape)) {
      TDF_LabelSequence components;
      XCAFDoc_ShapeTool::GetComponents(shape, components);
      for (const TDF_Label& component : components) add(component, here, path, colour);
    } else {
      add_part(shape, here, path, colour);
    }
  }

  void add_part(const TDF_Label& label, const TopLoc_Location& place, const std::string& path, int colour) {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    if (shape.IsNull()) return;
    note_labels(label);
    const size_t before = out_.bodies.size();
    for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next()) {
      StepBody body{it.Current().Moved(place), path, colour, true};
      const TopoDS_Shape free = it.Current().Located(TopLoc_Location());
      for (const StepLabel* own : {solids_.Seek(free), out_.labels.Seek(free)}) {  // the same name as a rule
        if (own == nullptr) continue;
        if (own->colour >= 0) body.colour = own->colour;
        if (body.name == path && says_something(own->name) && path.substr(path.rfind('/') + 1) != own->name)
          body.name += (path.empty() ? "" : "/") + own->name;
      }
      out_.bodies.push_back(std::move(body));
    }
    TopoDS_Compound loose;
    BRep_Builder().MakeCompound(loose);
    bool any = false;
    for (const auto& [what, outside] :
         {std::pair{TopAbs_SHELL, TopAbs_SOLID}, std::pair{TopAbs_FACE, TopAbs_SHELL}})
      for (TopExp_Explorer it(shape, what, outside); it.More(); it.Next()) {
        BRep_Builder().Add(loose, it.Current().Moved(place));
        any = true;
      }
    if (any) out_.bodies.push_back({loose, path, colour, false});
    if (out_.bodies.size() == before)
      out_.healed.push_back(fmt::format("part '{}' has no faces and is left out", path));
  }

  // Names and colours of solids and faces that have labels of their own.
  void note_labels(const TDF_Label& part) {
    for (TDF_ChildIterator it(part); it.More(); it.Next()) {
      const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(it.Value());
      if (shape.IsNull()) continue;
      const TopoDS_Shape free = shape.Located(TopLoc_Location());
      const StepLabel label{name_of(it.Value()), colour_of(it.Value()), 0};
      if (shape.ShapeType() == TopAbs_FACE)
        note_face(free, label);
      else if (shape.ShapeType() == TopAbs_SOLID)
        solids_.Bind(free, label);
      else if (label.colour >= 0)  // of a shell
        for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
          note_face(face.Current().Located(TopLoc_Location()), {"", label.colour, 0});
    }
  }
  void note_face(const TopoDS_Shape& face, const StepLabel& label) {
    StepLabel* known = out_.labels.ChangeSeek(face);
    if (known == nullptr) known = out_.labels.Bound(face, {});
    if (!label.name.empty()) known->name = label.name;
    if (label.colour >= 0) known->colour = label.colour;
  }

  StepDocument& out_;
  StepLabels solids_;
};

// In lower case, written out.
std::string unit_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  static const std::map<std::string, std::string> abbreviated{
      {"mm", "millimetre"}, {"cm", "centimetre"}, {"m", "metre"}, {"in", "inch"}, {"ft", "foot"}};
  const auto found = abbreviated.find(name);
  return found == abbreviated.end() ? name : found->second;
}

std::string joined_units(const TColStd_SequenceOfAsciiString& names) {
  std::vector<std::string> all;
  for (const TCollection_AsciiString& name : names)
    if (std::find(all.begin(), all.end(), unit_name(name.ToCString())) == all.end())
      all.push_back(unit_name(name.ToCString()));
  return fmt::format("{}", fmt::join(all, ", "));
}

void refuse_external_files(const STEPCAFControl_Reader& reader) {
  std::vector<std::string> names;
  using Files = NCollection_DataMap<TCollection_AsciiString, Handle(STEPCAFControl_ExternFile)>;
  for (Files::Iterator it(reader.ExternFiles()); it.More(); it.Next())
    names.push_back(clean(it.Key().ToCString()));
  if (names.empty()) return;
  std::sort(names.begin(), names.end());
  throw std::runtime_error(fmt::format(
      "parts of the assembly are in other files ({}), expected one file with all of them: export it as such",
      fmt::join(names, ", ")));
}

StepDocument read_step_file(const std::string& bytes) {
  if (bytes.find("END-ISO-10303-21", bytes.size() - std::min<size_t>(bytes.size(), 4096)) ==
      std::string::npos)
    throw std::runtime_error("ends early: no END-ISO-10303-21 at its end, expected a whole file");
  STEPCAFControl_Controller::Init();  // before what follows, or it is lost
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetPropsMode(false);
  reader.SetGDTMode(false);
  reader.SetMatMode(false);
  std::istringstream stream(bytes);
  if (reader.ChangeReader().ReadStream("STEP", stream) != IFSelect_RetDone)
    throw std::runtime_error("damaged: OpenCASCADE cannot read it as STEP");
  refuse_broken_entities(reader.Reader());
  Handle(TDocStd_Document) document = new_document();
  const bool done = reader.Transfer(document);
  refuse_external_files(reader);
  if (!done)
    throw std::runtime_error("no shape in it that OpenCASCADE can make, expected solids, shells or faces");
  StepDocument out;
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
  out.unit = joined_units(lengths);
  if (out.unit.empty() || out.unit == "milli" || out.unit == "centi" || out.unit == "kilo")
    throw std::runtime_error("no unit of length in it, expected one");
  out.healed = messages_of(reader.Reader());
  const std::vector<std::string> split = note_entities(reader.Reader(), out.labels);
  out.healed.insert(out.healed.end(), split.begin(), split.end());
  Collector(out).collect(document);
  return out;
}

// The last line of 80 columns names section T.
bool has_end_of_iges(const std::string& bytes) {
  const size_t last = bytes.find_last_not_of(" \r\n");
  const size_t line = last == std::string::npos ? last : bytes.find_last_of("\r\n", last) + 1;
  return last != std::string::npos && last - line >= 72 && bytes[line + 72] == 'T';
}

StepDocument read_iges_file(const std::string& bytes) {
  if (!has_end_of_iges(bytes))
    throw std::runtime_error("no STEP, and no IGES that is whole: its last line is no section T");
  IGESCAFControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  const int file = memfd_create("iges", MFD_CLOEXEC);
  if (file < 0 || write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("no memory for a file");
  const IFSelect_ReturnStatus status = reader.ReadFile(fmt::format("/proc/self/fd/{}", file).c_str());
  ::close(file);
  if (status != IFSelect_RetDone) throw std::runtime_error("damaged: OpenCASCADE cannot read it as IGES");
  refuse_broken_entities(reader);
  Handle(TDocStd_Document) document = new_document();
  if (!reader.Transfer(document))
    throw std::runtime_error("no shape in it that OpenCASCADE can make, expected solids, shells or faces");
  refuse_lost_entities(reader);
  StepDocument out;
  out.iges = true;
  const auto model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  if (!model.IsNull() && !model->GlobalSection().UnitName().IsNull())
    out.unit = unit_name(clean(model->GlobalSection().UnitName()->ToCString()));
  out.healed = messages_of(reader);
  Collector(out).collect(document);
  note_entities(reader, out.labels);
  return out;
}

}  // namespace

StepDocument step_document(const std::string& bytes) {
  const std::string head = bytes.substr(0, 512);
  StepDocument out =
      head.find("ISO-10303-21") != std::string::npos ? read_step_file(bytes) : read_iges_file(bytes);
  if (out.bodies.empty()) throw std::runtime_error("no faces in it, expected solids, shells or faces");
  return out;
}

}  // namespace geometry_io
