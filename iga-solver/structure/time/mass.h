// SPDX-License-Identifier: GPL-2.0-or-later
// The mass seam: how nodal forces become nodal accelerations.
#pragma once

#include <Eigen/Core>
#include <stdexcept>

#include "nurbs/types.h"

namespace structure {

using nurbs::NodalVectors;

class MassOperator {
 public:
  virtual ~MassOperator() = default;
  /// a = M^-1 f for nodal forces f [force] and accelerations a [length/time^2], both 3 x n.  No allocation.
  virtual void apply_inverse_mass(const NodalVectors& f, NodalVectors& a) const = 0;
  /// Row sums of M [mass], one per node: what momentum and kinetic energy are summed with.
  virtual const Eigen::VectorXd& nodal_mass() const = 0;
};

/// Row-sum lumped mass: M is diagonal.
class LumpedMass final : public MassOperator {
 public:
  /// Throws std::invalid_argument unless every mass is > 0 and finite.
  explicit LumpedMass(Eigen::VectorXd nodal_mass)
      : mass_(std::move(nodal_mass)), inverse_(mass_.cwiseInverse()) {
    if (!(mass_.array() > 0.0).all() || !mass_.allFinite())
      throw std::invalid_argument("LumpedMass: every nodal mass must be > 0 and finite");
  }
  void apply_inverse_mass(const NodalVectors& f, NodalVectors& a) const override {
    a.noalias() = f * inverse_.asDiagonal();
  }
  const Eigen::VectorXd& nodal_mass() const override { return mass_; }

 private:
  Eigen::VectorXd mass_;
  Eigen::VectorXd inverse_;
};

}  // namespace structure
