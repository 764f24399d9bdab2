// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid wall of faces, edges and vertices, without its search (foot_search.h).  Every face has two sides, +
// where its normal points to and -.  Round an edge there are as many wedges of space as faces (one face: one
// wedge of 2 pi); sides on both ends of a convex or smooth wedge belong to one sheet (README.md).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "brep/face.h"
#include "brep/patch_faces.h"
#include "brep/trim_domain.h"

namespace brep {

/// What a wedge of space between two faces is: by its angle, which is above pi + edge_angle, nearly pi, or
/// below pi - edge_angle.  Of smooth ones those below pi are marked.
enum class Wedge : std::int8_t { convex, smooth, smooth_concave, concave };
inline bool joins(Wedge wedge) { return wedge != Wedge::concave; }

/// A face that meets in an edge, and the wedge that begins at it, counterclockwise.
struct alignas(32) EdgeUse {
  double conormal[2];     ///< into the face, in the plane across the edge (Edge::across)
  int face, edge;         ///< their numbers
  std::int8_t side;       ///< +1 or -1: the side of the face that looks into the wedge
  Wedge wedge;            ///< up to the next use of the edge
  bool wide;              ///< the wedge's angle is pi or more
  std::int8_t along = 0;  ///< +1 or -1: whether the edge runs along a loop of the face, or against it
};

/// A straight line, a circle or an arc of one, or a spline.
struct alignas(64) Edge {
  Vector3 origin;  ///< start of a line, centre of a circle
  Vector3 axis;    ///< direction of a line from start to end, axis of a circle
  Vector3 radial;  ///< across a line: conormal of its first use; from a circle's centre to its start
  double length;   ///< of a line [length]; angle of an arc about its axis, 2 pi if closed [rad]
  double R = 0.0;  ///< radius; 0: a line [length]
  int vertex[2];   ///< start and end; -1: closed
  int first_use = 0, use_count = 0;       ///< of Surface::uses, by their angle
  int first_chunk = -1, chunk_count = 0;  ///< of a spline, of Surface::chunks
  bool varies = false;                    ///< its uses hold half way; elsewhere local_uses() (edge_uses.h) do

  bool line() const { return R == 0.0 && first_chunk < 0; }
  bool spline() const { return first_chunk >= 0; }
  bool closed() const { return vertex[0] < 0; }
  /// Length along a line, angle along an arc; not of a spline.
  Vector3 point(double t) const;
  Vector3 tangent(double t) const;
};

/// A part of a spline edge, which turns by little.
struct Chunk {
  BezierCurve<3> curve;
  Vector3 way_on;  ///< tangent of what follows, where there is a kink too; zero at the edge's end
  Vector3 centre;
  double radius;  ///< of a ball around it [length]
  double bulge;   ///< its points are not farther from the straight line between its ends [length]
  struct End {
    Vector3 point, first;  ///< and its derivative by the curve's s
  };
  End ends[2];

  /// Of d from the straight line between the ends [length].
  double distance_of_chord(const Vector3& d) const {
    const Vector3 way = ends[1].point - ends[0].point, from = d - ends[0].point;
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp(from.dot(way) / length2, 0.0, 1.0) : 0.0;
    return (from - t * way).norm();
  }
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
struct alignas(32) Vertex {
  Vector3 point;
  int first_corner = 0, corner_count = 0;  ///< none: in the middle of a plane face
};

/// What searches look at.  Of a trimmed face, its edges and vertices are pieces of their own.
struct alignas(32) Piece {
  enum class Kind : std::int8_t {
    triangle,   ///< of a plane face, counterclockwise about its normal
    rectangle,  ///< a face whose border is that of its parameters' range (Borders)
    trimmed,    ///< a face with a domain
    element,    ///< of a face that is a patch
    edge,       ///< or a chunk of one
    vertex
  };
  int face;       ///< of an edge or a vertex: one of theirs
  int vertex[3];  ///< of a triangle; the first, of a vertex
  int edge[3];    ///< of a triangle: use of the edge from vertex[i] to vertex[i + 1], -1: inside the face
  Kind kind = Kind::triangle;
  bool triangle() const { return kind == Kind::triangle; }
  bool rectangle() const { return kind == Kind::rectangle; }
  int borders() const { return edge[0]; }  ///< of a rectangle
  int element() const { return edge[0]; }  ///< of the face's patch
  int chunk() const { return edge[1]; }    ///< of the edge edge[0]; -1: the whole
};

/// Of a piece that is a rectangle, number borders() of Surface::borders.  Its sides are
/// counterclockwise: xi1 = low, xi0 = high, xi1 = high, xi0 = low; corner i is where side i begins.
struct Borders {
  int use[4] = {-1, -1, -1, -1};     ///< -1: a seam or a pole
  int vertex[4] = {-1, -1, -1, -1};  ///< -1: none; the tip of a whole cone is the first
};

constexpr double kEdgeAngle = 0.02;  ///< of edges that count as smooth, if nothing else is said [rad]

/// A side of a patch's parameters that is one point in space, or a part of one.
struct Pole {
  int face;
  Parameter<2> from, to;
  Vector3 point;
};

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

  // Of trimmed faces; nothing if there are none.
  std::vector<TrimDomain> domains;               ///< of every face
  std::shared_ptr<const PatchFaces> patches;     ///< of faces of kind nurbs
  std::vector<Pole> poles;                       ///< of patches
  std::vector<Chunk> chunks;                     ///< of one edge in a row
  std::vector<double> edge_slack, vertex_slack;  ///< in place of `slack`, not less [length]
  static constexpr int kGuides = 17;
  /// Of every use: parameters on its face where that is a patch, at as many places along the edge.
  std::vector<std::array<Parameter<2>, kGuides>> guides;

  int sheet(int face, int side) const { return sheets[2 * face + (side < 0)]; }
  bool trimmed() const { return !domains.empty(); }
  double slack_of_edge(int edge) const { return edge_slack.empty() ? slack : edge_slack[edge]; }
  double slack_of_vertex(int vertex) const { return vertex_slack.empty() ? slack : vertex_slack[vertex]; }
  const EdgeUse& next_use(const Edge& edge, int use) const {
    return uses[use + 1 < edge.first_use + edge.use_count ? use + 1 : edge.first_use];
  }
};

}  // namespace brep
