// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/bezier_element.h"

#include <algorithm>

#include "nurbs/assert.h"

namespace nurbs {
namespace {

// Bernstein polynomials of degree p and their derivatives by t (Piegl & Tiller, eqs. 1.8-1.10).
struct Bernstein {
  double B[kMaxDegree + 1], dB[kMaxDegree + 1];

  Bernstein(int p, double t) : B{1.0} {
    for (int q = 1; q < p; ++q) raise(q, t);
    for (int k = 0; k <= p; ++k) dB[k] = p * ((k > 0 ? B[k - 1] : 0.0) - (k < p ? B[k] : 0.0));
    raise(p, t);
  }

 private:
  void raise(int q, double t) {
    B[q] = t * B[q - 1];
    for (int k = q - 1; k > 0; --k) B[k] = (1.0 - t) * B[k] + t * B[k - 1];
    B[0] *= 1.0 - t;
  }
};

}  // namespace

void BezierElement::fetch(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                          int element) {
  NURBS_ASSERT(control_points.cols() == space.control_point_count(), control_points.cols(),
               space.control_point_count());
  const Indices<2> indices = space.element_indices(element);
  // Bezier point k of one direction is the blossom with k arguments at the element's end, the others at its
  // begin.
  double blossom[2][kMaxDegree + 1][kMaxDegree + 1];
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    degree_[i] = knots.degree();
    begin_[i] = knots.breaks()[indices[i]];
    end_[i] = knots.breaks()[indices[i] + 1];
    width_[i] = end_[i] - begin_[i];
    for (int k = 0; k <= degree_[i]; ++k) {
      double t[kMaxDegree];
      for (int m = 0; m < degree_[i]; ++m) t[m] = m < k ? end_[i] : begin_[i];
      evaluate_blossom(knots, knots.span_of_element(indices[i]), t, blossom[i][k]);
    }
  }

  const int n = degree_[0] + 1, m = degree_[1] + 1;
  int control_point[kMaxPoints];
  space.element_control_points(element, control_point);
  for (int a = 0; a < n * m; ++a) {
    const double w = space.weight(control_point[a]);
    scratch_.col(a) << w * control_points.col(control_point[a]), w;
  }
  for (int l = 0; l < m; ++l)
    for (int k = 0; k < n; ++k) {
      bezier_.col(k + n * l).setZero();
      for (int i = 0; i < n; ++i) bezier_.col(k + n * l) += blossom[0][k][i] * scratch_.col(i + n * l);
    }
  scratch_.leftCols(n * m) = bezier_.leftCols(n * m);
  for (int l = 0; l < m; ++l)
    for (int k = 0; k < n; ++k) {
      bezier_.col(k + n * l).setZero();
      for (int i = 0; i < m; ++i) bezier_.col(k + n * l) += blossom[1][l][i] * scratch_.col(k + n * i);
    }
}

bool BezierElement::holds(const Parameter<2>& xi) const {
  for (int i = 0; i < 2; ++i)
    if (xi[i] < begin_[i] || end_[i] < xi[i]) return false;
  return true;
}

BezierElement::PointAndTangent BezierElement::evaluate(const Parameter<2>& xi, int j) const {
  const Bernstein N[2] = {{degree_[0], (xi[0] - begin_[0]) / width_[0]},
                          {degree_[1], (xi[1] - begin_[1]) / width_[1]}};
  const double* dN[2] = {j == 0 ? N[0].dB : N[0].B, j == 1 ? N[1].dB : N[1].B};
  const int n = degree_[0] + 1;
  Eigen::Vector4d A = Eigen::Vector4d::Zero(), A_j = A;  // (w S, w) and its derivative
  for (int l = 0; l <= degree_[1]; ++l) {
    Eigen::Vector4d row = Eigen::Vector4d::Zero(), row_j = row;
    for (int k = 0; k < n; ++k) {
      row += N[0].B[k] * bezier_.col(k + n * l);
      row_j += dN[0][k] * bezier_.col(k + n * l);
    }
    A += N[1].B[l] * row;
    A_j += dN[1][l] * row_j;
  }
  const Vector3 S = A.head<3>() / A[3];
  return {S, (A_j.head<3>() - A_j[3] * S) / (A[3] * width_[j])};
}

}  // namespace nurbs
