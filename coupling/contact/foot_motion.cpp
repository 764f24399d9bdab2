// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/foot_motion.h"

#include <Eigen/LU>

namespace contact {

namespace {

using nurbs::Vector3;

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
      N[j] = dN[j] = ddN[j] = 0.0;
      for (int k = count - 1; k >= 0; --k) {
        ddN[j] = ddN[j] * s + dN[j];
        dN[j] = dN[j] * s + N[j];
        N[j] = N[j] * s + functions.power[k][j];
      }
      dN[j] *= scale;
      ddN[j] *= 2.0 * scale * scale;
    }
  }
  int first, count;
  double N[nurbs::kMaxDegree + 1], dN[nurbs::kMaxDegree + 1], ddN[nurbs::kMaxDegree + 1];
};

/// What is summed over control points: their places and delta . place, or their weights.
template <class Value>
struct Derivatives {
  Value value, along[2];
};

struct Sums {
  Derivatives<Vector3> A{Vector3::Zero(), {Vector3::Zero(), Vector3::Zero()}};
  double bend[3] = {0.0, 0.0, 0.0};  // delta . A_00, A_01, A_11
  Derivatives<double> W{0.0, {0.0, 0.0}};
  double W_bend[3] = {0.0, 0.0, 0.0};
};

template <bool rational>
Sums sums(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi, const nurbs::NodalVectors& X,
          int first, const Vector3& delta) {
  const DirectionValues u(space, 0, xi[0]), v(space, 1, xi[1]);
  Sums sums;
  for (int j = 0; j < v.count; ++j) {
    const int begin = u.first + space.control_point_count(0) * (v.first + j);
    Vector3 A = Vector3::Zero(), A_0 = Vector3::Zero();
    double A_00 = 0.0, W = 0.0, W_0 = 0.0, W_00 = 0.0;
    for (int i = 0; i < u.count; ++i) {
      const double w = rational ? space.weights()[begin + i] : 1.0, N = w * u.N[i], dN = w * u.dN[i],
                   ddN = w * u.ddN[i];
      const auto place = X.col(first + begin + i);
      A += N * place;
      A_0 += dN * place;
      A_00 += ddN * delta.dot(place);
      if constexpr (rational) W += N, W_0 += dN, W_00 += ddN;
    }
    sums.A.along[0] += v.N[j] * A_0;
    sums.A.along[1] += v.dN[j] * A;
    sums.bend[0] += v.N[j] * A_00;
    sums.bend[1] += v.dN[j] * delta.dot(A_0);
    sums.bend[2] += v.ddN[j] * delta.dot(A);
    if constexpr (!rational) continue;
    sums.A.value += v.N[j] * A;
    sums.W.value += v.N[j] * W;
    sums.W.along[0] += v.N[j] * W_0;
    sums.W.along[1] += v.dN[j] * W;
    sums.W_bend[0] += v.N[j] * W_00;
    sums.W_bend[1] += v.dN[j] * W_0;
    sums.W_bend[2] += v.ddN[j] * W;
  }
  return sums;
}

// Of S = A/W: S_i = (A_i - W_i S)/W and, where delta is normal to S_i, delta . S_ij = delta . (A_ij - W_ij
// S)/W.
void divide_by_weight(const Vector3& delta, Sums& sums) {
  const double inverse = 1.0 / sums.W.value;
  const Vector3 S = inverse * sums.A.value;
  for (int d = 0; d < 2; ++d) sums.A.along[d] = inverse * (sums.A.along[d] - sums.W.along[d] * S);
  const double height = delta.dot(S);
  for (int k = 0; k < 3; ++k) sums.bend[k] = inverse * (sums.bend[k] - sums.W_bend[k] * height);
}

}  // namespace

Eigen::Matrix<double, 3, 2> foot_motion(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                                        const nurbs::NodalVectors& X, int first, const Vector3& delta) {
  Sums found =
      space.rational() ? sums<true>(space, xi, X, first, delta) : sums<false>(space, xi, X, first, delta);
  if (space.rational()) divide_by_weight(delta, found);
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << found.A.along[0], found.A.along[1];
  Eigen::Matrix2d M = tangents.transpose() * tangents;
  M(0, 0) -= found.bend[0];
  M(1, 1) -= found.bend[2];
  M(0, 1) -= found.bend[1];
  M(1, 0) -= found.bend[1];
  return tangents * M.inverse();
}

}  // namespace contact
