// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/foot_motion.h"

#include <Eigen/LU>

#include "nurbs/direction_functions.h"

namespace contact {

namespace {

using nurbs::Vector3;

/// Of a function of a patch: value, first and second derivatives 00, 01, 11.
struct Scalar {
  double value = 0.0, along[2] = {0.0, 0.0}, bend[3] = {0.0, 0.0, 0.0};
};

struct Sums {
  Vector3 A = Vector3::Zero(), along[2] = {Vector3::Zero(), Vector3::Zero()};
  Scalar height, W;  // of A along delta, and the weights'
};

// P is the degree of both directions, or 0 where they are known at run time only.

/// The row j of control points, of values V, V_0, V_00 along it.
template <int P>
inline void add_row(const nurbs::DirectionFunctions<P, 2>& v, int j, double V, double V_0, double V_00,
                    Scalar& sum) {
  sum.value += v.N[0][j] * V;
  sum.along[0] += v.N[0][j] * V_0;
  sum.along[1] += v.N[1][j] * V;
  sum.bend[0] += v.N[0][j] * V_00;
  sum.bend[1] += v.N[1][j] * V_0;
  sum.bend[2] += v.N[2][j] * V;
}

template <bool rational, int P>
Sums sums(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi, const nurbs::NodalVectors& X,
          int first, const Vector3& delta) {
  const int p = P > 0 ? P : space.degree(0), q = P > 0 ? P : space.degree(1);
  const nurbs::DirectionFunctions<P, 2> u(space, 0, xi[0]), v(space, 1, xi[1]);
  Sums sums;
  for (int j = 0; j <= q; ++j) {
    const int begin = u.first + space.control_point_count(0) * (v.first + j);
    Vector3 A = Vector3::Zero(), A_0 = Vector3::Zero();
    double h = 0.0, h_0 = 0.0, h_00 = 0.0, W = 0.0, W_0 = 0.0, W_00 = 0.0;
    for (int i = 0; i <= p; ++i) {
      const double w = rational ? space.weights()[begin + i] : 1.0, N = w * u.N[0][i], dN = w * u.N[1][i],
                   ddN = w * u.N[2][i];
      const auto now = X.col(first + begin + i);
      const double height = delta.dot(now);
      A += N * now;
      A_0 += dN * now;
      h += N * height;
      h_0 += dN * height;
      h_00 += ddN * height;
      if constexpr (rational) W += N, W_0 += dN, W_00 += ddN;
    }
    sums.A += v.N[0][j] * A;
    sums.along[0] += v.N[0][j] * A_0;
    sums.along[1] += v.N[1][j] * A;
    add_row(v, j, h, h_0, h_00, sums.height);
    if constexpr (rational) add_row(v, j, W, W_0, W_00, sums.W);
  }
  return sums;
}

// Of S = A/W: S_i = (A_i - W_i S)/W, S_ij = (A_ij - W_ij S - W_i S_j - W_j S_i)/W; of the heights alike.
void divide_by_weight(Sums& sums) {
  const Scalar& W = sums.W;
  const double inverse = 1.0 / W.value;
  for (int d = 0; d < 2; ++d) sums.along[d] = inverse * (sums.along[d] - inverse * W.along[d] * sums.A);
  Scalar& h = sums.height;
  h.value *= inverse;
  for (int d = 0; d < 2; ++d) h.along[d] = inverse * (h.along[d] - W.along[d] * h.value);
  for (int k = 0; k < 3; ++k) {
    const int i = k / 2, j = (k + 1) / 2;
    h.bend[k] =
        inverse * (h.bend[k] - W.bend[k] * h.value - W.along[i] * h.along[j] - W.along[j] * h.along[i]);
  }
}

}  // namespace

FootMotion foot_motion(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                       const nurbs::NodalVectors& X, int first, const Vector3& delta) {
  Sums found = nurbs::with_degree(space.degree(0), space.degree(1), [&](auto P) {
    return space.rational() ? sums<true, P>(space, xi, X, first, delta)
                            : sums<false, P>(space, xi, X, first, delta);
  });
  if (space.rational()) divide_by_weight(found);
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << found.along[0], found.along[1];
  const double* const bend = found.height.bend;
  Eigen::Matrix2d M = tangents.transpose() * tangents;
  M(0, 0) -= bend[0];
  M(1, 1) -= bend[2];
  M(0, 1) -= bend[1];
  M(1, 0) -= bend[1];
  return {tangents, M.inverse()};
}

}  // namespace contact
