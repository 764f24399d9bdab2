// SPDX-License-Identifier: GPL-2.0-or-later
// The surface that particles see, and how it hangs on the solver's nodes.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "nurbs/multi_patch.h"

namespace coupling {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// Linear map from solver nodes to surface control points: x_surface = S x_nodes, f_nodes = S^T f_surface.
/// One matrix serves both ways, so the power of a force is the same on both sides.  A volume's face is a
/// selection of its nodes.
class SurfaceMap {
 public:
  /// S is n_control_points x n_nodes [-].
  explicit SurfaceMap(const Eigen::SparseMatrix<double, Eigen::RowMajor>& S) : S_(S) {}
  /// The control points are the nodes.
  static SurfaceMap identity(int nodes);
  /// Control point i is node[i].
  static SurfaceMap selection(const std::vector<int>& node, int nodes);

  /// surface (3 x n_control_points) = values of the control points where `nodal` (3 x n_nodes) are those of
  /// the nodes.
  void to_surface(const NodalVectors& nodal, NodalVectors& surface) const;
  /// Adds S^T times control-point forces (3 x n_control_points) to nodal forces (3 x n_nodes).
  void add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const;

  int control_point_count() const { return static_cast<int>(S_.rows()); }
  int node_count() const { return static_cast<int>(S_.cols()); }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> S_;
};

struct ContactSurface {
  nurbs::MultiPatch topology;
  SurfaceMap map;
  /// Per patch: +1 or -1 where the normal dS/dxi x dS/deta points out of or into the body; 0 for a two-sided
  /// surface.
  std::vector<int> outward_sign;
};

}  // namespace coupling
