// SPDX-License-Identifier: GPL-2.0-or-later
// A named material point whose displacement is recorded: nodes of any body, and weights.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "nurbs/boundary.h"
#include "nurbs/patch.h"

namespace structure {

struct Probe {
  std::string name;
  std::vector<int> nodes;
  std::vector<double> weights;  ///< R_A at the point [-], one per node

  /// Value there of a nodal field q (3 x n).
  nurbs::Vector3 value(const nurbs::NodalVectors& q) const;
};

/// The point of a volume at parameters xi.
Probe probe_at(std::string name, const nurbs::Space<3>& volume, const nurbs::Parameter<3>& xi);

/// The point of a face at relative parameters `at`, each 0 to 1, of the volume's two other directions in
/// rising order. Throws std::invalid_argument if they lie outside.
nurbs::Parameter<3> face_point(const nurbs::Space<3>& volume, nurbs::Face face,
                               const std::array<double, 2>& at);

}  // namespace structure
