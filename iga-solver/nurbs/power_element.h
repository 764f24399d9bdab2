// SPDX-License-Identifier: GPL-2.0-or-later
// Surface elements as polynomials in local coordinates s = (s_0, s_1), -1 <= s_i <= 1:
//   S(s) - O = A(s) / W(s),  A = sum_ij a_ij s_0^i s_1^j, W likewise,
// relative to the element's own origin O (one of its control points), so that a surface far from the origin
// of space loses no digits.  Polynomial patches have no W.  Source: Piegl & Tiller (1997), section 6.6.
#pragma once

#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// (A_x, A_y, A_z, W), or (A_x, A_y, A_z, 0) where the patch is polynomial.
using Vector4 = Eigen::Array4d;

/// One element of one direction.
struct AxisElement {
  double begin, end;  ///< its knots
  double half_width;  ///< d xi / d s
  double low, high;   ///< local coordinates of the creases or ends before and after; -1, 1 if its own ends
  int first;          ///< index of its first control point
  bool at_end[2];     ///< begin, end is an end of the patch
  double bezier[kMaxDegree + 1][kMaxDegree + 1];  ///< Bezier point k = sum_j bezier[k][j] P_{first+j}
  double power[kMaxDegree + 1][kMaxDegree + 1];   ///< coefficient of s^k = sum_j power[k][j] P_{first+j}

  double parameter(double s) const {
    return s <= -1.0 ? begin : s >= 1.0 ? end : begin + half_width * (1.0 + s);
  }
  double local(double xi) const { return (xi - begin) / half_width - 1.0; }
};
std::vector<AxisElement> axis_elements(const KnotVector& knots);

/// phi = |S - d|^2 / 2 at one local point, with derivatives by s.  Symmetric matrices as (00, 01, 11).
struct DistanceJet {
  double phi;
  double gradient[2];  ///< r.S_i with r = S - d
  double metric[3];    ///< S_i.S_j
  double hessian[3];   ///< S_i.S_j + r.S_ij
  Vector4 r, S_i[2];
};

/// C(n, k)
double binomial(int n, int k);

/// What depends on the degrees, as functions; degrees 2 x 2 and 3 x 3 are compiled apart.
struct ElementKernel {
  int p, q;
  /// out[k + (p+1) l] = sum_ij M0[k][i] M1[l][j] in[i + (p+1) j]
  using Transform = void (*)(int p, int q, const double (*M0)[kMaxDegree + 1],
                             const double (*M1)[kMaxDegree + 1], const Vector4* in, Vector4* out);
  /// Coefficients a; d relative to the element's origin, its fourth entry 1 (rational) or 0.
  using Evaluate = void (*)(int p, int q, const Vector4* a, const double (&s)[2], const Vector4& d,
                            DistanceJet& out);
  Transform transform;
  Evaluate evaluate;
};
ElementKernel element_kernel(const Space<2>& space);

}  // namespace nurbs
