// SPDX-License-Identifier: GPL-2.0-or-later
// The key `boundary` of a model file: what holds a solid, or moves it.
//   - {name: clamp, fix: [x, y, z], faces: [xi-]}
//   - {symmetry: eta-}                                          an axis-parallel plane face, along its normal
//   - {name: shaker, move: {z: 1e-3}, faces: [zeta-], time: {sine: {frequency: 50}}}
#pragma once

#include <string>
#include <vector>

#include "io/selection.h"
#include "structure/conditions/named_support.h"
#include "structure/conditions/supports.h"

namespace io {

/// One entry.
struct BoundaryEntry {
  std::string name;  ///< empty: reactions are not recorded
  Selection where;
  structure::Directions directions;
  bool moves = false;
  Vector3 displacement = Vector3::Zero();  ///< of what moves, times the factor [length]
  structure::TimeFunction time = {};
  structure::NodeSet nodes = {};  ///< of the whole body, there
};

/// Throws geometry_io::InputError.
std::vector<BoundaryEntry> read_boundary(const std::vector<geometry_io::YamlMap>& entries,
                                         const geometry_io::GeometryFile& geometry,
                                         const structure::NodeNumbering& nodes);

/// A degree of freedom that several entries hold is the first one's.
structure::Supports supports_of(const std::vector<BoundaryEntry>& boundary);
/// Those with names.
std::vector<structure::NamedSupport> named_supports(const std::vector<BoundaryEntry>& boundary);

}  // namespace io
