// SPDX-License-Identifier: GPL-2.0-or-later
// Integrals over a body by a loop of Gauss points of its own, in Eigen's words: nothing of structure::Solid
// is in it, and all that is timed is held against it.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "nurbs/patch.h"

namespace benchmarks {

/// Gauss points per direction and knot span, at degree p.
enum class Rule {
  full,     ///< p + 1
  reduced,  ///< p
  zou       ///< p - 1, but p in the first and the last span (Zou et al. 2022; no C0 lines here)
};
int gauss_points(Rule rule, const nurbs::KnotVector& knots, int span);

/// dR/dX of one element at its Gauss points.
struct Gradients {
  Eigen::MatrixXd along[3];  ///< [function][point] [1/length]
  Eigen::VectorXd wJ;        ///< [point] weight times |dX/dxi| [length^3]
  std::vector<int> nodes;    ///< [function]
};
Gradients gradients(const nurbs::Volume& volume, int element, Rule rule);

/// Nodal forces of displacements u [length] under `law`, "linear_elastic", "saint_venant_kirchhoff" or
/// "neo_hooke"; Lame constants [stress].
nurbs::NodalVectors integrated_force(const nurbs::Volume& volume, Rule rule, const std::string& law,
                                     double lambda, double mu, const nurbs::NodalVectors& u);

}  // namespace benchmarks
