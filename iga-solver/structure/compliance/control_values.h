// SPDX-License-Identifier: GPL-2.0-or-later
// Control values of a smooth field: what a spline that is close to it has at its control points.  A field's
// own value at the place of a control point would be first order in the mesh's curvature only.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "structure/compliance/reference_body.h"

namespace structure {

/// Of some nodes of a body: sums of a field's values at points near by, exact for quadratic fields where the
/// map is affine.
class ControlValues {
 public:
  /// Keeps a reference to the body.
  explicit ControlValues(const ReferenceBody& body) : body_(body) {}
  /// The next node.
  void add(Id node);
  int count() const { return static_cast<int>(sums_.size()); }
  /// How near to a place the field would be asked for by a node's sum [length].
  double nearest(Id node, const Vector3& to);

  /// Undeformed places that the field is asked for [length].
  const std::vector<Vector3>& points() const { return points_; }
  /// visit(point, weight) for each term of a node's sum.
  template <class Visit>
  void for_each_term(int node, Visit visit) const {
    for (const auto& [point, weight] : sums_[node]) visit(point, weight);
  }

 private:
  struct Term {
    int point;
    double weight;
  };
  struct Place {
    int point;
    double W;  // sum of weighted functions
  };
  Place place(int patch, const nurbs::Parameter<3>& xi);
  std::vector<Term> terms_of(Id node);

  const ReferenceBody& body_;
  std::vector<std::vector<Term>> sums_;
  std::vector<Vector3> points_;
  std::map<std::pair<int, nurbs::Parameter<3>>, Place> places_;
};

}  // namespace structure
