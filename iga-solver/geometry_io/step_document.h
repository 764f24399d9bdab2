// SPDX-License-Identifier: GPL-2.0-or-later
// A STEP or IGES file as OpenCASCADE has read it: bodies and sheets in their places, with names and colours.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "geometry_io/step_label.h"

namespace geometry_io {

/// A solid, or the faces of a component that are of none.
struct StepBody {
  TopoDS_Shape shape;  ///< in its place
  std::string name;    ///< assembly/component/solid
  int colour = -1;
  bool solid = false;
};

struct StepDocument {
  std::vector<StepBody> bodies;
  StepLabels labels;  ///< of faces and solids, without their places
  std::string unit;   ///< of length
  bool iges = false;
  std::vector<std::string> healed;
};

/// Lengths in mm, placements in the shapes.  Throws std::runtime_error, also if an external reference is
/// missing or nothing was read.
StepDocument step_document(const std::string& bytes);

}  // namespace geometry_io
