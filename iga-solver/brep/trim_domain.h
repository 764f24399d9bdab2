// SPDX-License-Identifier: GPL-2.0-or-later
// The part of a face's parameters that its loops leave: what is inside of an odd number of them.
#pragma once

#include <functional>
#include <vector>

#include "brep/bezier_curve.h"

namespace brep {

class TrimDomain {
 public:
  /// Where a loop's curves do not meet, straight lines join them.  Throws std::invalid_argument as beziers()
  /// does, and if the loops have no extent.
  explicit TrimDomain(const std::vector<Loop>& loops);

  /// Exact but for round-off; on a border it is one or the other.
  bool inside(const Parameter<2>& xi) const;
  /// Of a box of parameters.  What is said to be cut may be inside or outside if it is close to the border.
  enum class Where : std::int8_t { inside, outside, cut };
  Where where(const Parameter<2>& low, const Parameter<2>& high) const;
  /// The border in straight pieces, each with the sense of its loop: curves and lines are halved until
  /// `is_straight` says of their ends that it is enough.
  using Segment = std::pair<Parameter<2>, Parameter<2>>;
  std::vector<Segment> segments(
      const std::function<bool(const Parameter<2>&, const Parameter<2>&)>& is_straight) const;
  /// The box around all loops.
  const Parameter<2>& low() const { return low_; }
  const Parameter<2>& high() const { return high_; }

 private:
  using Point = Eigen::Vector2d;
  // A part of the border along which xi1 rises or falls all the way, or a straight line.
  struct Part {
    Point from, to;
    int curve;  // of curves_; -1: straight
    Parameter<2> low, high;
    double bulge = 0.0;  // the curve's points are beyond the line by no more
    // Distance of a point from the straight line, times that one's length; more than 0 to its left.
    double beyond(const Point& x) const {
      return (to[0] - from[0]) * (x[1] - from[1]) - (x[0] - from[0]) * (to[1] - from[1]);
    }
  };
  void add_loop(const Loop& loop);
  void add_line(const Point& from, const Point& to);
  void add_curve(const BezierCurve<2>& curve, int depth);
  void add_small_parts(const BezierCurve<2>& curve, int depth);
  void add_part(const Point& from, const Point& to, const BezierCurve<2>* curve);
  void make_bands();
  bool is_left_of(const Part& part, const Parameter<2>& xi) const;
  Point crossing(const Part& part, double xi1) const;
  bool meets(const Part& part, const Parameter<2>& low, const Parameter<2>& high) const;

  std::vector<Part> parts_;
  std::vector<BezierCurve<2>> curves_;
  std::vector<int> first_, in_band_;  // parts in bands of equal height over the range of xi1
  double bands_per_length_ = 0.0;
  Parameter<2> low_, high_;
};

}  // namespace brep
