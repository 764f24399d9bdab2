// SPDX-License-Identifier: GPL-2.0-or-later
// The entities of a file and what OpenCASCADE has made of them.
#pragma once

#include <IGESControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <XSControl_Reader.hxx>
#include <string>
#include <vector>

#include "geometry_io/step_label.h"

namespace geometry_io {

/// Throws std::runtime_error "#12 (EDGE_CURVE): ..." if an entity of a shape or its geometry is wrong.
void refuse_broken_entities(const STEPControl_Reader& reader);
/// Entity "D5 (of type 128)", by the line of its directory; also one in a place that OpenCASCADE misses.
void refuse_broken_entities(const IGESControl_Reader& reader);
/// Throws likewise if a face or a solid, or a group of these, became no shape.
void refuse_lost_entities(const IGESControl_Reader& reader);
/// Numbers and names of the faces' entities.  Says which of them became several faces, and which solids are
/// none.  Throws std::runtime_error if one became no face, or has no border but holes.
std::vector<std::string> note_entities(const STEPControl_Reader& reader, StepLabels& labels);
/// Names and colours of the entities of faces, of which OpenCASCADE's documents lack some.
void note_entities(const IGESControl_Reader& reader, StepLabels& labels);
/// What OpenCASCADE warns of, a line for each kind, with its number.
std::vector<std::string> messages_of(const XSControl_Reader& reader);

}  // namespace geometry_io
