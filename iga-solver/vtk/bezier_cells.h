// SPDX-License-Identifier: GPL-2.0-or-later
// NURBS patches as VTK's Bezier cells, one per element; exact, rational weights and any degrees.
// Source: Borden, Scott, Evans & Hughes (2011), "Isogeometric finite element data structures based on Bezier
// extraction"; the order of a cell's points is that of VTK 9 files, version 2.2.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nurbs/patch.h"

namespace vtk {

/// Values of one field on one patch: components x points, 1 (scalar) or 3 (vector) components.  Per control
/// point they are the coefficients q_A of sum_A R_A q_A; per element they are constants.
struct Field {
  std::string name;
  Eigen::MatrixXd values;
};

template <int Dim>
struct PatchFields {
  nurbs::Patch<Dim> patch;            ///< where it is now
  std::vector<Field> control_points;  ///< components x control_point_count()
  std::vector<Field> elements;        ///< components x element_count()
};

/// An unstructured grid of Bezier quadrilaterals (Dim 2) or hexahedra (Dim 3).  Elements of one patch share
/// the points between them, patches share none.
struct BezierCells {
  std::uint8_t cell_type;
  std::vector<double> points;   ///< xyz of each point
  std::vector<double> weights;  ///< one per point; empty if all patches are polynomial
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::int32_t> degrees;             ///< three per cell
  std::vector<Field> point_fields, cell_fields;  ///< components x points, components x cells
};

/// Throws std::invalid_argument if a field does not fit its patch, is not finite, or if patches have not the
/// same fields.
template <int Dim>
BezierCells bezier_cells(const std::vector<PatchFields<Dim>>& patches);

/// The order of a cell's points: entry k is the lexicographic index (first direction fastest) of VTK's point
/// k.
template <int Dim>
std::vector<int> point_order(const nurbs::Indices<Dim>& degrees);

}  // namespace vtk
