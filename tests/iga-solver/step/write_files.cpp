// SPDX-License-Identifier: GPL-2.0-or-later
#include "write_files.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <StlAPI_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <stdexcept>

#include "read_plainly.h"

namespace step_parts {
namespace {

Handle(TCollection_HAsciiString) text(const char* words) { return new TCollection_HAsciiString(words); }

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw std::runtime_error(file + ": " + what);
}

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Without the time of day.
void set_header(const Handle(StepData_StepModel) & model, const char* file) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(file));
  header.SetTimeStamp(text("2026-01-01T00:00:00"));
}

void write_step(const Part& part, const TopoDS_Shape& shape, const std::string& path) {
  STEPControl_Controller::Init();
  // Lengths are scaled by the unit that is set when the writer is made.
  Interface_Static::SetCVal("write.step.unit", part.unit);
  Interface_Static::SetCVal("write.step.product.name", part.file);
  Interface_Static::SetCVal("write.step.schema", part.schema);
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) fail(path, "cannot be translated");
  set_header(writer.Model(), part.file);
  if (writer.Write(path.c_str()) != IFSelect_RetDone) fail(path, "cannot be written");
}

void set_header(const Handle(IGESData_IGESModel) & model, const std::string& path) {
  IGESData_GlobalSection global = model->GlobalSection();
  global.SetDate(text("20260101.000000"));
  global.SetLastChangeDate(text("20260101.000000"));
  global.SetFileName(text(name_of(path).c_str()));
  model->SetGlobalSection(global);
}

void write_iges(const Part& part, const TopoDS_Shape& shape, const std::string& path) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", std::string(part.schema) == "BREP" ? 1 : 0);
  if (!writer.AddShape(shape)) fail(path, "cannot be translated");
  set_header(writer.Model(), path);
  if (!writer.Write(path.c_str())) fail(path, "cannot be written");
}

/// Faces in groups.
void write_iges_document(const Assembly& assembly, const std::string& path) {
  silence();
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("write.iges.unit", "INCH");
  IGESCAFControl_Writer writer;
  writer.SetColorMode(true);
  writer.SetNameMode(true);
  if (!writer.Transfer(assembly.document())) fail(path, "cannot be translated");
  set_header(writer.Model(), path);
  if (!writer.Write(path.c_str())) fail(path, "cannot be written");
}

/// With `prefix` each solid in its own file, whose name begins so, beside `path`.
void write_document(const Assembly& assembly, const std::string& path, const char* prefix) {
  silence();
  STEPCAFControl_Controller::Init();  // or the next word is not known
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  STEPCAFControl_Writer writer;
  if (!writer.Transfer(assembly.document(), STEPControl_AsIs, prefix)) fail(path, "cannot be translated");
  set_header(writer.ChangeWriter().Model(), name_of(path).c_str());
  if (writer.Write(path.c_str()) != IFSelect_RetDone) fail(path, "cannot be written");
}

}  // namespace

void write(const Part& part, const TopoDS_Shape& shape, const std::string& path) {
  silence();
  path.substr(path.rfind('.')) == ".igs" ? write_iges(part, shape, path) : write_step(part, shape, path);
}

void write(const Part& part, const std::string& folder) {
  write(part, part.shape(), folder + "/" + part.file);
}

void write(const Assembly& assembly, const std::string& folder) {
  const std::string path = folder + "/" + assembly.file;
  path.substr(path.rfind('.')) == ".igs" ? write_iges_document(assembly, path)
                                         : write_document(assembly, path, nullptr);
}

void write_by_reference(const Assembly& assembly, const std::string& path) {
  const std::string file = name_of(path), stem = file.substr(0, file.rfind('.'));
  write_document(assembly, path, (stem + "_").c_str());
}

void write_stl(const std::string& step_file, double deviation, const std::string& stl_file) {
  const TopoDS_Shape shape = read_plainly(step_file);
  constexpr double kAngle = 1.0;  // rad: left to the deviation but for the coarsest
  BRepMesh_IncrementalMesh mesh(shape, deviation, false, kAngle);
  StlAPI_Writer writer;
  writer.ASCIIMode() = false;
  if (!writer.Write(shape, stl_file.c_str())) fail(stl_file, "cannot be written");
}

}  // namespace step_parts
