// SPDX-License-Identifier: GPL-2.0-or-later
// Sizes that lengths of a wall may have: products of several of them are numbers, too.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/named_surface.h"

namespace brep {
struct CadModel;
}  // namespace brep

namespace geometry_io {

constexpr double kSmallestSize = 1e-30, kLargestSize = 1e30;

/// Of a box about all control points and corners, and about the whole round faces of `cad`, if it is not
/// null: at least the size, and more by a few radii at most.
nurbs::Vector3 extents_of(const std::vector<Shape>& patches, const brep::CadModel* cad);

/// What is wrong with these extents, scaled: "2e-105 in size, expected ..."; empty if nothing is, or if they
/// are zero before.
std::string size_problem(const nurbs::Vector3& extents, const nurbs::Vector3& factors);

}  // namespace geometry_io
