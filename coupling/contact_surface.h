// SPDX-License-Identifier: GPL-2.0-or-later
// The surface that particles see, and how it hangs on the solver's nodes.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

#include "brep/faced_patches.h"
#include "nurbs/multi_patch.h"

namespace coupling {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// A node of the structure, the same on every rank.
using NodeId = std::int64_t;

/// Linear map from solver nodes to surface control points: x_surface = S x_nodes, f_nodes = S^T f_surface.
/// One matrix serves both ways, so the power of a force is the same on both sides.  A volume's face is a
/// selection of its nodes.
class SurfaceMap {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, NodeId>;

  /// S is n_control_points x n_nodes [-]; columns are node ids.
  explicit SurfaceMap(const Matrix& S) : S_(S) {}
  /// The control points are the nodes.
  static SurfaceMap identity(NodeId nodes);
  /// Control point i is node[i].
  static SurfaceMap selection(const std::vector<NodeId>& node, NodeId nodes);
  /// The same map for nodal arrays whose columns belong to these ids, the first `owned` of them rising, of
  /// the control points that hang on owned nodes alone.  Throws std::invalid_argument, naming the node, if
  /// one hangs on owned nodes and on others.
  SurfaceMap on(const std::vector<NodeId>& nodes, Eigen::Index owned) const;
  /// The same where all are owned; also throws if the surface hangs on a node that is not among them.
  SurfaceMap on(const std::vector<NodeId>& nodes) const;
  /// Which of nodal arrays' columns, which belong to these ids (-1: to none), the surface hangs on.
  std::vector<Eigen::Index> columns_of(const std::vector<NodeId>& nodes) const;
  bool hangs(int control_point) const {
    return S_.outerIndexPtr()[control_point + 1] > S_.outerIndexPtr()[control_point];
  }

  /// Whether each control point is one node.
  bool is_selection() const;
  /// Which node each control point is; throws std::logic_error if one is none.
  std::vector<NodeId> selected_nodes() const;

  /// visit(node, share) for each node that a control point hangs on.
  template <class Visit>
  void for_each_share(int control_point, Visit visit) const {
    for (Matrix::InnerIterator entry(S_, control_point); entry; ++entry) visit(entry.col(), entry.value());
  }
  /// The value at a control point where `nodal` (3 x n_nodes) are those of the nodes.
  Vector3 at(int control_point, const NodalVectors& nodal) const {
    Vector3 sum = Vector3::Zero();
    for (Matrix::InnerIterator entry(S_, control_point); entry; ++entry)
      sum += entry.value() * nodal.col(entry.col());
    return sum;
  }
  /// At these control points, surface (3 x n_control_points) = values where `nodal` (3 x n_nodes) are those
  /// of the nodes.
  void to_surface(const std::vector<int>& control_points, const NodalVectors& nodal,
                  NodalVectors& surface) const;
  void to_surface(const NodalVectors& nodal, NodalVectors& surface) const;  ///< at all
  /// Adds S^T times the forces of these control points (out of 3 x n_control_points) to nodal forces
  /// (3 x n_nodes).
  void add_to_nodes(const std::vector<int>& control_points, const NodalVectors& surface,
                    NodalVectors& nodal) const;
  void add_to_nodes(const NodalVectors& surface, NodalVectors& nodal) const;  ///< of all
  /// The columns that it adds to, rising.
  void nodes_of(const std::vector<int>& control_points, std::vector<Eigen::Index>& nodes) const;

  NodeId control_point_count() const { return S_.rows(); }
  NodeId node_count() const { return S_.cols(); }

 private:
  std::vector<int> all() const;

  Matrix S_;  // compressed
};

struct ContactSurface {
  nurbs::MultiPatch topology;
  SurfaceMap map;  ///< from the nodes of the whole structure
  /// Per patch: +1 or -1 where the normal dS/dxi x dS/deta points out of or into the body; 0 for a two-sided
  /// surface.
  std::vector<int> outward_sign;
  /// In place of patches, of which there are none then: faces, edges and vertices; which side is outside
  /// of a body, brep::Face::outward says.
  std::shared_ptr<const brep::Surface> faces = nullptr;
  /// The patches once more, for feet alone: all else, and the parameters of feet, stay those of the patches.
  std::shared_ptr<const brep::FacedPatches> faced = nullptr;
};

}  // namespace coupling
