// SPDX-License-Identifier: GPL-2.0-or-later
// What is inside a geometry, for people.
#pragma once

#include <string>

#include "geometry_io/geometry_file.h"

namespace geometry_io {

/// Patches with degrees, sizes, extents, area or volume and continuity at interior knots; how their edges
/// meet; and the named surfaces.  Several lines.
std::string summary(const GeometryFile& geometry);
/// The same; edges between triangles that turn by less than `edge_angle` [rad] are smooth.
std::string summary(const GeometryFile& geometry, double edge_angle);

}  // namespace geometry_io
