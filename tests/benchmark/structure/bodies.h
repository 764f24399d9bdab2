// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of steel, by the ways in which their forces are worked out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "structure/solid/solid.h"
#include "structure/time/explicit_solver.h"

namespace benchmarks {

// Table 2's steel, SI.
constexpr double kYoung = 210.6e9, kPoisson = 0.286, kDensity = 7850.0;
constexpr double kLambda = kYoung * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
constexpr double kMu = kYoung / (2.0 * (1.0 + kPoisson));

/// A way to work out the forces of a body, by the name that it has in the tables.
struct Method {
  std::string name;
  structure::Integration integration;
};
const std::vector<Method>& methods();
/// Throws std::invalid_argument for other names.
const Method& method_named(const std::string& name);

/// `law` is a word of structure::material_laws(); throws std::invalid_argument for others.
std::unique_ptr<structure::Solid> make_solid(const Method& method, const nurbs::Volume& volume,
                                             const std::string& law);

/// A plate that rings freely, well below its stable step, which is 0.86 (p = 2) or 0.65 (p = 3) of its
/// elements' thickness over the speed of sound.
std::unique_ptr<structure::ExplicitSolver> ringing(std::unique_ptr<structure::Body> body, int layers);

}  // namespace benchmarks
