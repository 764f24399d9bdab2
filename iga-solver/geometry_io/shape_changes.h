// SPDX-License-Identifier: GPL-2.0-or-later
// What the key `geometry` says of patches beside their shape, in the order in which it is done:
//   refine: {degree: 3, divide: [2, 2, 1], knots: [[0.1, 0.9], [], []]}
//       raised to the degree (p-refinement), then each element divided into so many equal ones, then knots
//       inserted (h-refinement); both after the degree was raised: k-refinement, as smooth as can be.  One
//       number is for all directions.  The shape stays as it is, exactly.
//   scale: 0.001          # or one factor per coordinate; about the origin of the coordinates
//   rotate: {origin: [x,y,z], axis: [x,y,z], angle: degrees}     # by the right hand; the origin may be left
//   out move: [x,y,z]
// Source: Hughes, Cottrell & Bazilevs (2005), section 2.1 (h, p, k).
#pragma once

#include <string>
#include <vector>

#include "geometry_io/named_surface.h"
#include "geometry_io/placement.h"
#include "geometry_io/yaml_map.h"

namespace geometry_io {

/// The four keys.
const std::vector<std::string>& change_words();

/// Throws InputError, with file and line.
/// The placement that was made of scale, rotate and move, for what else there is to place.
Placement change_shapes(const YamlMap& geometry, std::vector<Shape>& patches);
/// InputError if its scale makes of these extents a size that is no sane one.
void expect_scaled_size(const YamlMap& geometry, const nurbs::Vector3& extents);

}  // namespace geometry_io
