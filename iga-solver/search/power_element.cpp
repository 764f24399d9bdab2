// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/power_element.h"

namespace search {

ElementAxis::ElementAxis(const Space<2>& space, int direction)
    : knots_(space.knots(direction)),
      count_(knots_.element_count()),
      elements_(count_),
      numbers_{knots_.front(), knots_.back(), count_ / (knots_.back() - knots_.front()), count_ - 1.0,
               &elements_[0].begin} {
  const std::vector<double>&breaks = knots_.breaks(), &creases = knots_.creases();
  int crease = 0;
  for (int e = 0; e < count_; ++e) {
    AxisElement& element = elements_[e];
    element.begin = breaks[e], element.end = breaks[e + 1];
    element.half_width = 0.5 * (element.end - element.begin);
    element.per_half_width = 1.0 / element.half_width;
    const auto local = [&](double xi) { return (xi - element.begin) / element.half_width - 1.0; };
    if (element.begin >= creases[crease + 1]) ++crease;
    element.low = creases[crease] == element.begin ? -1.0 : local(creases[crease]);
    element.high = creases[crease + 1] == element.end ? 1.0 : local(creases[crease + 1]);
    element.first = knots_.span_of_element(e) - knots_.degree();
    element.at_end[0] = e == 0, element.at_end[1] = e + 1 == count_;
    element.functions = &space.functions(direction, e);
  }
}

ElementAxis::Place ElementAxis::search(double xi) const {
  const int e = knots_.element_at(xi);
  return {e, elements_[e].local(xi)};
}

}  // namespace search
