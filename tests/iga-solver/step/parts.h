// SPDX-License-Identifier: GPL-2.0-or-later
// Parts on which the reading of CAD files and the search on their faces are tried, built with OpenCASCADE.
// Lengths in mm.
#pragma once

#include <TDocStd_Document.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

namespace step_parts {

struct Part {
  const char* file;                ///< its ending says STEP or IGES
  const char* hard;                ///< what is hard about it
  TopoDS_Shape (*shape)();         ///< mm
  const char* unit = "MM";         ///< of the file: MM, M or INCH
  const char* schema = "AP214IS";  ///< or AP203, AP242DIS; of IGES BREP for solids, else faces
};

/// With names, colours and placements.
struct Assembly {
  const char* file;
  const char* hard;
  Handle(TDocStd_Document) (*document)();  ///< mm
};

std::vector<Part> closed_form_parts();  ///< planes, cylinders, cones, spheres, tori
std::vector<Part> trimmed_parts();      ///< the same cut by each other, units
std::vector<Part> spline_parts();       ///< splines, revolved and extruded ones, offsets
std::vector<Part> blended_parts();      ///< fillets, lofts, sweeps
std::vector<Part> border_parts();       ///< tiny faces, gaps, edges that nearly vanish
std::vector<Assembly> assemblies();

}  // namespace step_parts
