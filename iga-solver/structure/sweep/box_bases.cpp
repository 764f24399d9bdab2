// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/box_bases.h"

#include <algorithm>

namespace structure {

namespace {

/// n rounded up to whole words.
int whole_words(int n, int lanes) { return (n + lanes - 1) / lanes * lanes; }

nurbs::BasisFunctions functions_at(const SpanRange& range, int span, double xi) {
  nurbs::BasisFunctions functions;
  nurbs::evaluate_basis(range.knots, range.knots.span_of_element(span), xi, 1, functions);
  return functions;
}

}  // namespace

SpanBases::SpanBases(const SpanRange& range, const std::vector<nurbs::QuadratureRule>& rules)
    : length_(2 * (range.knots.degree() + 1)) {
  for (int span = range.begin; span < range.end; ++span) {
    const nurbs::QuadratureRule& rule = rules[span];
    first_.push_back(range.first_control(span) - range.first_control(range.begin));
    points_.push_back(static_cast<int>(rule.points.size()));
    most_points_ = std::max(most_points_, points_.back());
    begin_.push_back(basis_.size());
    weights_.insert(weights_.end(), rule.weights.begin(), rule.weights.end());
    for (const double xi : rule.points) {
      const nurbs::BasisFunctions functions = functions_at(range, span, xi);
      for (int k = 0; k < 2; ++k)
        basis_.insert(basis_.end(), functions.values[k], functions.values[k] + length_ / 2);
    }
  }
}

LaneBases::LaneBases(const SpanRange& range, const std::vector<nurbs::QuadratureRule>& rules, int lanes)
    : degree_(range.knots.degree()),
      lanes_(lanes),
      spans_(range.count()),
      words_((spans_ + lanes - 1) / lanes),
      first_word_{0} {
  bool repeated = false;
  for (int s = 0; s < spans_; ++s) {
    first_control_.push_back(range.first_control(range.begin + s) - range.first_control(range.begin));
    repeated = repeated || first_control_.back() != s;
  }
  row_ = whole_words(std::max(words_ * lanes + degree_, range.control_count()), lanes);
  if (!repeated) first_control_.clear();
  for (int word = 0; word < words_; ++word) {
    const int begin = word * lanes, end = std::min(begin + lanes, spans_);
    std::size_t points = 0;
    for (int s = begin; s < end; ++s) points = std::max(points, rules[range.begin + s].points.size());
    first_word_.push_back(first_word_.back() + static_cast<int>(points));
  }
  const std::size_t length = std::size_t(2) * (degree_ + 1) * lanes;
  basis_.assign(point_words() * length, 0.0);
  weights_.assign(std::size_t(point_words()) * lanes, 0.0);
  for (int s = 0; s < spans_; ++s) {
    const nurbs::QuadratureRule& rule = rules[range.begin + s];
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const std::size_t word = first_word_[s / lanes] + q, lane = s % lanes;
      const nurbs::BasisFunctions functions = functions_at(range, range.begin + s, rule.points[q]);
      weights_[word * lanes + lane] = rule.weights[q];
      for (int k = 0; k < 2; ++k)
        for (int a = 0; a <= degree_; ++a)
          basis_[word * length + (k * (degree_ + 1) + a) * lanes + lane] = functions.values[k][a];
    }
  }
}

LaneBasis LaneBases::basis(double* scratch) const {
  return {spans_,        words_,
          row_,          first_word_.data(),
          basis_.data(), first_control_.empty() ? nullptr : first_control_.data(),
          scratch};
}

LaneBases::Place LaneBases::place(int point_word, int lane) const {
  const int word = static_cast<int>(std::upper_bound(first_word_.begin(), first_word_.end(), point_word) -
                                    first_word_.begin()) -
                   1;
  return {word * lanes_ + lane, point_word - first_word_[word]};
}

}  // namespace structure
