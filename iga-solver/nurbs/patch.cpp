// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/assert.h"
#include "nurbs/usable_number.h"

namespace nurbs {

template <int Dim>
Space<Dim>::Space(std::array<KnotVector, Dim> knots, std::vector<double> weights)
    : knots_(std::move(knots)), weights_(std::move(weights)) {
  double count = 1.0;  // in floating point: the product of large meshes must not wrap around
  for (const KnotVector& direction : knots_) count *= direction.control_point_count();
  if (count > std::numeric_limits<int>::max())
    throw std::invalid_argument(fmt::format("patch of {:.0f} control points, expected at most {}", count,
                                            std::numeric_limits<int>::max()));
  for (const KnotVector& direction : knots_) {
    if (direction.degree() > max_degree(Dim))
      throw std::invalid_argument(
          fmt::format("degree of a volume is {}, expected 1 to {}", direction.degree(), max_degree(Dim)));
    count_ *= direction.control_point_count();
    element_count_ *= direction.element_count();
    functions_per_element_ *= direction.degree() + 1;
  }
  if (!weights_.empty() && static_cast<int>(weights_.size()) != count_)
    throw std::invalid_argument(fmt::format("{} weights given, expected {}", weights_.size(), count_));
  for (size_t a = 0; a < weights_.size(); ++a)
    if (!(is_usable(weights_[a]) && weights_[a] > 0.0))
      throw std::invalid_argument(fmt::format("weight {} is {}, expected a number > 0{}", a + 1, weights_[a],
                                              weights_[a] > 0.0 ? ", at most 1e+100" : ""));
  for (int d = 0; d < Dim; ++d) functions_[d] = element_functions(knots_[d]);
}

template <int Dim>
Indices<Dim> Space<Dim>::element_indices(int element) const {
  NURBS_ASSERT(0 <= element && element < element_count_, element, element_count_);
  Indices<Dim> indices;
  for (int d = 0; d < Dim; ++d) {
    indices[d] = element % knots_[d].element_count();
    element /= knots_[d].element_count();
  }
  return indices;
}

template <int Dim>
int Space<Dim>::element_index(const Indices<Dim>& indices) const {
  int element = 0;
  for (int d = Dim - 1; d >= 0; --d) {
    NURBS_ASSERT(0 <= indices[d] && indices[d] < knots_[d].element_count(), d, indices[d]);
    element = element * knots_[d].element_count() + indices[d];
  }
  return element;
}

template <int Dim>
int Space<Dim>::element_at(const Parameter<Dim>& xi) const {
  Indices<Dim> indices;
  for (int d = 0; d < Dim; ++d) indices[d] = knots_[d].element_at(xi[d]);
  return element_index(indices);
}

namespace {

// Control points of the tensor-product block that starts at `first`, first direction fastest; returns their
// number. Each direction copies the block of the directions before it, the copy at the block's own place
// last.
template <int Dim>
int block_control_points(const Space<Dim>& space, const Indices<Dim>& first, int* out) {
  int count = 1, stride = 1;
  out[0] = 0;
  for (int d = 0; d < Dim; ++d) {
    for (int j = space.degree(d); j >= 0; --j)
      for (int i = 0; i < count; ++i) out[j * count + i] = out[i] + (first[d] + j) * stride;
    count *= space.degree(d) + 1;
    stride *= space.control_point_count(d);
  }
  return count;
}

// Products of one-dimensional functions, each differentiated orders[d] times.
template <int Dim>
void tensor_product(const Space<Dim>& space, const BasisFunctions (&basis)[Dim], const Indices<Dim>& orders,
                    double* out) {
  int count = space.degree(0) + 1;
  std::copy_n(basis[0].values[orders[0]], count, out);
  for (int d = 1; d < Dim; ++d) {
    const double* factor = basis[d].values[orders[d]];
    for (int j = space.degree(d); j >= 0; --j)
      for (int i = 0; i < count; ++i) out[j * count + i] = out[i] * factor[j];
    count *= space.degree(d) + 1;
  }
}

// Multiplies N_A by the weights w_A and returns their sum.
double apply_weights(const double* w, int count, double* N) {
  double sum = 0.0;
  for (int a = 0; a < count; ++a) sum += N[a] *= w[a];
  return sum;
}

// R = w N / W and its derivatives, W = sum of w N: quotient rule (Piegl & Tiller, eqs. 4.8 and 4.20).
template <int Dim>
void make_rational(const Space<Dim>& space, int derivatives, RationalBasis<Dim>& b) {
  double w[RationalBasis<Dim>::kMaxFunctions];
  for (int a = 0; a < b.count; ++a) w[a] = space.weights()[b.control_point[a]];

  const double inverse_W = 1.0 / apply_weights(w, b.count, b.R);
  for (int a = 0; a < b.count; ++a) b.R[a] *= inverse_W;
  if (derivatives < 1) return;

  double dW[Dim];
  for (int d = 0; d < Dim; ++d) {
    dW[d] = apply_weights(w, b.count, b.dR[d]);
    for (int a = 0; a < b.count; ++a) b.dR[d][a] = (b.dR[d][a] - b.R[a] * dW[d]) * inverse_W;
  }
  if (derivatives < 2) return;

  int k = 0;
  for (int d = 0; d < Dim; ++d)
    for (int e = d; e < Dim; ++e, ++k) {
      const double d2W = apply_weights(w, b.count, b.d2R[k]);
      for (int a = 0; a < b.count; ++a)
        b.d2R[k][a] = (b.d2R[k][a] - b.dR[d][a] * dW[e] - b.dR[e][a] * dW[d] - b.R[a] * d2W) * inverse_W;
    }
}

// Evaluates on the knot spans given per direction.
template <int Dim>
void evaluate_on_spans(const Space<Dim>& space, const Indices<Dim>& spans, const Parameter<Dim>& xi,
                       int derivatives, RationalBasis<Dim>& out) {
  BasisFunctions basis[Dim];
  Indices<Dim> first;
  for (int d = 0; d < Dim; ++d) {
    evaluate_basis(space.knots(d), spans[d], xi[d], derivatives, basis[d]);
    first[d] = basis[d].first;
  }
  out.count = block_control_points(space, first, out.control_point);
  Indices<Dim> orders{};
  tensor_product(space, basis, orders, out.R);
  for (int d = 0, k = 0; d < Dim && derivatives >= 1; ++d) {
    ++orders[d];
    tensor_product(space, basis, orders, out.dR[d]);
    for (int e = d; e < Dim && derivatives >= 2; ++e, ++k) {
      ++orders[e];
      tensor_product(space, basis, orders, out.d2R[k]);
      --orders[e];
    }
    --orders[d];
  }
  if (space.rational()) make_rational(space, derivatives, out);
}

}  // namespace

template <int Dim>
void Space<Dim>::element_control_points(int element, int* out) const {
  const Indices<Dim> indices = element_indices(element);
  Indices<Dim> first;
  for (int d = 0; d < Dim; ++d) first[d] = knots_[d].span_of_element(indices[d]) - knots_[d].degree();
  block_control_points(*this, first, out);
}

template <int Dim>
Parameter<Dim> Space<Dim>::element_centre(int element) const {
  const Indices<Dim> indices = element_indices(element);
  Parameter<Dim> centre;
  for (int d = 0; d < Dim; ++d)
    centre[d] = 0.5 * (knots_[d].breaks()[indices[d]] + knots_[d].breaks()[indices[d] + 1]);
  return centre;
}

template <int Dim>
void evaluate(const Space<Dim>& space, const Parameter<Dim>& xi, int derivatives, RationalBasis<Dim>& out) {
  Parameter<Dim> inside;
  Indices<Dim> spans;
  for (int d = 0; d < Dim; ++d) {
    NURBS_ASSERT(!std::isnan(xi[d]), d, xi[d]);
    inside[d] = std::clamp(xi[d], space.knots(d).front(), space.knots(d).back());
    spans[d] = space.knots(d).find_span(inside[d]);
  }
  evaluate_on_spans(space, spans, inside, derivatives, out);
}

template <int Dim>
void evaluate_on_element(const Space<Dim>& space, int element, const Parameter<Dim>& xi, int derivatives,
                         RationalBasis<Dim>& out) {
  const Indices<Dim> indices = space.element_indices(element);
  Indices<Dim> spans;
  for (int d = 0; d < Dim; ++d) spans[d] = space.knots(d).span_of_element(indices[d]);
  evaluate_on_spans(space, spans, xi, derivatives, out);
}

template <int Dim>
Vector3 interpolate(const RationalBasis<Dim>& basis, const Eigen::Ref<const NodalVectors>& q) {
  Vector3 sum = Vector3::Zero();
  NURBS_ASSERT(basis.control_point[basis.count - 1] < q.cols(), basis.count, q.cols());
  for (int a = 0; a < basis.count; ++a) sum += basis.R[a] * q.col(basis.control_point[a]);
  return sum;
}

template <int Dim>
Vector3 interpolate(const Space<Dim>& space, const Eigen::Ref<const NodalVectors>& q,
                    const Parameter<Dim>& xi) {
  NURBS_ASSERT(q.cols() == space.control_point_count(), q.cols(), space.control_point_count());
  RationalBasis<Dim> basis;
  evaluate(space, xi, 0, basis);
  return interpolate(basis, q);
}

template <int Dim>
void check_patch(const Patch<Dim>& patch) {
  const int given = static_cast<int>(patch.control_points.cols()),
            expected = patch.space.control_point_count();
  if (given != expected)
    throw std::invalid_argument(fmt::format("{} control points given, expected {}", given, expected));
  for (int a = 0; a < given; ++a)
    for (const double x : patch.control_points.col(a))
      if (!is_usable(x))
        throw std::invalid_argument(
            std::isfinite(x)
                ? fmt::format("control point {} has a coordinate {}, expected at most {} in size", a + 1, x,
                              kLargestNumber)
                : fmt::format("control point {} is not finite", a + 1));
}

#define INSTANTIATE(Dim)                                                                          \
  template class Space<Dim>;                                                                      \
  template void evaluate(const Space<Dim>&, const Parameter<Dim>&, int, RationalBasis<Dim>&);     \
  template void evaluate_on_element(const Space<Dim>&, int, const Parameter<Dim>&, int,           \
                                    RationalBasis<Dim>&);                                         \
  template Vector3 interpolate(const RationalBasis<Dim>&, const Eigen::Ref<const NodalVectors>&); \
  template Vector3 interpolate(const Space<Dim>&, const Eigen::Ref<const NodalVectors>&,          \
                               const Parameter<Dim>&);                                            \
  template void check_patch(const Patch<Dim>&);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace nurbs
