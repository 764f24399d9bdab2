// SPDX-License-Identifier: GPL-2.0-or-later
// An edge of a CAD model inside of a face, which it then bounds from both sides.
#pragma once

#include <optional>

#include "brep/cad_model.h"

namespace geometry_io {

/// The curve of an edge in the parameters of a face that is no patch, from where it is nearest to the face,
/// within `tolerance` [length]; none if it goes round a pole or further than a turn, or takes too many
/// pieces.
std::optional<brep::Spline<2>> curve_on(const brep::Face& face, const brep::CadEdge& edge, double tolerance);

/// Puts an edge into the loops of a face, along `curve` and back: as a slit, as a bridge between loops, or so
/// that a loop becomes two.  Where a loop passes the edge's vertices it begins and ends there.
void lay_in(brep::CadModel& model, int face, int edge, brep::Spline<2> curve);

}  // namespace geometry_io
