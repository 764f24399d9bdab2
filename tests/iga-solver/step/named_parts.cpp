// SPDX-License-Identifier: GPL-2.0-or-later
#include "named_parts.h"

#include <Quantity_Color.hxx>
#include <TDataStd_Name.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <stdexcept>

namespace step_parts {
namespace {

Handle(XCAFDoc_ShapeTool) shapes(const Handle(TDocStd_Document) & document) {
  return XCAFDoc_DocumentTool::ShapeTool(document->Main());
}

void set_name(const TDF_Label& label, const std::string& name) { TDataStd_Name::Set(label, name.c_str()); }

Quantity_Color parsed(const std::string& colour) {
  Quantity_Color result;
  if (!Quantity_Color::ColorFromHex(colour.c_str(), result)) {
    throw std::invalid_argument("colour '" + colour + "': six hexadecimal digits expected");
  }
  return result;
}

}  // namespace

NamedParts::NamedParts() { XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_); }

TDF_Label NamedParts::assembly(const std::string& name) {
  const TDF_Label label = shapes(document_)->NewShape();
  set_name(label, name);
  return label;
}

TDF_Label NamedParts::solid(const std::string& name, const TopoDS_Shape& shape) {
  const TDF_Label label = shapes(document_)->AddShape(shape, false);
  set_name(label, name);
  return label;
}

void NamedParts::place(const TDF_Label& assembly, const TDF_Label& part, const TopLoc_Location& where,
                       const std::string& name) {
  set_name(shapes(document_)->AddComponent(assembly, part, where), name);
}

void NamedParts::name_face(const TDF_Label& solid, const TopoDS_Face& face, const std::string& name) {
  set_name(shapes(document_)->AddSubShape(solid, face), name);
}

void NamedParts::colour(const TDF_Label& solid, const std::string& colour) {
  XCAFDoc_DocumentTool::ColorTool(document_->Main())->SetColor(solid, parsed(colour), XCAFDoc_ColorSurf);
}

void NamedParts::colour_face(const TDF_Label& solid, const TopoDS_Face& face, const std::string& colour) {
  TDF_Label label;
  if (!shapes(document_)->FindSubShape(solid, face, label))
    label = shapes(document_)->AddSubShape(solid, face);
  XCAFDoc_DocumentTool::ColorTool(document_->Main())->SetColor(label, parsed(colour), XCAFDoc_ColorSurf);
}

Handle(TDocStd_Document) NamedParts::document() {
  shapes(document_)->UpdateAssemblies();
  return document_;
}

}  // namespace step_parts
