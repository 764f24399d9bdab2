// SPDX-License-Identifier: GPL-2.0-or-later
// The mass seam: how nodal forces become nodal accelerations.
//   lumped      a = f / m, m the row sums of the consistent mass matrix M: of second order in the mesh
//   corrected   a = z + (f - M z) / m with z = f / m, one pass of a corrector more: what M and row sums
//               differ by is taken into account once; of fourth order where waves are long beside elements
// Both are symmetric and positive definite, move a body that is pushed alike everywhere alike, and keep its
// momentum: of M / m no eigenvalue is above 1 (Gershgorin), so 1/m <= inverse mass < 2/m, and the stable step
// of the second is less than that of the first by a factor of sqrt(2) at most.
//
// M is that of the whole body: supports s whose motion is given have z_s = a_s, and the kinetic energy is
// that of v_f + (M_fs / m) v_s, by the inverse of the inverse mass, and of v_s, by M_ss.
//
// Source: Auricchio, Beirao da Veiga, Hughes, Reali & Sangalli (2012), Comput. Methods Appl. Mech. Eng.
// 249-252, 2-14; Evans, Hiemstra, Hughes & Reali (2018), ibid. 338, 208-240: predictor and multicorrector.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "structure/body.h"
#include "structure/conditions/supports.h"
#include "structure/halo.h"

namespace structure {

/// Nodal arrays are 3 x n.  Calls are collective.
class MassOperator {
 public:
  virtual ~MassOperator() = default;
  /// a = M^-1 f of nodal forces f [force], whole at the nodes that the part owns: accelerations
  /// [length/time^2] there, 0 where a dof is fixed.  f and a may be the same.  `of_supports`: accelerations
  /// of dofs that move as they are told, 0 elsewhere; null if none does.  No allocation.
  virtual void apply_inverse_mass(const NodalVectors& f, NodalVectors& a,
                                  const NodalVectors* of_supports = nullptr) const = 0;
  /// p = M v: momenta [mass length/time] of the nodes that the part owns.
  virtual void apply_mass(const NodalVectors& v, NodalVectors& p) const = 0;
  /// Row sums of M [mass], one per node: what momentum is summed with.
  virtual const Eigen::VectorXd& nodal_mass() const = 0;
  /// Of each dof [1/mass], 0 where it is fixed: as a diagonal matrix M^-1, or what that never exceeds.
  virtual const NodalVectors& inverse_mass() const = 0;
  /// Whether that is M^-1.
  virtual bool is_diagonal() const = 0;
  /// What the accelerations that were found last, its own among them, ask of the support of a fixed dof
  /// [force].
  virtual double inertia_of_support(Eigen::Index dof, double acceleration) const = 0;
};

class LumpedMass final : public MassOperator {
 public:
  /// Throws std::invalid_argument unless every mass is > 0 and finite.
  explicit LumpedMass(Eigen::VectorXd nodal_mass, const Supports& supports = {});
  void apply_inverse_mass(const NodalVectors& f, NodalVectors& a,
                          const NodalVectors* /*of_supports*/ = nullptr) const override {
    a = f.cwiseProduct(inverse_);
  }
  void apply_mass(const NodalVectors& v, NodalVectors& p) const override {
    p.noalias() = v * mass_.asDiagonal();
  }
  const Eigen::VectorXd& nodal_mass() const override { return mass_; }
  const NodalVectors& inverse_mass() const override { return inverse_; }
  bool is_diagonal() const override { return true; }
  double inertia_of_support(Eigen::Index dof, double acceleration) const override {
    return mass_[dof / 3] * acceleration;
  }

 private:
  Eigen::VectorXd mass_;
  NodalVectors inverse_;
};

class CorrectedMass final : public MassOperator {
 public:
  /// Keeps references to body and halo.  Throws as above.
  CorrectedMass(const Body& body, Eigen::VectorXd nodal_mass, const Supports& supports, const Halo& halo);
  void apply_inverse_mass(const NodalVectors& f, NodalVectors& a,
                          const NodalVectors* of_supports = nullptr) const override;
  /// By iteration, to round-off: 35 products, and one more where supports move.
  void apply_mass(const NodalVectors& v, NodalVectors& p) const override;
  const Eigen::VectorXd& nodal_mass() const override { return lumped_.nodal_mass(); }
  const NodalVectors& inverse_mass() const override { return bound_; }
  bool is_diagonal() const override { return false; }
  double inertia_of_support(Eigen::Index dof, double /*acceleration*/) const override {
    return product_.data()[dof];
  }

 private:
  void multiply_predicted() const;
  NodalVectors of_fixed(const NodalVectors& v) const;

  const Body& body_;
  const Halo& halo_;
  LumpedMass lumped_;
  NodalVectors bound_;
  bool supports_move_;
  mutable NodalVectors predicted_, product_;  // z and M z
};

/// The one that the body asks for.  Throws std::invalid_argument on all parts if on one a node's mass is not
/// above 0 and finite; collective.
std::unique_ptr<MassOperator> mass_of(const Body& body, const Supports& supports, const Halo& halo);

}  // namespace structure
