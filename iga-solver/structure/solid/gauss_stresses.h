// SPDX-License-Identifier: GPL-2.0-or-later
// What a whole patch feels at the p + 1 Gauss points per direction of its elements, for pictures: whatever
// the quadrature of its forces, and however it is cut among ranks.
#pragma once

#include <memory>
#include <vector>

#include "structure/material/material.h"
#include "structure/solid/box_grid.h"
#include "structure/solid/element_tables.h"

namespace structure {

struct PointStress {
  Matrix3 cauchy;         ///< [stress]
  double energy_density;  ///< stored energy per reference volume [energy/length^3]
};

class GaussStresses {
 public:
  /// `quadrature`: of the forces, at whose points the material remembers.  Both arguments must live on.
  GaussStresses(const nurbs::Volume& patch, const Material& material, Quadrature quadrature);

  /// Of one element of the patch under displacements u (3 x control points) [length], its points with the
  /// first direction fastest.  `memory`: of all elements in the order of their ids, as ExplicitSolver gives
  /// it; that of the nearest point of the quadrature counts.
  const std::vector<PointStress>& at(int element, const nurbs::NodalVectors& u,
                                     const std::vector<double>& memory);

 private:
  std::size_t element_id(const std::array<int, 3>& span) const;
  std::size_t memory_of(int element, int point) const;

  const nurbs::Volume& patch_;
  const Material& material_;
  ElementTabulator at_gauss_points_, at_quadrature_;
  std::vector<SpanBox> boxes_;
  std::vector<std::size_t> first_id_;  // of each box
  ElementTables tables_;
  std::vector<PointStress> points_;
};

}  // namespace structure
