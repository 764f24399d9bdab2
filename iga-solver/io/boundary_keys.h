// SPDX-License-Identifier: GPL-2.0-or-later
// The key `boundary` of a model file: what holds a solid, or moves it.
//   - {name: clamp, fix: [x, y, z], faces: [xi-]}
//   - {symmetry: eta-}                                          an axis-parallel plane face, along its normal
//   - {name: ground, spring: {stiffness: 1e9, direction: [0, 0, 1], per: area}, faces: [zeta-]}
//   - {name: shaker, move: {z: 1e-3}, faces: [zeta-], time: {sine: {frequency: 50}}}
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/selection.h"
#include "structure/body.h"
#include "structure/conditions/named_support.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"

namespace io {

/// One entry.
struct BoundaryEntry {
  std::string name;  ///< empty: reactions are not recorded
  Selection where;
  structure::Directions directions;
  bool is_symmetry = false;
  bool moves = false;
  Vector3 displacement = Vector3::Zero();  ///< of what moves, times the factor [length]
  structure::TimeFunction time = {};
  std::optional<structure::Stiffness3> spring = {};  ///< per area [force/length^3] or node [force/length]
  bool per_area = false;
  structure::NodeSet nodes = {};  ///< of the whole body, there
};

/// Throws geometry_io::InputError.
std::vector<BoundaryEntry> read_boundary(const std::vector<geometry_io::YamlMap>& entries,
                                         const geometry_io::GeometryFile& geometry,
                                         const structure::NodeNumbering& nodes);

/// Those entries that are springs, each a group, on the columns of a part.
structure::Springs springs_of(const std::vector<BoundaryEntry>& boundary,
                              const geometry_io::GeometryFile& geometry,
                              const structure::NodeNumbering& nodes,
                              const std::vector<structure::Id>& columns);

/// A degree of freedom that several entries hold is the first one's.
structure::Supports supports_of(const std::vector<BoundaryEntry>& boundary);
/// Those with names.
std::vector<structure::NamedSupport> named_supports(const std::vector<BoundaryEntry>& boundary);

}  // namespace io
