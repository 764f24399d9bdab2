// SPDX-License-Identifier: GPL-2.0-or-later
// Fast diagonalisation of one patch: each component of the displacement by itself, with coefficients that are
// the same everywhere, so that its stiffness is a sum of products of matrices of one direction,
//   P = c_0 K_0 x M_1 x M_2 + c_1 M_0 x K_1 x M_2 + c_2 M_0 x M_1 x K_2,
// which the eigenvectors U_d of K_d U = M_d U lambda turn into a diagonal.  Coefficients are means over the
// patch, and the diagonal is scaled to that of the tangent; faces that are fixed as a whole are left out of
// the matrices of one direction.  Products of CG hardly depend on mesh and degree; they grow with how slender
// the body and how nearly incompressible the law is.
// Source: Lynch, Rice & Thomas (1964), Numer. Math. 6, 185-199; Sangalli & Tani (2016), "Isogeometric
// preconditioners based on fast solvers for the Sylvester equation", SIAM J. Sci. Comput. 38, A3644-A3671.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "structure/analysis/preconditioner.h"

namespace structure {

class FastDiagonal final : public Preconditioner {
 public:
  /// Whether the body is one volume patch whose control points are its nodes.
  static bool is_for(const Body& body);
  /// The tangent's body is such a one.
  explicit FastDiagonal(const Tangent& tangent);
  void apply(const NodalVectors& r, NodalVectors& z) const override;
  const char* name() const override { return "tensor"; }

  /// Matrices of one direction's functions, with their derivatives and without.
  struct LineMatrices {
    Eigen::MatrixXd stiffness, mass;
  };

 private:
  /// Control points begin <= a < end of one direction, and the modes of their matrices.
  struct Direction {
    int begin, end;
    Eigen::MatrixXd modes;
    Eigen::VectorXd eigenvalues;
    int count() const { return end - begin; }
  };
  struct Component {
    std::array<Direction, 3> directions;
    Eigen::VectorXd inverse;  ///< of the diagonal, in modes
    std::array<double, 3> coefficients;
  };
  void to_modes(const Component& component, Eigen::VectorXd& values) const;
  void from_modes(const Component& component, Eigen::VectorXd& values) const;
  /// visit(node, place among the component's values)
  template <class Visit>
  void for_each_node(const Component& component, Visit visit) const;
  std::array<Direction, 3> free_directions(const Supports& supports, int component) const;
  void set_scale(const Tangent& tangent);

  const Supports& supports_;
  std::array<int, 3> counts_;  // control points
  std::array<LineMatrices, 3> lines_;
  std::array<Component, 3> components_;
  double mass_;  // coefficient of M_0 x M_1 x M_2, of the tangent's shift
  NodalVectors scale_;
  mutable Eigen::VectorXd values_, work_;
};

}  // namespace structure
