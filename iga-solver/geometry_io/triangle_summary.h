// SPDX-License-Identifier: GPL-2.0-or-later
// The triangles of a geometry, as nurbs-convert prints them.
#pragma once

#include <string>

#include "geometry_io/geometry_file.h"

namespace geometry_io {

/// All of them as one wall, whose edges that turn by less than `edge_angle` [rad] are smooth: lines that end
/// with a newline; empty if there are none.
std::string triangles_text(const GeometryFile& geometry, double edge_angle);

}  // namespace geometry_io
