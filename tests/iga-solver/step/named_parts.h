// SPDX-License-Identifier: GPL-2.0-or-later
// Documents of OpenCASCADE with named and coloured solids and faces.
#pragma once

#include <TDF_Label.hxx>
#include <TDocStd_Document.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>

namespace step_parts {

class NamedParts {
 public:
  NamedParts();

  TDF_Label assembly(const std::string& name);
  TDF_Label solid(const std::string& name, const TopoDS_Shape& shape);
  void place(const TDF_Label& assembly, const TDF_Label& part, const TopLoc_Location& where,
             const std::string& name);
  /// A solid or, with `face`, one of its faces.  `colour`: RRGGBB, as painters and browsers write it (sRGB).
  void name_face(const TDF_Label& solid, const TopoDS_Face& face, const std::string& name);
  void colour(const TDF_Label& solid, const std::string& colour);
  void colour_face(const TDF_Label& solid, const TopoDS_Face& face, const std::string& colour);
  Handle(TDocStd_Document) document();

 private:
  Handle(TDocStd_Document) document_;
};

}  // namespace step_parts
