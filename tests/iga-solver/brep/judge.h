// SPDX-License-Identifier: GPL-2.0-or-later
// Feet of points on walls of triangles by brute force: every triangle, edge and point of the wall is tried,
// and what is a minimum is seen by looking into many directions round it.  Shares nothing with brep/.
#pragma once

#include <array>
#include <vector>

#include "trial_walls.h"

namespace brep::trials {

struct Minimum {
  int sheet;
  Vector3 point;
  double distance;
  std::vector<int> triangles;  ///< of its sheet, round it
};

/// Who says what is a minimum.
class AnyJudge {
 public:
  virtual ~AnyJudge() = default;
  /// Nearer than `reach`.  What is a minimum but for `tolerance` counts if that is positive; if it is
  /// negative, what is one by so much.  `also`: points that a search by samples should look at.
  virtual std::vector<Minimum> minima(const Vector3& d, double reach, double tolerance,
                                      const std::vector<Vector3>& also = {}) const = 0;
  /// Whether a minimum at d stays one, near `point`, wherever d is moved by `by`.
  bool lasts(const Vector3& d, double reach, const Minimum& minimum, double by) const;
};

class Judge final : public AnyJudge {
 public:
  Judge(const Wall& wall, double edge_angle);

  std::vector<Minimum> minima(const Vector3& d, double reach, double tolerance,
                              const std::vector<Vector3>& also = {}) const override;
  /// Of a triangle and a side (0: where the normal of its three points in turn points to).
  int sheet(int triangle, int side) const { return sheets_[2 * triangle + side]; }

  /// Space between two triangles at an edge.
  struct Wedge {
    int from, to;  ///< 2 * triangle + side
    double angle;
  };
  /// Of all edges through p.
  std::vector<Wedge> wedges_at(const Vector3& p) const;
  /// At p, on the edges or points of these triangles: each group of sides that has a minimum there, as
  /// 2 * triangle + side.
  std::vector<std::vector<int>> minima_at(const Vector3& p, const std::vector<int>& triangles,
                                          const Vector3& d, double tolerance) const;

 private:
  Vector3 point(int triangle, int i) const { return wall_.points[wall_.triangles[triangle][i % 3]]; }
  std::vector<Wedge> wedges(int a, int b, const std::vector<int>& triangles) const;
  void add_at(const Vector3& p, const std::vector<int>& triangles, const Vector3& d, double reach,
              double tolerance, std::vector<Minimum>& found) const;
  std::vector<int> edges_through(const Vector3& p, const std::vector<int>& triangles) const;
  bool over_smooth_edges(const Minimum& a, const Minimum& b, double apart) const;

  const Wall wall_;
  double edge_angle_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<std::vector<int>> of_edge_, of_point_;  // triangles
  std::vector<std::vector<Wedge>> wedges_;            // of edges
  std::vector<std::vector<int>> edges_of_point_;
  std::vector<int> sheets_, planes_;
};

}  // namespace brep::trials
