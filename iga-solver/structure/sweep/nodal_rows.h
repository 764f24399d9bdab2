// SPDX-License-Identifier: GPL-2.0-or-later
// Where the rows of a box's control points stand in nodal arrays.  As a rule those of a row stand side by
// side, and a word of them is read or written at once.
#pragma once

#include <array>
#include <vector>

#include "nurbs/patch.h"
#include "structure/sweep/field_kernel.h"

namespace structure {

class NodalRows {
 public:
  /// `columns` row after row, `count` in each.
  NodalRows(std::vector<int> columns, int count);

  /// Components of all nodes, times weights if there are any: row r of component c from c * field + r * row
  /// on, filled up with zeros.
  void read(const FieldKernel& kernel, const nurbs::NodalVectors& values, const std::vector<double>& weights,
            double* fields, std::size_t field, std::size_t row) const;
  /// values += fields.
  void add(const FieldKernel& kernel, const double* fields, std::size_t field, std::size_t row,
           const std::vector<double>& weights, nurbs::NodalVectors& values) const;

  int rows() const { return rows_; }
  int count() const { return count_; }  ///< of a row
  int column(int row, int i) const {
    return first_.empty() ? columns_[static_cast<std::size_t>(row) * count_ + i] : first_[row] + i;
  }

 private:
  void fetch(const double* values, int row) const;

  int count_, rows_;
  std::vector<int> first_,
      columns_;  // one of them is empty: of each row, if all stand side by side; of each node
};

/// Numbers of a box's control points, `count` in each of the patch's directions, the first fastest: the same
/// with the direction axes[0] fastest, then axes[1].
std::vector<int> along(const std::array<int, 3>& axes, const std::array<int, 3>& count,
                       const std::vector<int>& numbers);
/// Rows along axes[0] of columns.
NodalRows rows_along(const std::array<int, 3>& axes, const std::array<int, 3>& count,
                     const std::vector<int>& columns);

}  // namespace structure
