// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <string>

namespace geometry_io {

/// What the file says of a face (or a solid).
struct StepLabel {
  std::string name;
  int colour = -1;  ///< 0xRRGGBB
  int entity = 0;   ///< #number
};
/// By shape, wherever it is.
using StepLabels = NCollection_DataMap<TopoDS_Shape, StepLabel, TopTools_ShapeMapHasher>;

}  // namespace geometry_io
