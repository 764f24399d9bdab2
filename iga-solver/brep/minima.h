// SPDX-License-Identifier: GPL-2.0-or-later
// All feet of one point, piece by piece: the rules of the README.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "brep/edge_uses.h"
#include "brep/foot.h"
#include "brep/plane_triangles.h"
#include "brep/smooth_neighbours.h"
#include "brep/surface.h"
#include "nurbs/processor.h"

namespace brep {

/// Points of a wall are the same if they are not farther apart than this many times the slack.
constexpr double kSamePoint = 10.0;

class Minima {
 public:
  /// Which sides of faces that have an outward one are met: that one, or that which is inside of the body.
  enum class Of { outside = 1, inside = -1 };
  /// Appends feet of d that are nearer than `reach` to `out`.
  Minima(const Surface& surface, double same_point, const Vector3& d, double reach, std::vector<Foot>& out,
         Of of = Of::outside)
      : surface_(surface),
        d_(d),
        reach_(reach),
        slack_(surface.slack),
        same_point2_(same_point * same_point),
        out_(out),
        begin_(out.size()),
        of_(static_cast<int>(of)) {}

  static constexpr int kTogether = 32;
  /// Of no more than kTogether pieces.  What is looked at of triangles that d is beside is fetched while it
  /// is seen where d is from the others.
  void add_of_pieces(const int* pieces, int count, const std::vector<PlaneTriangle>& triangles) {
    OverTriangle at[kTogether];
    for (int k = 0; k < count; ++k)
      if (const PlaneTriangle& triangle = triangles[pieces[k]]; triangle.exists()) {
        at[k] = triangle.place(d_, reach_, slack_);
        if (at[k].where == OverTriangle::Where::beside) prefetch_beside(surface_.pieces[pieces[k]]);
      }
    for (int k = 0; k < count; ++k) add_of_piece(pieces[k], triangles[pieces[k]], at[k]);
  }
  /// After all pieces; feet that have given way to others are there still.
  void finish() {
    if (!elements().empty()) add_of_elements();
  }
  /// How far d may move until leave_nearest() chooses others, as far as these feet tell [length].
  double room_to_choose(const SmoothNeighbours& neighbours);
  /// Leaves one foot of several at one point, and of those that slightly concave smooth edges join the
  /// nearest. Feet are by distance then.
  void leave_nearest(const SmoothNeighbours& neighbours) {
    if (out_.size() > begin_ + 1) choose(neighbours);
  }

 private:
  // Where d is beside a side of a triangle whose plane across it d is beyond.
  struct BesideSide {
    double along, length2;  // of the side's length, times that
    double distance2 = std::numeric_limits<double>::infinity();
  };
  void keep_over(int face, const OverTriangle& at) {
    const int side = at.height < 0.0 ? -1 : 1;
    keep({{at.xi, d_ - at.height * at.normal, std::abs(at.height), FootStatus::interior, 0, face},
          surface_.sheet(face, side),
          side,
          face});
  }
  void add_of_piece(int piece, const PlaneTriangle& triangle, const OverTriangle& at) {
    if (!triangle.exists())
      add_of_other(surface_.pieces[piece]);
    else if (at.where == OverTriangle::Where::over)
      keep_over(triangle.face(), at);
    else if (at.where == OverTriangle::Where::beside)
      add_beside_triangle(surface_.pieces[piece], at.normal);
  }
  void prefetch_beside(const Piece& piece) const {
    for (int i = 0; i < 3; ++i) {
      nurbs::prefetch(surface_.vertices[piece.vertex[i]]);
      if (piece.edge[i] >= 0) nurbs::prefetch(surface_.uses[piece.edge[i]]);
    }
  }
  void add_beside_triangle(const Piece& piece, const Vector3& normal);
  void add_of_side(const Piece& piece, int i, const BesideSide& beside);
  void add_of_other(const Piece& piece);
  void add_of_rectangle(const Piece& piece);
  void add_of_trimmed(int face);
  void add_of_elements();
  void add_on_patch(int face, const search::Foot& foot);
  void add_of_chunk(const Piece& piece);
  // Of an edge as seen from a face that meets it by this use, or from all; of a vertex from one face, or all.
  static constexpr int kAll = -1;
  void add_of_edge(int edge, int visiting);
  bool is_lowest_beside(int face, const Parameter<2>& xi, double distance) const;
  struct OnEdge {
    const EdgePoint& at;
    const double* q;
    double slack;
  };
  bool is_nearest_of_whole(const EdgeUse& use, int number, const OnEdge& on) const;
  bool is_off(const EdgeUse& use, int number, const OnEdge& on) const;
  bool has_foot_beside(const EdgeUse& use, int number, const OnEdge& on) const;
  void add_in_wedge(const Uses& uses, int visiting, const OnEdge& on);
  void add_square_above(const Uses& uses, const OnEdge& on);
  void add_of_vertex(int vertex, int face);
  bool is_off_ray(int ray, const Vector3& w) const;
  bool in_group(const Vertex& vertex, int group, const Vector3& w) const;
  // Of the space round a vertex.  On a border of two regions, to within the slack, it is one of them, and
  // `inward` leads from w to where that is clear; else that is zero.
  struct Region {
    int number = 0;
    Vector3 inward = Vector3::Zero();
  };
  Region region_of(const Vertex& vertex, const Vector3& w) const;
  const Region& known_region_of(int vertex, const Vector3& w);
  // `use`: one by which the face meets the point, for the search on a patch; -1: none.
  void add_of_corner(const Corner& corner, int side, int vertex);
  void add(int face, int side, FootStatus status, int entity, const EdgePoint& at, int use);
  void keep(const Foot& foot) {
    if (met_side(foot.patch) == -foot.side) return;
    for (size_t k = begin_; k < out_.size(); ++k)
      if (out_[k].status == foot.status && out_[k].entity == foot.entity && out_[k].sheet == foot.sheet &&
          (out_[k].point - foot.point).squaredNorm() <= same_point2_)
        return;
    out_.push_back(foot);
  }
  // +1, -1; 0: both.
  int met_side(int face) const { return of_ * surface_.faces[face].outward; }
  void widen(double slack) { same_point2_ = std::max(same_point2_, kSamePoint * kSamePoint * slack * slack); }
  // Pieces of patches, of which all are searched together.
  static std::vector<int>& elements() {
    thread_local std::vector<int> pieces;
    return pieces;
  }
  void choose(const SmoothNeighbours& neighbours);
  void sort_by_distance();
  double angle_between(const Foot& foot, const Foot& other) const;
  double turn(const Foot& foot) const;
  bool repeats(const Foot& foot, const Foot& other) const;
  bool gives_way(const Foot& foot, const Foot& nearer, const SmoothNeighbours& neighbours) const;

  const Surface& surface_;
  Vector3 d_;
  double reach_, slack_, same_point2_;
  double corner_slack_ = 0.0;  // of the vertex that is looked at
  // Each face round a vertex asks for d's: those of the last vertices.
  static constexpr int kRegions = 4;
  struct KnownRegion {
    int vertex;
    Region region;
  };
  KnownRegion regions_[kRegions] = {};
  int region_count_ = 0;
  std::vector<Foot>& out_;
  size_t begin_;  // of this point's feet
  int of_;
};

}  // namespace brep
