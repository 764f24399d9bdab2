// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces of OpenCASCADE as closed forms or patches, and what becomes of their parameters.
#pragma once

#include <GeomAdaptor_Surface.hxx>
#include <functional>
#include <optional>
#include <string>

#include "geometry_io/any_spline.h"

namespace geometry_io {

/// From one parameter of OpenCASCADE to one of ours.
struct ParameterMap {
  double scale = 1.0, shift = 0.0;
  double arc[2] = {0.0, 0.0};  ///< of unit_arc in the place of an angle; alike: none
  bool affine() const { return arc[0] == arc[1]; }
  double operator()(double t) const {
    return affine() ? scale * t + shift : arc_parameter(arc[0], arc[1], t);
  }
};

struct ReadSurface {
  brep::Face shape;                     ///< without range
  std::optional<nurbs::Surface> patch;  ///< of kind nurbs
  ParameterMap map[2];
  /// Whether our normal is OpenCASCADE's, dS/du x dS/dv, and not the opposite one.
  bool same_side() const { return map[0].scale * map[1].scale > 0.0; }
};

/// Where a face is in the parameters of its surface: of OpenCASCADE's.
struct ParameterBox {
  double low[2], high[2];
};

/// Exact, but for surfaces of offset, which are fitted within `tolerance` [mm], if it is > 0; then
/// `fitted_anew` is set.  Throws std::runtime_error with what this is a surface of.
ReadSurface surface_of(const GeomAdaptor_Surface& surface, const ParameterBox& box, double tolerance,
                       bool& fitted_anew);

}  // namespace geometry_io
