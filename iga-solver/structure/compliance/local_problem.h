// SPDX-License-Identifier: GPL-2.0-or-later
// What a mesh gives way under a point force, beyond what the body does: the half-space under the force,
// solved on the elements around it.  Its displacement is prescribed on what they share with other elements,
// its traction acts on the other free faces; the mesh answers with a finite displacement at the foot where
// the half-space has none.  README.md has the derivation.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "structure/compliance/band_matrix.h"
#include "structure/compliance/control_values.h"
#include "structure/compliance/free_faces.h"
#include "structure/compliance/gradient_products.h"
#include "structure/compliance/half_space.h"
#include "structure/compliance/local_patch.h"
#include "structure/compliance/net_mean.h"

namespace structure {

class LocalProblem {
 public:
  /// Keeps a reference to the patch.  Factorises its stiffness; throws std::invalid_argument if there are
  /// more than kMostUnknowns.
  LocalProblem(const LocalPatch& patch, GradientProducts& gradients);
  static constexpr int kMostUnknowns = 6000;

  /// Per foot, a point of one face of the element that is hit, the tensor c [length/force]: column j is the
  /// mesh's displacement there by a unit force along e_j, less what the body itself gives way more than a
  /// half-space.
  std::vector<Matrix3> compliances(const std::vector<SkinPoint>& feet) const;
  /// What a force gives way that is R + w Z, with Z beside R (net_mean.h), is c + 2 w `one` + w^2 `both`.
  struct OfSpread {
    Matrix3 one, both;  ///< [length/force]
  };
  /// All with the same nodes.
  std::vector<OfSpread> spread_compliances(const std::vector<SpreadFoot>& feet) const;

 private:
  std::vector<int> places_of(const std::vector<Id>& nodes) const;
  Eigen::MatrixXd under_unit_forces(const std::vector<int>& places) const;
  Eigen::MatrixXd by_half_spaces(const Eigen::MatrixXd& u, const std::vector<SkinPoint>& feet,
                                 bool of_touched_face) const;
  void assemble(GradientProducts& gradients);
  void add(const BodyElement& element, const Eigen::MatrixXd& products, const std::vector<int>& places);
  Matrix3& block(int free_place, int held_place);
  void hold_by_springs();
  Eigen::MatrixXd prescribed(const std::vector<SkinPoint>& feet,
                             const std::vector<HalfSpace>& half_spaces) const;
  void add_tractions(const std::vector<SkinPoint>& feet, const std::vector<HalfSpace>& half_spaces,
                     bool of_touched_face, Eigen::MatrixXd& forces) const;
  Eigen::MatrixXd forces_of_held(const Eigen::MatrixXd& u) const;

  const LocalPatch& patch_;
  double E_, nu_;
  ControlValues held_;           // of nodes that other elements have, too, or of those with springs
  BandMatrix K_;                 // of free nodes [force/length]
  std::vector<Matrix3> blocks_;  // of a free and a held node that have an element in common [force/length]
  std::vector<int> block_;       // [held node][free node]: which one; -1: they have none
  std::vector<int> sprung_;      // places of nodes with a spring, if nothing else is held
  double spring_ = 0.0;          // [force/length]
};

}  // namespace structure
