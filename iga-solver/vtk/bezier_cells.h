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

#include "nurbs/boundary.h"
#include "nurbs/patch.h"

namespace vtk {

/// Values of one field on one patch: components x points, 1 (scalar), 3 (vector) or 6 (symmetric tensor: xx,
/// yy, zz, xy, yz, xz) components.  Per control point they are the coefficients q_A of sum_A R_A q_A, per
/// Bezier point the same on the basis of bezier_space; per element they are constants.
struct Field {
  std::string name;
  Eigen::MatrixXd values;
  std::string unit = {};  ///< empty: not said
};

template <int Dim>
struct PatchFields {
  nurbs::Patch<Dim> patch;                ///< where it is drawn
  std::vector<Field> control_points;      ///< components x control_point_count()
  std::vector<Field> elements;            ///< components x element_count()
  std::vector<Field> bezier_points = {};  ///< components x bezier_space().control_point_count()
};

/// The basis that a patch's cells have: every interior knot as often as the degree, so that the control
/// points are the Bezier points of all elements, p n + 1 in a direction of n elements.
template <int Dim>
nurbs::Space<Dim> bezier_space(const nurbs::Space<Dim>& space);

/// A volume's face with the fields that it has per control point and per Bezier point.
PatchFields<2> on_face(const PatchFields<3>& volume, nurbs::Face face);

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
