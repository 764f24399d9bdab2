// SPDX-License-Identifier: GPL-2.0-or-later
// Products with the consistent mass matrix of a patch, M_AB = integral of rho R_A R_B over the undeformed
// body, by sum factorisation: along y and z from point to point, along x by band matrices that know the sum
// over the points there.  R = Bx By Bz / W, so with sums over points of y and z
//   M = sum (By Bz)^T [integral along x of rho |J| / W^2 Bx Bx^T] (By Bz), times weights on both sides.
// Where the map is affine it is a product of three band matrices, of x, y and z.
// Degrees are any.  Source: Orszag (1980), J. Comput. Phys. 37, 70-92.
#pragma once

#include <array>
#include <vector>

#include "structure/solid/box_grid.h"
#include "structure/sweep/aligned_numbers.h"
#include "structure/sweep/box_bases.h"
#include "structure/sweep/mass_kernel.h"
#include "structure/sweep/nodal_rows.h"

namespace structure {

using nurbs::NodalVectors;

/// What is in work while a box is swept; the same for all boxes of a patch.
struct MassSpace {
  AlignedNumbers in, out, plane_in, plane_out, row_in, row_out;
};

/// Integrals of products of functions of one direction, for each of its control points.
struct LineMass {
  int width = 0;              ///< functions that a row has
  std::vector<int> first;     ///< the first of them
  std::vector<double> value;  ///< [control point][width]
  const double* row(int i) const { return &value[std::size_t(i) * width]; }
};

/// One box.  x, y, z are its directions, of which x is the longest.
class MassBox {
 public:
  /// X: undeformed positions [length], 3 x columns.  `is_affine`: its map's Jacobian is the same everywhere.
  MassBox(const nurbs::Space<3>& space, const PlacedBox& box, const NodalVectors& X, double density,
          bool is_affine, nurbs::SimdLevel level);
  void reserve(MassSpace& space) const;
  /// f += M a, in columns of shares.
  void add_product(const NodalVectors& a, NodalVectors& f, MassSpace& space) const;
  double table_bytes() const { return sizeof(double) * static_cast<double>(bands_.size()); }

 private:
  struct Point;  // of y and z
  void add_bands(const Point& y, const Point& z, const std::vector<double>& net, double density,
                 double* bands) const;
  void multiply_by_lines(MassSpace& space) const;
  void sweep(MassSpace& space) const;
  void sweep_plane(const double* bands, double scale, MassSpace& space) const;
  void multiply_row(const double* bands, MassSpace& space) const;

  std::array<int, 3> axes_;  // patch directions of x, y, z: a cyclic permutation, which keeps |J|
  bool rational_;
  SpanBases x_, y_, z_;
  std::array<int, 3> degree_;
  std::size_t row_, plane_, field_;  // numbers
  std::size_t band_ = 0, row_bands_ = 0;
  const MassKernel* kernel_;
  const FieldKernel* field_kernel_;
  NodalRows read_, write_;
  std::vector<double> weights_;  // of the control points, if rational
  AlignedNumbers bands_;         // of each point of z and y; of one, if the map is affine, and then:
  LineMass line_y_, line_z_;
};

/// For one thread at a time.
class MassSweep {
 public:
  /// As MassBox.
  MassSweep(const nurbs::Space<3>& space, const NodalVectors& X, const std::vector<PlacedBox>& boxes,
            double density, bool is_affine, nurbs::SimdLevel level = nurbs::simd_level());
  int box_count() const { return static_cast<int>(boxes_.size()); }
  /// Adds M a of boxes [first, end), each as one share, to f; a of accelerations or velocities, both
  /// 3 x columns.  No allocation.
  void add_products(int first, int end, const NodalVectors& a, NodalVectors& f) const {
    for (int b = first; b < end; ++b) boxes_[b].add_product(a, f, space_);
  }
  double table_bytes() const;
  /// What that will be, unless the map is affine.
  static double expected_bytes(const nurbs::Space<3>& space, const std::vector<PlacedBox>& boxes);

 private:
  std::vector<MassBox> boxes_;
  mutable MassSpace space_;
};

}  // namespace structure
