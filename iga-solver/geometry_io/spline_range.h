// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "geometry_io/any_spline.h"

namespace geometry_io {

struct Range {
  double low, high;
};
/// Of one coordinate along a curve, to some 1e-15 of its size.
Range range_of(const AnySpline& curve, int coordinate);

}  // namespace geometry_io
