// SPDX-License-Identifier: GPL-2.0-or-later
// The operator that analyses solve with: tangent stiffness, perhaps with a multiple of the mass, on
// the degrees of freedom that are free.  It is known by its products alone.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "structure/analysis/mass_matrix.h"
#include "structure/body.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"

namespace structure {

/// y = A x of a symmetric A, both 3 x node_count.
using Product = std::function<void(const NodalVectors& x, NodalVectors& y)>;

/// (K(u) + springs + shift M) x, 0 at fixed degrees of freedom, where x is 0, too.  Keeps references to body,
/// supports and springs, and to u, which may move on between products.
class Tangent {
 public:
  /// `shift` [1/time^2] times `mass`, which is referred to, too; times row-sum masses without.
  Tangent(const Body& body, const Supports& supports, const NodalVectors& u, double shift = 0.0,
          const Springs& springs = no_springs(), const MassMatrix* mass = nullptr)
      : body_(body), supports_(supports), springs_(springs), u_(u), shift_(shift), mass_(mass) {}
  static const Springs& no_springs() {
    static const Springs kNone;
    return kNone;
  }

  void multiply(const NodalVectors& x, NodalVectors& y) const {
    body_.internal_force_change(u_, x, y);
    springs_.add_forces(x, y);
    if (shift_ != 0.0 && mass_) y += shift_ * (*mass_ * x);
    if (shift_ != 0.0 && !mass_) y.noalias() += shift_ * (x * body_.row_sum_mass().asDiagonal());
    supports_.apply(y);
  }
  Product product() const {
    return [this](const NodalVectors& x, NodalVectors& y) { multiply(x, y); };
  }

  const Body& body() const { return body_; }
  const Supports& supports() const { return supports_; }
  double shift() const { return shift_; }

 private:
  const Body& body_;
  const Supports& supports_;
  const Springs& springs_;
  const NodalVectors& u_;
  double shift_;
  const MassMatrix* mass_;
};

}  // namespace structure
