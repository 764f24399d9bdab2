// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/surface_directions.h"

#include <Eigen/LU>

namespace contact {

namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

Tangents tangents_of_rational(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                              const nurbs::NodalVectors& X, int first) {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(space, xi, 1, basis);
  Tangents tangents = Tangents::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 2; ++d) tangents.col(d) += basis.dR[d][a] * X.col(first + basis.control_point[a]);
  return tangents;
}

/// Functions of one direction at xi, and their derivatives, from their powers on the element.
struct DirectionValues {
  DirectionValues(const nurbs::Space<2>& space, int d, double xi) {
    const nurbs::KnotVector& knots = space.knots(d);
    const int element = knots.element_at(xi);
    const double low = knots.breaks()[element], high = knots.breaks()[element + 1],
                 scale = 2.0 / (high - low);
    const double s = scale * (xi - low) - 1.0;
    const nurbs::ElementFunctions& functions = space.functions(d, element);
    count = knots.degree() + 1;
    first = knots.span_of_element(element) - knots.degree();
    for (int j = 0; j < count; ++j) {
      N[j] = dN[j] = 0.0;
      for (int k = count - 1; k >= 0; --k) {
        dN[j] = dN[j] * s + N[j];
        N[j] = N[j] * s + functions.power[k][j];
      }
      dN[j] *= scale;
    }
  }
  int first, count;
  double N[nurbs::kMaxDegree + 1], dN[nurbs::kMaxDegree + 1];
};

/// dS/dxi and dS/deta of a patch whose control points are columns of X from `first` on.
Tangents tangents_at(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                     const nurbs::NodalVectors& X, int first) {
  if (space.rational()) return tangents_of_rational(space, xi, X, first);
  const DirectionValues u(space, 0, xi[0]), v(space, 1, xi[1]);
  Tangents tangents = Tangents::Zero();
  for (int j = 0; j < v.count; ++j) {
    const auto row = X.middleCols(first + u.first + space.control_point_count(0) * (v.first + j), u.count);
    Vector3 along = Vector3::Zero(), value = Vector3::Zero();
    for (int i = 0; i < u.count; ++i) {
      along += u.dN[i] * row.col(i);
      value += u.N[i] * row.col(i);
    }
    tangents.col(0) += v.N[j] * along;
    tangents.col(1) += v.dN[j] * value;
  }
  return tangents;
}

}  // namespace

SurfaceDirections surface_directions(const Wall& wall, const nurbs::SurfacePoint& foot) {
  const nurbs::MultiPatch& surface = wall.surface();
  const Tangents tangents = tangents_at(surface.patch(foot.patch), foot.xi, wall.control_points(),
                                        surface.first_control_point(foot.patch));
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  const Tangents dual = tangents * metric.inverse();
  return {wall.to_space_direction(tangents.col(0)),
          {wall.to_space_direction(dual.col(0)), wall.to_space_direction(dual.col(1))}};
}

}  // namespace contact
