// SPDX-License-Identifier: GPL-2.0-or-later
// A STEP or IGES file as OpenCASCADE has read it: bodies and sheets in their places, with names and colours.
#pragma once

#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

namespace geometry_io {

/// What the file says of a face (or a solid).
struct StepLabel {
  std::string name;
  int colour = -1;  ///< 0xRRGGBB
  int entity = 0;   ///< #number
};
/// By shape, wherever it is.
using StepLabels = NCollection_DataMap<TopoDS_Shape, StepLabel, TopTools_ShapeMapHasher>;

/// A solid, or the faces of a component that are of none.
struct StepBody {
  TopoDS_Shape shape;  ///< in its place
  std::string name;    ///< assembly/component/solid
  int colour = -1;
  bool solid = false;
};

struct StepDocument {
  std::vector<StepBody> bodies;
  StepLabels labels;  ///< of faces, without their places
  std::string unit;   ///< of length
  bool iges = false;
  std::vector<std::string> healed;
};

/// Lengths in mm, placements in the shapes.  Throws std::runtime_error, also if an external reference is
/// missing or nothing was read.
StepDocument step_document(const std::string& bytes);

}  // namespace geometry_io
