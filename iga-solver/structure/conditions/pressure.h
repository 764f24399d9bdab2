// SPDX-License-Identifier: GPL-2.0-or-later
// A pressure that follows the motion: along the normal of the deformed skin, per deformed area,
//   f_A = - integral of p R_A n da = - integral of p R_A (dx/du x dx/dv) du dv
// (Bonet & Wood 2008, sec. 8.5.2).  Degree + 2 Gauss points make the sum of all forces on a closed skin of
// polynomials vanish.
#pragma once

#include <vector>

#include "structure/conditions/changing_load.h"
#include "structure/conditions/skin_surface.h"

namespace structure {

class FollowingPressure final : public ChangingLoad {
 public:
  /// p = pressure.x(X, t) times factor(t) [force/length^2], positive pushes.
  FollowingPressure(const Body& body, const SkinSurface& surface, Field pressure, TimeFunction factor);
  void add(double t, const NodalVectors& x, const Halo& halo, NodalVectors& f) const override;

 private:
  struct Point {
    Vector3 X;
    double weight;      // du dv, and the sign that makes normals point outwards
    std::size_t first;  // of its functions: nodes_, values_
  };
  struct Box {
    SkinBox skin;
    std::size_t end;  // of its points
  };
  struct Values {
    double R, dR_du, dR_dv;
  };
  void add_points(const nurbs::BoundarySurface& skin, const NodalVectors& X, const SkinBox& box);
  void push(const Point& point, double p, const SkinBox& box, const NodalVectors& x) const;

  int functions_;  // per point
  Field pressure_;
  TimeFunction factor_;
  std::vector<Box> boxes_;
  std::vector<Point> points_;
  std::vector<int> nodes_;  // of a box's control points
  std::vector<Values> values_;
  mutable NodalVectors in_box_, share_;
};

}  // namespace structure
