// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles with a value each, as cells of a file.
#pragma once

#include <vector>

#include "nurbs/tessellation.h"
#include "vtk/bezier_cells.h"

namespace vtk {

struct TriangleFields {
  nurbs::TriangleMesh mesh;  ///< where it is drawn
  std::vector<Field> cells;  ///< components x triangles
};

/// Flat triangles of VTK, without weights and degrees.  Throws std::invalid_argument if a field does not fit
/// the triangles or is not finite.
BezierCells triangle_cells(const TriangleFields& triangles);

}  // namespace vtk
