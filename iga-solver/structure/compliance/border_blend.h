// SPDX-License-Identifier: GPL-2.0-or-later
// Changes of a table on the borders of its element, carried into it: bilinear blends of Hermite's cubics
// (Coons, 1967), so that both values and slopes are on the borders what they should be.
#pragma once

#include <array>
#include <vector>

#include "nurbs/patch.h"
#include "structure/material/material.h"

namespace structure {

/// Values at table_points() and the derivatives of their polynomials there, with the element's own
/// parameters, from -1 to 1.
class TensorGrid {
 public:
  TensorGrid(const std::array<int, 2>& counts, std::vector<Matrix3> values);
  const std::vector<Matrix3>& values() const { return values_; }
  Matrix3 slope(int direction, int point) const;
  Matrix3 twist(int point) const;  ///< with both

 private:
  std::array<int, 2> counts_;
  std::vector<Matrix3> values_;
};

/// What changes at a point of a border.
struct BorderChange {
  Matrix3 value = Matrix3::Zero();
  std::array<Matrix3, 2> slope = {Matrix3::Zero(), Matrix3::Zero()};
  Matrix3 twist = Matrix3::Zero();
  bool has_slopes = false;  ///< at a corner: all are given; else they follow from the borders' values

  /// `scale`: by how much they are larger in the parameters that are wanted.
  void add_slopes(const TensorGrid& grid, int point, const std::array<double, 2>& scale);
  /// Of a sum of so many as a change from `own`.
  BorderChange less(const TensorGrid& own, int point, int count) const;
};

/// To values at table_points(), `change` having all of them; those inside say nothing.  Of a border's slopes
/// only those across count.  Where corners ask for it values between them change a little more.
void add_blend(const std::array<int, 2>& counts, std::vector<BorderChange> change,
               std::vector<Matrix3>& values);

}  // namespace structure
