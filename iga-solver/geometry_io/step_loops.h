// SPDX-License-Identifier: GPL-2.0-or-later
// The borders of a face of OpenCASCADE, closed loops in its parameters.
#pragma once

#include <GeomAdaptor_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

#include "geometry_io/step_faces.h"

namespace geometry_io {

/// A piece of a border in the sense of its loop, in (w u, w v, w).
struct RawTrim {
  AnySpline curve;
  TopoDS_Edge edge;     ///< null: made to close a gap
  bool forward = true;  ///< the edge's curve in space runs along it
  double gap = 0.0;     ///< from the edge in space, at the same parameters [mm]
  bool pole = false;    ///< the edge is nowhere in space
};
using RawLoop = std::vector<RawTrim>;

struct RawLoops {
  std::vector<RawLoop> loops;  ///< the face is at their left; the outer one is the first
  int fitted = 0;              ///< curves that were fitted anew
  double widest_gap = 0.0;     ///< that was closed by a straight piece [mm]
};

/// Of a face, whatever its orientation, in the parameters of its surface.  Throws std::runtime_error.
RawLoops loops_of(const TopoDS_Face& face, const GeomAdaptor_Surface& surface);
ParameterBox box_of(const std::vector<RawLoop>& loops);

/// In our parameters, the face at the left of them there.  `edge_number(trim)` from 0.  `fitted` counts
/// curves that the map does not leave splines, which are fitted within 1e-10 of the box.
std::vector<brep::Loop> mapped(const RawLoops& raw, const ReadSurface& surface, const ParameterBox& box,
                               const std::function<int(const RawTrim&)>& edge_number, int& fitted);
/// The box of loops, to some 1e-15 of its size.
void set_range(const std::vector<brep::Loop>& loops, brep::Face& face);

}  // namespace geometry_io
