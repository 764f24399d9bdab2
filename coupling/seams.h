// SPDX-License-Identifier: GPL-2.0-or-later
// Smooth seams of a body's surface (structure/compliance/smooth_seams.h has the shares and why): contacts
// meet control points there in line with those beside them, and what they press on them goes to these.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "coupling/force_distribution.h"
#include "coupling/net_shares.h"

namespace coupling {

class Seams {
 public:
  explicit Seams(NetShares shares) : shares_(std::move(shares)) {}

  /// Of each control point that is met elsewhere those that it is met by, itself maybe among them.
  const NetShares& shares() const { return shares_; }
  /// Those of these control points that are met elsewhere.
  std::vector<int> among(const std::vector<int>& control_points) const {
    std::vector<int> found;
    std::copy_if(control_points.begin(), control_points.end(), std::back_inserter(found),
                 [this](int c) { return shares_.has(c); });
    return found;
  }
  /// Takes a field (3 x n) to what is met at these, which are met elsewhere.
  void straighten(const std::vector<int>& control_points, NodalVectors& q) {
    values_.clear();
    for (const int c : control_points) values_.push_back(shares_.sum(c, q));
    for (std::size_t k = 0; k < control_points.size(); ++k) q.col(control_points[k]) = values_[k];
  }
  /// Moves forces, of 3 x n, from these control points to those that they are met by; visits these, who may
  /// come to the list behind.
  template <class Visit>
  void carry(const std::vector<int>& control_points, NodalVectors& f, Visit visit) {
    const std::size_t count = control_points.size();
    values_.clear();
    for (const int c : control_points) {
      values_.push_back(f.col(c));
      if (shares_.has(c)) f.col(c).setZero();
    }
    for (std::size_t k = 0; k < count; ++k)
      shares_.for_each(control_points[k], [&](int to, double share) {
        f.col(to) += share * values_[k];
        visit(to);
      });
  }
  /// FootBasis::sum_of_squares of what comes to control points.
  double sum_of_squares(const FootBasis& foot, const Vector3& n, const NodalVectors& q) const;

 private:
  NetShares shares_;
  std::vector<Vector3> values_;
};

}  // namespace coupling
