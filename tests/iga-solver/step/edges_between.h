// SPDX-License-Identifier: GPL-2.0-or-later
// Edges of a shape by what meets there.
#pragma once

#include <GeomAbs_SurfaceType.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace step_parts {

/// Those between a face of kind `a` and another of kind `b`, in the order of TopExp.
std::vector<TopoDS_Edge> edges_between(const TopoDS_Shape& shape, GeomAbs_SurfaceType a,
                                       GeomAbs_SurfaceType b);

}  // namespace step_parts
