// SPDX-License-Identifier: GPL-2.0-or-later
// Shares between nodes (coupling/local_compliance.h) as shares between control points of the surface.
#pragma once

#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/force_distribution.h"
#include "coupling/local_compliance.h"

namespace coupling {

class NetShares {
 public:
  /// `map`: of the whole structure, each control point a node.
  NetShares(const SurfaceMap& map, const std::vector<LocalCompliance::Share>& shares);

  /// Whether this control point has any.
  bool has(int control_point) const { return first_[control_point] < first_[control_point + 1]; }
  /// Whether one of a foot's has.
  bool has_any(const FootBasis& foot) const {
    bool found = false;
    foot.for_each_control_point([&](int c) { found = found || has(c); });
    return found;
  }
  /// f(control point, share) for each of this one's.
  template <class Function>
  void for_each(int control_point, Function f) const {
    for (int k = first_[control_point]; k < first_[control_point + 1]; ++k)
      f(shares_[k].control_point, shares_[k].share);
  }
  /// The sum of shares of a field of control points (3 x n).
  Vector3 sum(int control_point, const NodalVectors& q) const {
    Vector3 sum = Vector3::Zero();
    for_each(control_point, [&](int to, double share) { sum += share * q.col(to); });
    return sum;
  }

 private:
  struct Share {
    int control_point;
    double share;
  };
  std::vector<int> first_;  // of each control point's shares
  std::vector<Share> shares_;
};

}  // namespace coupling
