// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set; see line_kernel.cpp for what that forbids.
#include "structure/sweep/field_kernel.h"

#include <algorithm>
#include <utility>

#include "nurbs/lanes.h"

namespace structure {

using namespace nurbs::lanes;

namespace {

// Numbers Place, ... of three words, of which place(lane) says where each lane's number stands.
template <class Place, int... Lane>
[[gnu::always_inline]] inline Lanes pick(const Lanes (&word)[3], Place place,
                                         std::integer_sequence<int, Lane...>) {
  constexpr int kTwo = 2 * kLanes;
  const Lanes first = __builtin_shufflevector(word[0], word[1], (place(Lane) < kTwo ? place(Lane) : 0)...);
  return __builtin_shufflevector(first, word[2],
                                 (place(Lane) < kTwo ? Lane : place(Lane) - kTwo + kLanes)...);
}

constexpr std::make_integer_sequence<int, kLanes> kAllLanes{};

/// Component C of kLanes nodes, from their numbers in order.
template <int C>
[[gnu::always_inline]] inline Lanes component(const Lanes (&xyz)[3]) {
  return pick(
      xyz, [](int lane) constexpr { return 3 * lane + C; }, kAllLanes);
}
/// Word W of kLanes nodes' numbers in order, from their components.
template <int W>
[[gnu::always_inline]] inline Lanes in_order(const Lanes (&component)[3]) {
  return pick(
      component,
      [](int lane) constexpr { return (W * kLanes + lane) % 3 * kLanes + (W * kLanes + lane) / 3; },
      kAllLanes);
}

void to_fields(const double* vectors, int count, const double* weights, double* fields, std::size_t field,
               std::size_t row) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes, vectors += 3 * kLanes) {
    const Lanes xyz[3] = {load(vectors), load(vectors + kLanes), load(vectors + 2 * kLanes)};
    Lanes c[3] = {component<0>(xyz), component<1>(xyz), component<2>(xyz)};
    if (weights)
      for (Lanes& v : c) v *= load(weights + i);
    for (int k = 0; k < 3; ++k) store(c[k], fields + k * field + i);
  }
  for (; i < count; ++i, vectors += 3)
    for (int k = 0; k < 3; ++k) fields[k * field + i] = vectors[k] * (weights ? weights[i] : 1.0);
  for (int k = 0; k < 3; ++k)
    for (std::size_t rest = count; rest < row; ++rest) fields[k * field + rest] = 0.0;
}

// vectors += fields of kLanes nodes.
[[gnu::always_inline]] inline void add_word(const double* fields, std::size_t field, const double* weights,
                                            double* vectors) {
  Lanes c[3] = {load(fields), load(fields + field), load(fields + 2 * field)};
  if (weights)
    for (Lanes& v : c) v *= load(weights);
  store(load(vectors) + in_order<0>(c), vectors);
  store(load(vectors + kLanes) + in_order<1>(c), vectors + kLanes);
  store(load(vectors + 2 * kLanes) + in_order<2>(c), vectors + 2 * kLanes);
}

// The last nodes of a row, too, are added as words are: product and sum are rounded apart, as they are where
// a box's share waits in a column of its own.
void add_fields(const double* fields, std::size_t field, int count, const double* weights, double* vectors) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes, vectors += 3 * kLanes)
    add_word(fields + i, field, weights ? weights + i : nullptr, vectors);
  if (!weights) {
    for (; i < count; ++i, vectors += 3)
      for (int k = 0; k < 3; ++k) vectors[k] += fields[k * field + i];
  } else if (i < count) {
    double last[3 * kLanes] = {}, last_weights[kLanes] = {};
    std::copy_n(vectors, 3 * (count - i), last);
    std::copy_n(weights + i, count - i, last_weights);
    add_word(fields + i, field, last_weights, last);
    std::copy_n(last, 3 * (count - i), vectors);
  }
}

constexpr FieldKernel kKernel = {to_fields, add_fields};

}  // namespace

namespace NURBS_SIMD_LEVEL {
const FieldKernel& field_kernel() { return kKernel; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure
