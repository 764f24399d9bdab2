// SPDX-License-Identifier: GPL-2.0-or-later
// Everything about one element that its integrals need, worked out point by point.
#pragma once

#include <vector>

#include "structure/solid/element_kernel.h"
#include "structure/solid/quadrature.h"

namespace structure {

struct ElementTables {
  int points, padded;
  std::vector<double> dR_dX;  ///< [point][direction][padded functions] [1/length]
  std::vector<double> wJ;     ///< [point] [length^3]
  std::vector<int> slot;      ///< [point]: its place among the element's memories, integrals.h

  ElementGeometry geometry() const { return {dR_dX.data(), wJ.data(), slot.data(), points, padded}; }
};

/// Undeformed control points of an element: columns of nodal positions [length], the first direction fastest.
struct ElementNet {
  const nurbs::NodalVectors& X;
  const std::vector<int>& columns;
};

/// At the points of one element of a patch; allocates only where it was called for fewer points before.
/// Throws std::invalid_argument if the Jacobian determinant is not positive at one of them (a left-handed or
/// folded patch).
class ElementTabulator {
 public:
  /// Keeps a reference to the space.
  ElementTabulator(const nurbs::Space<3>& space, Quadrature quadrature);
  void operator()(int element, const ElementNet& net, ElementTables& tables) const;
  /// Adds integrals of R_A over the element (row sums of its mass matrix for density 1) [length^3]: one per
  /// function.
  void add_row_sums(int element, const ElementNet& net, double* sums) const;
  /// Integrals of R_A R_B over the element [length^3].
  Eigen::MatrixXd products(int element, const ElementNet& net) const;
  /// Memory of the point of an element that is nearest to xi in parameters.
  int nearest_slot(const std::array<int, 3>& span, const nurbs::Parameter<3>& xi) const;
  int slots() const { return most_[0] * most_[1] * most_[2]; }  ///< memories of an element

 private:
  template <class AtPoint>
  void for_each_point(int element, const ElementNet& net, AtPoint at_point) const;

  const nurbs::Space<3>& space_;
  std::vector<nurbs::QuadratureRule> rules_[3];
  int most_[3] = {0, 0, 0};  // points of a span
};

}  // namespace structure
