// SPDX-License-Identifier: GPL-2.0-or-later
#include "read_plainly.h"

#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Reader.hxx>
#include <TopoDS_Iterator.hxx>
#include <stdexcept>

namespace step_parts {
namespace {

TopoDS_Shape read_with(XSControl_Reader& reader, const std::string& file) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) throw std::runtime_error(file + ": cannot be read");
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull() || !TopoDS_Iterator(shape).More()) throw std::runtime_error(file + ": has no shape");
  return shape;
}

bool is_iges(const std::string& file) {
  const std::string ending = file.substr(file.rfind('.') + 1);
  return ending == "igs" || ending == "iges";
}

}  // namespace

void silence() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream)); }

TopoDS_Shape read_plainly(const std::string& file) {
  silence();
  if (is_iges(file)) {
    IGESControl_Reader reader;
    return read_with(reader, file);
  }
  STEPControl_Reader reader;
  return read_with(reader, file);
}

}  // namespace step_parts
