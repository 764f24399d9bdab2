// SPDX-License-Identifier: GPL-2.0-or-later
// Faces in closed form by brute force: points from the table in brep/face.h, minima from a grid of
// parameters.
#pragma once

#include <utility>
#include <vector>

#include "brep/face.h"

namespace brep::trials {

Face face_of(Kind kind, const Frame& frame, double R, double r, Parameter<2> low, Parameter<2> high);

/// Points of a face, its range closed.
Vector3 point_on(const Face& face, double a, double b);

/// Unit tangents along both parameters; their cross product points to side +.  At a pole the first is that of
/// the meridian's plane.
std::pair<Vector3, Vector3> tangents_on(const Face& face, const Parameter<2>& xi);
/// Of the surface's point nearest to p, which is near it, clamped to the range.
Parameter<2> nearest_parameters(const Face& face, const Vector3& p);

class Grid {
 public:
  explicit Grid(const Face& face);

  struct Lowest {
    Vector3 point;
    Parameter<2> xi;
  };
  /// Local minima of the distance on the closed face: from the lowest points of a grid downhill, by ever
  /// smaller steps.
  std::vector<Lowest> minima(const Vector3& d, double reach) const;
  /// Downhill from xi, by steps too small to leave the least hollow.
  Lowest settle(const Vector3& d, const Parameter<2>& xi) const { return descend(d, xi, 1e-7); }
  /// Whether no point is nearer to d beside xi.
  bool is_lowest_around(const Vector3& d, const Parameter<2>& xi) const;
  /// Whether xi[i] goes round.
  bool turns(int i) const { return turn_[i]; }

 private:
  double step(int i, int k) const { return face_.low[i] + (face_.high[i] - face_.low[i]) * k / n; }
  bool pole(int j) const;
  int next(int i, int k) const;
  Vector3 at(const Parameter<2>& xi) const { return point_on(face_, xi[0], xi[1]); }
  Parameter<2> beside(const Parameter<2>& xi, int k, double share) const;
  bool is_stationary(const Vector3& d, const Parameter<2>& xi) const;
  Lowest descend(const Vector3& d, Parameter<2> xi, double size) const;

  static constexpr int n = 40;  // cells along each parameter
  Face face_;
  bool turn_[2];
  std::vector<Vector3> points_;
  double cell_ = 0.0;  // between two neighbours at most
};

}  // namespace brep::trials
