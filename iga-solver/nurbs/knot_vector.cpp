// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/knot_vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/usable_number.h"

namespace nurbs {
namespace {

void check_degree(int degree) {
  if (degree < 1 || degree > kMaxDegree)
    throw std::invalid_argument(fmt::format("degree is {}, expected 1 to {}", degree, kMaxDegree));
}

void check_order(int degree, const std::vector<double>& knots) {
  const size_t least = 2 * (degree + 1);
  if (knots.size() < least)
    throw std::invalid_argument(
        fmt::format("{} knots given, degree {} expects at least {}", knots.size(), degree, least));
  for (size_t i = 0; i < knots.size(); ++i) {
    if (!is_usable(knots[i]))
      throw std::invalid_argument(fmt::format("knot {} is {}, expected a finite number of at most {} in size",
                                              i + 1, knots[i], kLargestNumber));
    if (i > 0 && knots[i] < knots[i - 1])
      throw std::invalid_argument(fmt::format("knot {} is {} after {}, expected knots that do not decrease",
                                              i + 1, knots[i], knots[i - 1]));
  }
  if (knots.front() == knots.back())
    throw std::invalid_argument(
        fmt::format("all knots are {}, expected two different ones at least", knots.front()));
}

}  // namespace

KnotVector::KnotVector(int degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
  check_degree(degree_);
  check_order(degree_, knots_);
  for (int i = 0; i + 1 < static_cast<int>(knots_.size()); ++i)
    if (knots_[i] < knots_[i + 1]) {
      breaks_.push_back(knots_[i]);
      span_of_element_.push_back(i);
    }
  breaks_.push_back(knots_.back());

  const int first = span_of_element_.front() + 1;
  const int last = static_cast<int>(knots_.size()) - 1 - span_of_element_.back();
  if (first != degree_ + 1 || last != degree_ + 1)
    throw std::invalid_argument(fmt::format(
        "knot vector is not open: first knot {} times and last knot {} times, degree {} expects {} times",
        first, last, degree_, degree_ + 1));
  for (int e = 1; e < element_count(); ++e) {
    const int multiplicity = span_of_element_[e] - span_of_element_[e - 1];
    if (multiplicity > degree_)
      throw std::invalid_argument(
          fmt::format("interior knot {} stands {} times, degree {} expects at most {} times", breaks_[e],
                      multiplicity, degree_, degree_));
  }

  creases_.push_back(front());
  for (int e = 1; e < element_count(); ++e)
    if (span_of_element_[e] - span_of_element_[e - 1] == degree_) creases_.push_back(breaks_[e]);
  creases_.push_back(back());
  elements_per_length_ = element_count() / (back() - front());
}

KnotVector KnotVector::from_breaks(int degree, const std::vector<double>& breaks) {
  check_degree(degree);
  if (breaks.size() < 2)
    throw std::invalid_argument(fmt::format("{} breakpoints given, expected at least 2", breaks.size()));
  for (size_t i = 1; i < breaks.size(); ++i)
    if (!(breaks[i - 1] < breaks[i]))
      throw std::invalid_argument(
          fmt::format("breakpoint {} is {} after {}, expected strictly increasing ones", i + 1, breaks[i],
                      breaks[i - 1]));
  std::vector<double> knots(degree, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), degree, breaks.back());
  return KnotVector(degree, std::move(knots));
}

KnotVector KnotVector::uniform(int degree, int elements, double first, double last) {
  if (elements < 1)
    throw std::invalid_argument(fmt::format("{} elements given, expected at least 1", elements));
  std::vector<double> breaks(elements + 1, last);
  for (int i = 0; i < elements; ++i) breaks[i] = first + (last - first) * i / elements;
  return from_breaks(degree, breaks);
}

int KnotVector::search_element(double xi) const {
  // Searching the interior breakpoints alone clamps to the first and the last element.
  const auto first = breaks_.begin() + 1, last = breaks_.end() - 1;
  return static_cast<int>(std::upper_bound(first, last, xi) - first);
}

std::vector<double> KnotVector::greville() const {
  std::vector<double> abscissae(control_point_count());
  for (int i = 0; i < control_point_count(); ++i) {
    // A mean of differences is exact where all knots are equal, so both ends are hit exactly.
    double sum = 0.0;
    for (int k = 2; k <= degree_; ++k) sum += knots_[i + k] - knots_[i + 1];
    abscissae[i] = knots_[i + 1] + sum / degree_;
  }
  return abscissae;
}

}  // namespace nurbs
