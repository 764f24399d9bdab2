// SPDX-License-Identifier: GPL-2.0-or-later
// Spreads a contact's force over the control points about its foot, and reads what the surface does there:
// beside R_A at the foot, w Z_A, Z being sums over shares of R (coupling/local_compliance.h).
#pragma once

#include <utility>
#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/force_distribution.h"
#include "coupling/local_compliance.h"

namespace coupling {

class NetSpread {
 public:
  /// `map`: of the whole structure, each control point a node.
  NetSpread(const SurfaceMap& map, const std::vector<LocalCompliance::Share>& shares);

  /// f(control point, share) for each that a force on this one is spread to.
  template <class Function>
  void for_each_share(int control_point, Function f) const {
    for (int k = first_[control_point]; k < first_[control_point + 1]; ++k)
      f(shares_[k].control_point, shares_[k].share);
  }
  /// Adds Z_A F to the forces f of control points (3 x n); visits those that it spreads to.
  template <class Visit>
  void distribute(const nurbs::SurfaceValues& foot, const Vector3& F, NodalVectors& f, Visit visit) const {
    const double* R = foot.R;
    for_each(foot, [&](int c) {
      const Vector3 of_node = *R++ * F;
      for_each_share(c, [&](int to, double share) {
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
  struct Share {
    int control_point;
    double share;
  };
  Vector3 of_control_point(int c, const NodalVectors& q) const;

  std::vector<int> first_;  // of each control point's shares
  std::vector<Share> shares_;
};

}  // namespace coupling
