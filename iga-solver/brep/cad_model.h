// SPDX-License-Identifier: GPL-2.0-or-later
// What a CAD file says: faces, the curves that bound them in their parameters, edges, vertices, solids.  As
// it was read, before anything is made ready for searches.
#pragma once

#include <string>
#include <vector>

#include "brep/face.h"
#include "nurbs/patch.h"

namespace brep {

/// A B-spline curve with open knots, in Dim dimensions.
template <int Dim>
struct Spline {
  int degree = 1;
  std::vector<double> knots;  ///< rising, the first and the last degree + 1 times
  Eigen::Matrix<double, Dim, Eigen::Dynamic> points;
  std::vector<double> weights;  ///< of the points; none: not rational
};

/// A piece of a face's border, in the face's parameters (face.h; of a patch its own), in the sense of its
/// loop.  Angles go on beyond a turn where the border does.
struct Trim {
  Spline<2> curve;
  int edge;      ///< where it is in space; -1: nowhere, a pole or the tip of a cone
  bool forward;  ///< the edge runs along it
};
/// Closed; the face is at its left in the plane of (xi0, xi1).
using Loop = std::vector<Trim>;

struct CadFace {
  Face shape;               ///< without pieces; low, high: the box of its loops
  std::vector<Loop> loops;  ///< one at least
  int solid = -1;           ///< of CadModel::solids, which may be a sheet; -1: none
  int outward = 0;  ///< +1 or -1: the side of shape's normal that is outside of its solid; 0: two-sided
  int number = 0;   ///< in the file, from 1
  int entity = 0;   ///< #number of STEP; 0: none
  int colour = -1;  ///< 0xRRGGBB; -1: none
  std::string name;
  double tolerance = 0.0;  ///< how far its border may be from its surface [length]
};

/// An edge in space; a seam is twice in the loops of one face.
struct CadEdge {
  enum class Kind : std::int8_t { line, circle, spline };
  Kind kind = Kind::line;
  Vector3 origin, axis, radial;  ///< as Edge's: start and direction of a line; centre, axis, way to the start
  double R = 0.0;                ///< of a circle [length]
  double length = 0.0;           ///< of a line [length]; angle of an arc, 2 pi if closed [rad]
  Spline<3> curve;               ///< of a spline
  int vertex[2] = {-1, -1};      ///< the same twice if it is closed
  double tolerance = 0.0;        ///< how far its faces may be from it [length]
};

struct CadVertex {
  Vector3 point;
  double tolerance = 0.0;  ///< [length]
};

struct CadSolid {
  std::string name;
  int colour = -1;      ///< as of a face
  bool closed = false;  ///< a body, not a sheet
};

struct CadModel {
  std::vector<CadFace> faces;
  std::vector<CadEdge> edges;
  std::vector<CadVertex> vertices;
  std::vector<CadSolid> solids;
  std::vector<nurbs::Surface> patches;  ///< of faces of kind nurbs
  std::string unit;                     ///< of length in the file, such as "millimetre"
  std::vector<std::string> healed;      ///< what reading has changed, a line each
};

}  // namespace brep
