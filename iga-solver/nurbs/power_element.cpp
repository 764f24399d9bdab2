// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/power_element.h"

namespace nurbs {

std::vector<AxisElement> axis_elements(const Space<2>& space, int direction) {
  const KnotVector& knots = space.knots(direction);
  const std::vector<double>&breaks = knots.breaks(), &creases = knots.creases();
  std::vector<AxisElement> elements(knots.element_count());
  int crease = 0;
  for (int e = 0; e < knots.element_count(); ++e) {
    AxisElement& element = elements[e];
    element.begin = breaks[e], element.end = breaks[e + 1];
    element.half_width = 0.5 * (element.end - element.begin);
    element.per_half_width = 1.0 / element.half_width;
    const auto local = [&](double xi) { return (xi - element.begin) / element.half_width - 1.0; };
    if (element.begin >= creases[crease + 1]) ++crease;
    element.low = creases[crease] == element.begin ? -1.0 : local(creases[crease]);
    element.high = creases[crease + 1] == element.end ? 1.0 : local(creases[crease + 1]);
    element.first = knots.span_of_element(e) - knots.degree();
    element.at_end[0] = e == 0, element.at_end[1] = e + 1 == knots.element_count();
    element.bezier = space.functions(direction, e).bezier;
    element.power = space.functions(direction, e).power;
  }
  return elements;
}

}  // namespace nurbs
