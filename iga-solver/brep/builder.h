// SPDX-License-Identifier: GPL-2.0-or-later
// From triangles and faces in closed form to a wall.
#pragma once

#include <vector>

#include "brep/cad_model.h"
#include "brep/surface.h"

namespace brep {

/// What the builder did with triangles that cannot stay as they are.
struct BuildReport {
  int collapsed = 0;    ///< left out: two of their points are one, or nothing but thin triangles is around
  int thin = 0;         ///< height below 1e-6 of the size: part of the plane beyond their longest side
  int duplicates = 0;   ///< left out: another one has the same points
  int t_junctions = 0;  ///< corners on sides of other triangles (kOnSide in t_junctions.h): joined to them
  int worst_triangle = -1;    ///< of the least height
  double least_height = 0.0;  ///< its height [length]
};

/// `points` (3 x n) are merged already: triangles (three numbers of points each) that share an edge share its
/// points, or have corners on it.  Neighbours that lie in one plane to 1e-6 of the size become one plane
/// face; wedges within edge_angle [rad] of pi are smooth.  Either orientation of triangles will do.  Throws
/// std::invalid_argument if a number is not finite or there is no such point, or if no triangle is left.
Surface from_triangles(const NodalVectors& points, const std::vector<int>& triangles,
                       double edge_angle = kEdgeAngle, BuildReport* report = nullptr);

/// Faces with rectangles of parameters; borders of two that coincide to 1e-9 of the size are one edge.  A
/// whole turn has no border at its seam; the tip of a cone and the poles of part of a sphere are vertices.
/// Throws std::invalid_argument, naming the face, if a radius, angle or range is not possible.
Surface from_faces(const std::vector<Face>& faces, double edge_angle = kEdgeAngle);

/// These faces of a CAD model, with the edges and vertices on their borders; an edge whose other faces are
/// not among them is free.  Throws std::invalid_argument, naming the face, if its loops make no sense.
Surface from_cad(const CadModel& model, const std::vector<int>& faces, double edge_angle = kEdgeAngle);

}  // namespace brep
