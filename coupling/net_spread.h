// SPDX-License-Identifier: GPL-2.0-or-later
// Spreads a contact's force over the control points about its foot, and reads what the surface does there:
// beside R_A at the foot, w Z_A, Z being sums over shares of R (coupling/local_compliance.h).
#pragma once

#include <utility>

#include "coupling/force_distribution.h"
#include "coupling/net_shares.h"

namespace coupling {

class NetSpread {
 public:
  explicit NetSpread(NetShares shares) : shares_(std::move(shares)) {}

  /// Of each control point, where a force on it is spread to.
  const NetShares& shares() const { return shares_; }
  /// Adds Z_A F to the forces f of control points (3 x n); visits those that it spreads to.
  template <class Visit>
  void distribute(const nurbs::SurfaceValues& foot, const Vector3& F, NodalVectors& f, Visit visit) const {
    const double* R = foot.R;
    for_each(foot, [&](int c) {
      const Vector3 of_node = *R++ * F;
      shares_.for_each(c, [&](int to, double share) {
        f.col(to) += share * of_node;
        visit(to);
      });
    });
  }
  /// Sum of Z_A q_A at a foot and its derivatives with the parameters, of a field of control points (3 x n).
  struct Sums {
    Vector3 value;
    nurbs::Tangents slopes;
  };
  Sums sums(const nurbs::SurfaceSlopes& foot, const NodalVectors& q) const;
  Vector3 sum(const nurbs::SurfaceValues& foot, const NodalVectors& q) const;

 private:
  NetShares shares_;
};

}  // namespace coupling
