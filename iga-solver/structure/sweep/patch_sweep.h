// SPDX-License-Identifier: GPL-2.0-or-later
// Integrals over a patch by sum factorisation: its boxes are swept plane by plane, row by row, word by word
// (line_kernel.h), and a law is asked at the points of a row (point_kernel.h).  No stiffness, no table of
// functions in three dimensions: a plane's worth of numbers is in work at a time.
// Source: Orszag (1980); laws at points: Kronbichler & Kormann (2012), Comput. Fluids 63, 135-147.
#pragma once

#include <vector>

#include "structure/solid/box_grid.h"
#include "structure/solid/integrals.h"
#include "structure/sweep/box_sweep.h"
#include "structure/sweep/law_call.h"

namespace structure {

/// For one thread at a time.
class PatchSweep final : public Integrals {
 public:
  /// Whether all degrees lie between kLowestSweptDegree and kHighestSweptDegree.
  static bool can_sweep(const nurbs::Space<3>& space);

  /// X: undeformed positions [length], 3 x columns.  Keeps references to X and the material.  Throws
  /// std::invalid_argument if the geometry is affine and has no Jacobian.
  PatchSweep(const nurbs::Space<3>& space, const NodalVectors& X, const std::vector<PlacedBox>& boxes,
             const Material& material, Quadrature quadrature, const SweepGeometry& geometry,
             nurbs::SimdLevel level = nurbs::simd_level());

  int box_count() const override { return static_cast<int>(boxes_.size()); }
  void add_forces(int first, int end, const PointMemory& memory, const NodalVectors& u,
                  NodalVectors& f) const override;
  void add_force_changes(const PointMemory& memory, const NodalVectors& u, const NodalVectors& w,
                         NodalVectors& f) const override;
  void add_energies(const PointMemory& memory, const NodalVectors& u, ExactSum& sum) const override;
  double table_bytes() const override;

  struct Volume {
    ExactSum volume;   ///< [length^3]
    double least_det;  ///< smallest |dX/dxi| at the points
  };
  /// Adds integrals of R_A (row sums of the mass matrix) times density to one number per column.
  Volume add_row_sums(Eigen::VectorXd& sums, double density = 1.0) const;

 private:
  BoxSweep::LawAtPoints law_with(const PointMemory& memory) const;

  const NodalVectors& X_;
  BoxSweep::LawAtPoints law_;
  std::vector<BoxSweep> boxes_;
  mutable SweepSpace space_;
};

}  // namespace structure
