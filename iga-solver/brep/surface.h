// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid wall of faces, edges and vertices, without its search (foot_search.h).  Every face has two sides, +
// where its normal points to and -.  Round an edge there are as many wedges of space as faces (one face: one
// wedge of 2 pi); sides on both ends of a convex or smooth wedge belong to one sheet (README.md).
#pragma once

#include <string>
#include <vector>

#include "brep/face.h"

namespace brep {

/// What a wedge of space between two faces is: by its angle, which is above pi + edge_angle, nearly pi, or
/// below pi - edge_angle.  Of smooth ones those below pi are marked.
enum class Wedge : std::int8_t { convex, smooth, smooth_concave, concave };
inline bool joins(Wedge wedge) { return wedge != Wedge::concave; }

/// A face that meets in an edge, and the wedge that begins at it, counterclockwise.
struct EdgeUse {
  double conormal[2];  ///< into the face, in the plane across the edge (Edge::across)
  int face, edge;      ///< their numbers
  std::int8_t side;    ///< +1 or -1: the side of the face that looks into the wedge
  Wedge wedge;         ///< up to the next use of the edge
  bool wide;           ///< the wedge's angle is pi or more
};

/// A straight line, or a circle or an arc of one.
struct Edge {
  Vector3 origin;  ///< start of a line, centre of a circle
  Vector3 axis;    ///< direction of a line from start to end, axis of a circle
  Vector3 radial;  ///< across a line: conormal of its first use; from a circle's centre to its start
  double length;   ///< of a line [length]; angle of an arc about its axis, 2 pi if closed [rad]
  double R = 0.0;  ///< radius; 0: a line [length]
  int vertex[2];   ///< start and end; -1: closed
  int first_use = 0, use_count = 0;  ///< of Surface::uses, by their angle

  bool line() const { return R == 0.0; }
  bool closed() const { return vertex[0] < 0; }
  /// Length along a line, angle along an arc.
  Vector3 point(double t) const;
  Vector3 tangent(double t) const;
};

/// One sector of a face at a vertex, between two rays (ends of edges) counterclockwise about the normal.
/// Numbers of groups and regions count within the vertex, for the sides + and -.
struct Corner {
  int face;
  int ray[2];              ///< 2 * use + 1 if it is the edge's end that is here; -1: the whole tip of a cone
  std::int16_t group[2];   ///< sides that convex and smooth wedges join round the vertex
  std::int16_t region[2];  ///< sides that wedges of any kind join: what is in the same region of space
  bool leads[2];           ///< the first corner of its group
  bool reflex;             ///< the sector's angle is pi or more, to 1e-6
};

/// Where two separate fans of faces touch in a point there are two vertices.
struct Vertex {
  Vector3 point;
  int first_corner = 0, corner_count = 0;  ///< none: in the middle of a plane face
};

/// A triangle of a plane face, counterclockwise about its normal; other faces have one piece each.
struct Piece {
  int face;
  int vertex[3];  ///< -1: not a triangle
  int edge[3];    ///< use of the edge from vertex[i] to vertex[i + 1]; -1: inside the face; see Borders
  bool triangle() const { return vertex[0] >= 0; }
};

/// Of a piece that is no triangle, number edge[0] of Surface::borders.  Sides of its rectangle are
/// counterclockwise: xi1 = low, xi0 = high, xi1 = high, xi0 = low; corner i is where side i begins.
struct Borders {
  int use[4] = {-1, -1, -1, -1};     ///< -1: a seam or a pole
  int vertex[4] = {-1, -1, -1, -1};  ///< -1: none; the tip of a whole cone is the first
};

constexpr double kEdgeAngle = 0.02;  ///< of edges that count as smooth, if nothing else is said [rad]

struct Surface {
  std::vector<Face> faces;
  std::vector<Piece> pieces;  ///< of one face in a row
  std::vector<Borders> borders;
  std::vector<Edge> edges;
  std::vector<EdgeUse> uses;  ///< of one edge in a row
  std::vector<Vertex> vertices;
  std::vector<Corner> corners;  ///< of one vertex in a row
  std::vector<int> sheets;      ///< of (face, side): 2 * face, 2 * face + 1 for side -
  int sheet_count = 0;
  double edge_angle = kEdgeAngle;  ///< [rad]
  double size = 0.0;               ///< diagonal of the box around the wall [length]
  Vector3 low, high;               ///< that box
  double slack = 0.0;              ///< how far borders of two faces may be apart [length]

  int sheet(int face, int side) const { return sheets[2 * face + (side < 0)]; }
  const EdgeUse& next_use(const Edge& edge, int use) const {
    return uses[use + 1 < edge.first_use + edge.use_count ? use + 1 : edge.first_use];
  }
};

}  // namespace brep
