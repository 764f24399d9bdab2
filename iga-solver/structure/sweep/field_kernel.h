// SPDX-License-Identifier: GPL-2.0-or-later
// Between nodal vectors, (x, y, z) of one node after the other, and fields, one component of all nodes of a
// row after the other, as lines are swept (line_kernel.h).
#pragma once

#include <cstddef>

#include "nurbs/simd_level.h"

namespace structure {

/// `count` nodes of a row; component c of the first at fields + c * field.  Times weights[count], if not
/// null.
struct FieldKernel {
  /// fields = vectors; the row is filled up with zeros to `row` numbers, whole words.
  void (*to_fields)(const double* vectors, int count, const double* weights, double* fields,
                    std::size_t field, std::size_t row);
  /// vectors += fields.
  void (*add_fields)(const double* fields, std::size_t field, int count, const double* weights,
                     double* vectors);
};

const FieldKernel& field_kernel(nurbs::SimdLevel level);

}  // namespace structure
