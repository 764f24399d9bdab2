// SPDX-License-Identifier: GPL-2.0-or-later
// The functions of one direction at the quadrature points of a box, as the kernels read them.
#pragma once

#include <vector>

#include "structure/solid/quadrature.h"
#include "structure/sweep/aligned_numbers.h"
#include "structure/sweep/line_kernel.h"

namespace structure {

/// Knot spans begin <= span < end of one direction.
struct SpanRange {
  const nurbs::KnotVector& knots;
  int begin, end;
  int count() const { return end - begin; }
  int first_control(int span) const { return knots.span_of_element(span) - knots.degree(); }
  int control_count() const { return first_control(end - 1) + knots.degree() + 1 - first_control(begin); }
};

/// Of a direction whose spans are swept one after the other.
class SpanBases {
 public:
  SpanBases(const SpanRange& range, const std::vector<nurbs::QuadratureRule>& rules);

  int spans() const { return static_cast<int>(first_.size()); }
  /// First control point of a span, counted from the box's first.
  int first(int span) const { return first_[span]; }
  SpanBasis at(int span) const {
    const int begun = span == 0 ? 0 : first_[span - 1] + length_ / 2 - first_[span];
    return {points_[span], &basis_[begin_[span]], begun};
  }
  double weight(int span, int q) const { return weights_[begin_[span] / length_ + q]; }
  int most_points() const { return most_points_; }

 private:
  int length_, most_points_ = 0;  // numbers of a point
  std::vector<int> first_, points_;
  std::vector<std::size_t> begin_;
  std::vector<double> basis_, weights_;
};

/// Of the direction along which words lie.
class LaneBases {
 public:
  LaneBases(const SpanRange& range, const std::vector<nurbs::QuadratureRule>& rules, int lanes);

  /// `scratch` has scratch_size() numbers.
  LaneBasis basis(double* scratch) const;
  std::size_t scratch_size(int fields) const {
    return first_control_.empty() ? 0 : std::size_t(3) * fields * (degree_ + 1) * row_;
  }
  int row() const { return row_; }
  int point_words() const { return first_word_.back(); }
  const double* weights() const { return weights_.data(); }  ///< [point word][lane]
  /// Span and point of a lane of a point word; weights tell whether there is one.
  struct Place {
    int span, point;
  };
  Place place(int point_word, int lane) const;

 private:
  int degree_, lanes_, spans_, words_, row_;
  std::vector<int> first_word_, first_control_;
  AlignedNumbers basis_, weights_;
};

}  // namespace structure
