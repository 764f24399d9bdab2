// SPDX-License-Identifier: GPL-2.0-or-later
// The bodies that all methods are timed on.
#pragma once

#include <array>
#include <string>

#include "nurbs/patch.h"

namespace benchmarks {

constexpr double kThickness = 0.0501;  // [m]

/// The plate of the paper's Table 2, 0.61 x 0.61 m, kThickness: "plate" (affine), "distorted" (polynomial, no
/// two elements alike) or "rational" (weights of 0.9 to 1.1).  Throws std::invalid_argument for another name.
nurbs::Volume make_volume(const std::string& name, const std::array<int, 3>& elements, int degree);

/// Pseudo-random nodal displacements of up to `amount` in each direction; the same in every run.
nurbs::NodalVectors random_displacements(int nodes, double amount);

}  // namespace benchmarks
