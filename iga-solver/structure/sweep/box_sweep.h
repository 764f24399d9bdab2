// SPDX-License-Identifier: GPL-2.0-or-later
// One box of a patch, swept.  Layouts are those of line_kernel.h; x, y, z are the box's directions, of which
// x is the one that fills words best.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "structure/material/material.h"
#include "structure/solid/box_grid.h"
#include "structure/solid/integrals.h"
#include "structure/sweep/aligned_numbers.h"
#include "structure/sweep/box_bases.h"
#include "structure/sweep/nodal_rows.h"
#include "structure/sweep/point_kernel.h"

namespace structure {

using nurbs::NodalVectors;

/// What is in work while a box is swept; the same for all boxes of a patch.
struct SweepSpace {
  AlignedNumbers nodes, forces, planes_in, planes_out, rows_in, rows_out, values, scratch;
};

/// How the map of a patch is to be taken.
struct SweepGeometry {
  GeometryMode mode;
  std::optional<Matrix3> J = {};  ///< of an affine map (affine_map.h)
};

/// How the rules of all directions and the geometry are to be taken.
struct SweepPlan {
  std::vector<nurbs::QuadratureRule> rules[3];  ///< of the patch's directions
  SweepGeometry geometry;
  nurbs::SimdLevel level;
  int state_size;  ///< numbers that a point remembers
};

class BoxSweep {
 public:
  /// `first_element` counts the elements of the boxes before.
  BoxSweep(const nurbs::Space<3>& space, const PlacedBox& box, std::size_t first_element,
           const SweepPlan& plan);

  /// Makes the space large enough for this box, and so many fields more than forces need.
  void reserve(SweepSpace& space, int further_fields = 0) const;
  /// Works out stored geometry; gives the smallest |J|.
  double tabulate(const NodalVectors& X, SweepSpace& space);

  /// Which loop over points (PointLoops), and its law: inlined, or null, then `outside` is asked.
  struct LawAtPoints {
    int loop;
    const void* inlined;
    OutsideLaw outside;
    PointMemory memory;
  };
  /// Adds to f.
  void add_forces(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u, NodalVectors& f,
                  SweepSpace& space) const;
  /// Adds the change of the forces along a change w of u.
  void add_force_changes(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u,
                         const NodalVectors& w, NodalVectors& f, SweepSpace& space) const;
  double energy(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u,
                SweepSpace& space) const;
  /// Adds density times integrals of R_A to one number per column; the sum of it is the volume.
  PointSums add_row_sums(const NodalVectors& X, double density, Eigen::VectorXd& sums,
                         SweepSpace& space) const;
  double table_bytes() const { return sizeof(double) * static_cast<double>(table_.size()); }

 private:
  /// What is done with the points of each row.
  struct Pass {
    int fields_in, fields_out;
    bool with_value;  // of the functions themselves
    PointLoop loop;
    double* table = nullptr;
    const LawAtPoints* law = nullptr;
    PointSums sums = {0.0, std::numeric_limits<double>::infinity()};
  };
  void sweep(Pass& pass, SweepSpace& space) const;
  /// Asks the law at all points, where it sees the gradients of `displacements`; gives the sum that its loop
  /// leaves.
  double sweep_law(const LawAtPoints& law, const NodalVectors& X,
                   std::initializer_list<const NodalVectors*> displacements, int fields_out, PointLoop loop,
                   SweepSpace& space) const;
  void sweep_plane(int z, int z_point, Pass& pass, SweepSpace& space) const;
  void do_points(const std::array<int, 4>& place, Pass& pass, double* values) const;
  void place_memories(const SpanBox& box, std::size_t first_element, const SweepPlan& plan);
  void read(const NodalVectors& values, double* fields) const;
  void read_geometry(const NodalVectors& X, double* fields) const;
  int geometry_fields() const { return rational_ ? 4 : 3; }

  std::array<int, 3> axes_;  // patch directions of x, y, z: a cyclic permutation, which keeps |J|
  bool rational_;
  LaneBases x_;
  SpanBases y_, z_;
  std::size_t row_, plane_, field_;  // numbers
  const LineKernel *kernel_x_, *kernel_y_, *kernel_z_;
  const PointLoops* loops_;
  const GeometryLoops* geometry_loops_;
  GeometryMode mode_;
  const FieldKernel* field_kernel_;
  NodalRows read_, write_;       // [z][y][x]: of positions and displacements, of forces
  std::vector<double> weights_;  // of the control points, if rational
  AlignedNumbers table_;         // stored geometry, row after row
  std::vector<double> affine_;   // J^-1 and |J|
  // Memories: first of the box, strides of elements and points along x, y, z, and offsets within a row.
  std::size_t first_memory_;
  std::array<std::size_t, 3> element_stride_, point_stride_;
  std::vector<std::ptrdiff_t> offsets_;
};

}  // namespace structure
