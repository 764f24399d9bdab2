// SPDX-License-Identifier: GPL-2.0-or-later
// Tensor-product NURBS curves, surfaces and volumes.
// Source: Piegl & Tiller (1997), chapter 4; Gao & Feng (2019), eqs. 5-15.
#pragma once

#include <array>
#include <vector>

#include "nurbs/basis.h"

namespace nurbs {

/// A parametric point, and one index per direction.  The cast keeps Dim out of argument deduction here
/// (std::array counts in size_t): functions deduce it from their Space<Dim>.
template <int Dim>
using Parameter = std::array<double, static_cast<size_t>(Dim)>;
template <int Dim>
using Indices = std::array<int, static_cast<size_t>(Dim)>;

/// Topology of a NURBS patch: knot vectors and weights, no coordinates.
/// Control point (i, j, k) has the index i + n_xi * (j + n_eta * k); elements are numbered the same way.
template <int Dim>
class Space {
 public:
  /// Weights: one per control point, all > 0; empty means all 1 (a polynomial patch).
  /// Throws std::invalid_argument, saying what was given and what was expected.
  explicit Space(std::array<KnotVector, Dim> knots, std::vector<double> weights = {});

  const std::array<KnotVector, Dim>& knots() const { return knots_; }
  const KnotVector& knots(int direction) const { return knots_[direction]; }
  int degree(int direction) const { return knots_[direction].degree(); }
  /// Empty when the patch is polynomial.
  const std::vector<double>& weights() const { return weights_; }
  bool rational() const { return !weights_.empty(); }
  double weight(int control_point) const { return weights_.empty() ? 1.0 : weights_[control_point]; }

  int control_point_count() const { return count_; }
  int control_point_count(int direction) const { return knots_[direction].control_point_count(); }
  int element_count() const { return element_count_; }
  /// (p+1)^Dim: control points whose functions are not zero on an element.
  int functions_per_element() const { return functions_per_element_; }
  /// Element indices per direction of an element, and back.
  Indices<Dim> element_indices(int element) const;
  int element_index(const Indices<Dim>& indices) const;
  int element_at(const Parameter<Dim>& xi) const;
  /// Control points of an element, functions_per_element() of them, first direction fastest.
  void element_control_points(int element, int* out) const;
  Parameter<Dim> element_centre(int element) const;
  /// One direction's functions as polynomials on its element `element`.
  const ElementFunctions& functions(int direction, int element) const {
    return functions_[direction][element];
  }

 private:
  std::array<KnotVector, Dim> knots_;
  std::vector<double> weights_;
  std::array<std::vector<ElementFunctions>, Dim> functions_;
  int count_ = 1, element_count_ = 1, functions_per_element_ = 1;
};

/// Number of second derivatives; their order is (0,0) | (0,0) (0,1) (1,1) | (0,0) (0,1) (0,2) (1,1) (1,2)
/// (2,2).
constexpr int second_derivative_count(int dim) { return dim * (dim + 1) / 2; }

/// The functions R that are not zero at one point, with derivatives.  Fixed size: no allocation.
template <int Dim>
struct RationalBasis {
  static constexpr int kMaxFunctions = power(max_degree(Dim) + 1, Dim);
  int count;                                                ///< functions used below
  int control_point[kMaxFunctions];                         ///< their control points
  double R[kMaxFunctions];                                  ///< values, sum 1
  double dR[Dim][kMaxFunctions];                            ///< first derivatives, each sums to 0
  double d2R[second_derivative_count(Dim)][kMaxFunctions];  ///< second derivatives, order as above
};

/// Evaluates R and its derivatives up to `derivatives` (0, 1, 2) at xi (clamped to the domain).
template <int Dim>
void evaluate(const Space<Dim>& space, const Parameter<Dim>& xi, int derivatives, RationalBasis<Dim>& out);
/// The same on the closed element `element` (one-sided at knots).
template <int Dim>
void evaluate_on_element(const Space<Dim>& space, int element, const Parameter<Dim>& xi, int derivatives,
                         RationalBasis<Dim>& out);

/// Sum of R_A(xi) q_A: position, displacement or velocity at xi from control-point values q.
template <int Dim>
Vector3 interpolate(const RationalBasis<Dim>& basis, const Eigen::Ref<const NodalVectors>& q);
template <int Dim>
Vector3 interpolate(const Space<Dim>& space, const Eigen::Ref<const NodalVectors>& q,
                    const Parameter<Dim>& xi);

/// A patch with its coordinates: what readers, primitives and refinement pass around.
template <int Dim>
struct Patch {
  Space<Dim> space;
  NodalVectors control_points;  ///< 3 x space.control_point_count() [length]
};

using Curve = Patch<1>;
using Surface = Patch<2>;
using Volume = Patch<3>;

/// Throws std::invalid_argument unless there is one finite control point per function.
template <int Dim>
void check_patch(const Patch<Dim>& patch);

}  // namespace nurbs
