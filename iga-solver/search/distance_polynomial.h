// SPDX-License-Identifier: GPL-2.0-or-later
// The squared distance from d to part of an element in Bernstein form: D = G / V with G = |A - d W|^2 and
// V = W^2, polynomials of degree 2p x 2q.  For any c, F_c = G - c V has the sign of D - c, and where D = c
// and its gradient vanishes, the second derivatives of F_c are those of D times V.  As F_c is linear in c,
// bounds at the least and greatest D hold for all values between.
// Source: Chen et al. (2008), "Computing the minimum distance between a point and a NURBS curve".
#pragma once

#include "search/element_descent.h"

namespace search {

/// What one pair of net points contributes to the product of two Bernstein polynomials.
struct ProductTerm {
  int a, b, k;    ///< net points, coefficient of the product
  double factor;  ///< for nets already multiplied by binomials
};
std::vector<ProductTerm> product_terms(int p, int q);

class DistancePolynomial {
 public:
  struct Range {
    double low, high;
  };

  /// `net`: homogeneous Bezier points (w (B - origin), w) times binomials, polynomial patches with w = 1;
  /// `d` relative to the element's origin.
  DistancePolynomial(const ElementStore& elements, const int (&e)[2], const std::vector<ProductTerm>& terms,
                     const Vector4* net, const Vector4& d);

  /// Least coefficient of F_c: a lower bound.
  double lower_bound(double c) const;
  /// Bounds of D.
  Range distance2() const;
  /// Bounds of the derivative of F_c of the given orders, for all c in a range, up to a positive factor that
  /// second derivatives share.
  Range derivative(int order_0, int order_1, const Range& c) const;
  double round_off() const { return round_off_; }

  enum class Shape { convex, no_minimum, unknown };
  /// From the second derivatives on the directions not collapsed, c = distance2().  Convex: D has one minimum
  /// at most on the part.  No minimum: none in its interior.
  Shape shape(const Range& c) const;

  /// Halves of the part.
  void halve(int direction, DistancePolynomial& lower, DistancePolynomial& upper) const;
  /// Restriction to the lower or upper border.
  void collapse(int direction, bool upper);
  /// The direction in which F_c bends most.
  int widest(const Range& c) const;
  bool collapsed(int i) const { return part_.low[i] == part_.high[i]; }

  const LocalBox& part() const { return part_; }
  const int (&element() const)[2] { return e_; }
  LocalPoint centre() const;
  double corner_distance2(int corner) const;
  LocalPoint corner(int corner) const;

 private:
  static constexpr int kMaxCoefficients = power(2 * kMaxDegree + 1, 2);
  int corner_index(int corner) const {
    return (corner & 1 ? n_[0] : 0) + (corner & 2 ? (n_[0] + 1) * n_[1] : 0);
  }
  int size() const { return (n_[0] + 1) * (n_[1] + 1); }

  int e_[2], n_[2];
  bool rational_;
  LocalBox part_;
  double round_off_;
  double G_[kMaxCoefficients], V_[kMaxCoefficients];
};

}  // namespace search
