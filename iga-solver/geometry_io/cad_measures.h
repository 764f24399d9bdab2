// SPDX-License-Identifier: GPL-2.0-or-later
// What can be measured on a CAD model: areas, how faces meet, how far borders are from edges.
#pragma once

#include <vector>

#include "brep/cad_model.h"

namespace geometry_io {

/// Point of a face, and its normal (0 where it has none), on its surface at xi.
brep::Vector3 point_of(const brep::CadModel& model, const brep::CadFace& face, const nurbs::Parameter<2>& xi);
brep::Vector3 normal_of(const brep::CadModel& model, const brep::CadFace& face,
                        const nurbs::Parameter<2>& xi);
/// How far a point is from an edge's curve, which goes on beyond its ends if it is a line [length].
double distance_to(const brep::CadEdge& edge, const brep::Vector3& point);

/// By Green's theorem along the loops, Gauss's rule: of closed forms to about 1e-12, of patches to 1e-6 of
/// itself [length^2].
double area_of(const brep::CadModel& model, const brep::CadFace& face);

/// How the faces at an edge meet, where they do so worst.
struct EdgeMeasure {
  enum class Kind { free, smooth, near_tangent, sharp, many };  ///< many: more than two faces
  Kind kind = Kind::free;
  double angle = 0.0;  ///< between the two faces' planes [rad]
  double gap = 0.0;    ///< between the border of one of them and the edge [length]
};
constexpr double kSmoothAngle = 1e-3, kNearTangentAngle = 0.02;  ///< [rad]
std::vector<EdgeMeasure> measured_edges(const brep::CadModel& model);

}  // namespace geometry_io
