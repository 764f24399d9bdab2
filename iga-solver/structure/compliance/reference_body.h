// SPDX-License-Identifier: GPL-2.0-or-later
// A solid as it is undeformed, all of it on every rank: what local compliances are worked out from.
#pragma once

#include <memory>
#include <vector>

#include "nurbs/patch.h"
#include "structure/body.h"
#include "structure/node_numbering.h"
#include "structure/solid/quadrature.h"

namespace structure {

struct ReferenceBody {
  std::vector<nurbs::Volume> patches;
  std::vector<std::shared_ptr<const Material>> materials;  ///< of each patch
  NodeNumbering nodes;                                     ///< of their control points
  Quadrature quadrature = Quadrature::full;                ///< of its internal forces

  /// Where a node stands [length].
  nurbs::Vector3 place(Id node) const {
    const auto [patch, control_point] = nodes.place(node);
    return patches[patch].control_points.col(control_point);
  }
};

/// An element of a body: counted as nurbs::Space does.
struct BodyElement {
  int patch, element;
  bool operator==(const BodyElement& other) const { return patch == other.patch && element == other.element; }
  bool operator<(const BodyElement& other) const {
    return patch != other.patch ? patch < other.patch : element < other.element;
  }
};

}  // namespace structure
