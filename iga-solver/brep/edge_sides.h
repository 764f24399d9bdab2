// SPDX-License-Identifier: GPL-2.0-or-later
// On which sides of an edge a point is, wherever it moves within a margin: over a face the foot of the point
// comes across an edge, or leaves it, where the point is square above that edge, between its two sides.
#pragma once

#include <memory>
#include <vector>

#include "brep/surface.h"

namespace brep {

class EdgeSides {
 public:
  /// Keeps a reference.
  explicit EdgeSides(const Surface& surface) : surface_(surface) {}

  /// Of the feet on an edge, or on a chunk of one, of any point less than `margin` from d that reaches
  /// `reach` - `margin`.
  struct Sides {
    bool has_feet = true;            ///< false: there are none
    bool is_smooth = false;          ///< its two faces go on as one, on both sides
    std::int8_t of_use[2] = {0, 0};  ///< +1: the point is over this face (of the edge's two), -1: off it, for
                                     ///< certain; 0: either
    /// Whether none of these feet counts: one does only where no face falls towards the point.
    bool has_no_contact() const {
      return !has_feet || (of_use[0] > 0 && of_use[1] > 0) || (is_smooth && of_use[0] * of_use[1] < 0);
    }
    bool is_certain(int use) const { return !has_feet || of_use[use] != 0; }
  };
  /// Looks at the shape of a spline when it is asked for it first.
  Sides sides(const Piece& piece, const Vector3& d, double reach, double margin);

 private:
  // Of directions of length 1: their middle, and how far they are from it at most.
  struct Spread {
    Vector3 middle;
    double most;
  };
  static Spread spread(const std::vector<Vector3>& directions);
  // A part of a chunk that is nearly straight and along which its faces hardly turn.
  struct Part {
    Vector3 centre;
    double radius;  // of a ball around it [length]
    Spread tangent, conormal[2];
    bool is_smooth;
  };
  struct Parts {
    bool are_known = false;  // else nothing is said of the chunk
    std::vector<Part> parts;
  };
  Sides of_whole(const Edge& edge, const Vector3& d, double reach, double margin) const;
  const Parts& parts_of(int edge, int chunk);
  void add_parts(const Edge& edge, const BezierCurve<3>& curve, int depth, Parts& parts) const;
  Part part_of(const Edge& edge, const BezierCurve<3>& curve) const;
  bool is_smooth(const Vector3& conormal, const Vector3& other) const;

  const Surface& surface_;
  std::vector<std::unique_ptr<const Parts>> parts_;  // of chunks; null: nobody has asked
};

}  // namespace brep
