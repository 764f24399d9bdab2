// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces of the half-space's traction on an element's free face.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "nurbs/basis.h"
#include "nurbs/gauss_legendre.h"
#include "structure/compliance/half_space.h"
#include "structure/compliance/reference_body.h"

namespace structure {

/// A point of the skin: values R of its face's functions there, and the nodes that these belong to.
struct SkinPoint {
  Vector3 point, outward_normal;  ///< [length], unit
  std::vector<Id> nodes;
  std::vector<double> R;

  /// What a unit force there is on these nodes, which rise and have all of its own; it may have one more than
  /// once, at a pole.
  std::vector<double> forces_on(const std::vector<Id>& rising) const;
};

/// One face of a body's patches, as a surface.
class FaceSurface {
 public:
  FaceSurface(const ReferenceBody& body, const SkinPiece& piece);

  const nurbs::Space<2>& space() const { return face_.space; }
  /// On the closed element.  Throws std::invalid_argument if the surface has no normal there.
  SkinPoint at(int element, const nurbs::Parameter<2>& xi) const;
  /// By the parameters [length/parameter].
  std::array<Vector3, 2> tangents(int element, const nurbs::Parameter<2>& xi) const;
  /// Columns t_1, t_2, n of a frame there: t_1 along the first direction, n out of the body.
  Matrix3 frame(int element, const nurbs::Parameter<2>& xi) const;
  Vector3 at_centre(int element) const { return place(element, space().element_centre(element)); }
  /// Adds, per point force at a foot on a half-space of these constants, nodal forces by which the face's
  /// element has the half-space's traction: `row(node)` gives a node's place, < 0 for those that are not
  /// wanted; columns 3 f + j are of a unit force along e_j at feet[f].
  template <class Row>
  void add_tractions(int element, const std::vector<SkinPoint>& feet,
                     const std::vector<HalfSpace>& half_spaces, Row row, Eigen::MatrixXd& forces) const {
    const std::vector<Id> nodes = nodes_of(element);
    const auto count = static_cast<Eigen::Index>(nodes.size());
    local_.setZero(9, count * static_cast<Eigen::Index>(feet.size()));
    integrate(element, feet, half_spaces);
    for (Eigen::Index a = 0; a < count; ++a)
      if (const int place = row(nodes[a]); place >= 0)
        for (std::size_t f = 0; f < feet.size(); ++f)
          forces.block<3, 3>(3 * place, 3 * static_cast<Eigen::Index>(f)) +=
              Matrix3::Map(local_.col(static_cast<Eigen::Index>(f) * count + a).data());
  }

 private:
  struct Cell {
    nurbs::Parameter<2> low, high;
  };
  struct Tangents {
    Vector3 point, t[2];
    Vector3 area;  // outwards
  };
  Tangents tangents(const nurbs::RationalBasis<2>& basis) const;
  std::vector<Id> nodes_of(int element) const;
  Vector3 place(int element, const nurbs::Parameter<2>& xi) const;
  bool is_in_tangent_plane(int element, const SkinPoint& foot) const;
  void integrate(int element, const std::vector<SkinPoint>& feet,
                 const std::vector<HalfSpace>& half_spaces) const;
  double size_of(int element, const Cell& cell) const;
  void integrate(int element, const Cell& cell, int depth, const std::vector<int>& feet_here,
                 const std::vector<SkinPoint>& feet, const std::vector<HalfSpace>& half_spaces) const;
  Vector3 evaluate(const nurbs::BasisFunctions& x, const nurbs::BasisFunctions& y) const;
  void add_cell(int element, const Cell& cell, const nurbs::QuadratureRule& rule,
                const std::vector<int>& feet_here, const std::vector<SkinPoint>& feet,
                const std::vector<HalfSpace>& half_spaces) const;

  const ReferenceBody& body_;
  int patch_;
  nurbs::BoundarySurface face_;
  nurbs::NodalVectors X_;                       // of the face's control points
  nurbs::QuadratureRule near_rule_, far_rule_;  // on [0, 1], of both directions
  // Of the element that is integrated over, so that nothing is allocated point by point: functions along both
  // directions of a cell, points times weights and weights of the control points; functions and area vector.
  mutable std::array<std::vector<nurbs::BasisFunctions>, 2> along_;
  mutable Eigen::Matrix4Xd net_;
  mutable Eigen::VectorXd R_;
  mutable Vector3 area_;
  mutable Eigen::Matrix<double, 9, Eigen::Dynamic> local_;  // 3 x 3 matrices of the functions, foot by foot
};

}  // namespace structure
