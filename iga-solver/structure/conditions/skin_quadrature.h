// SPDX-License-Identifier: GPL-2.0-or-later
// Quadrature over a piece of the undeformed skin, for those nodes that a part holds: its points are those of
// whole elements, in an order that does not depend on how the body is cut.
#pragma once

#include <vector>

#include "structure/conditions/skin_surface.h"
#include "structure/id.h"

namespace structure {

class SkinQuadrature {
 public:
  /// `nodes`: ids of the columns of nodal arrays, -1 for columns of no node.
  SkinQuadrature(const SkinSurface& surface, const std::vector<Id>& nodes);

  /// Adds to f (3 x n) the integral of value(X) R_A over the piece.
  template <class Value>
  void integrate(const Value& value, NodalVectors& f) const {
    for (const Point& point : points_) {
      const Vector3 here = value(point.X);
      for (std::size_t a = point.first; a < point.end; ++a) f.col(columns_[a]) += weights_[a] * here;
    }
  }

 private:
  struct Point {
    Vector3 X;
    std::size_t first, end;  // of columns_ and weights_
  };
  std::vector<Point> points_;
  std::vector<Eigen::Index> columns_;
  std::vector<double> weights_;  // R_A dA [length^2]
};

}  // namespace structure
