// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a wall are near a point, and all its feet on them: the local minima of its distance from
// every sheet (README.md).
#pragma once

#include <vector>

#include "brep/chart.h"
#include "brep/edge_sides.h"
#include "brep/foot.h"
#include "brep/piece_tree.h"
#include "brep/plane_triangles.h"
#include "brep/smooth_neighbours.h"
#include "brep/surface.h"
#include "nurbs/processor.h"

namespace brep {

class Minima;

class FootSearch {
 public:
  /// Keeps a reference to `surface`, which must outlive it and stay as it is.
  explicit FootSearch(const Surface& surface);
  FootSearch(const Surface&& surface) = delete;

  const Surface& surface() const { return surface_; }

  /// Appends the numbers of the pieces not farther than `reach` [length] from d, rising.
  void near(const Vector3& d, double reach, std::vector<int>& pieces) const;
  /// Those of these pieces that are not farther than `reach`: enough for points within `reach` - `reach of
  /// feet()` of d.  Returns their number; `active` has room for `count`, and may be `pieces`.
  int activate(const Vector3& d, double reach, const int* pieces, int count, int* active) const;
  /// The same, but without those that have no foot of any point less than `margin` away from d which reaches
  /// `reach` - `margin`: of trimmed walls, whose pieces overlap what others have, that is most. feet_behind()
  /// asks for them all.
  int activate_with_feet(const Vector3& d, double reach, double margin, const int* pieces, int count,
                         int* active) const;
  /// Distance of d from the nearest of these pieces, at least; `reach` if that is less.
  double nearest(const Vector3& d, double reach, const int* pieces, int count) const;
  /// Has the processor fetch what feet() looks at first of these pieces, while others are looked at: worth it
  /// for walls that do not stay in its cache.
  void prefetch(const int* pieces, int count) const;
  bool outgrows_cache() const { return surface_.pieces.size() > kInCache; }
  /// Appends the feet of d nearer than `reach`, given all pieces that are (more do no harm).
  void feet(const Vector3& d, double reach, const int* pieces, int count, std::vector<Foot>& out) const;
  /// Appends those of a d inside a body on its skin as that is seen from inside.  Each has the outward side
  /// and its sheet, and a distance less than 0.
  void feet_behind(const Vector3& d, double reach, const int* pieces, int count,
                   std::vector<Foot>& out) const;
  /// Whether bodies have an inside here (Face::outward).
  bool has_inside() const { return has_inside_; }

  /// Whether d is over these pieces, of one face, so far from its borders that they are not within `reach`,
  /// and it stays over them while it moves by less than `margin`.  If no other piece is within reach either,
  /// d has one foot at most, as long as it moves by less than that.
  bool is_well_inside(const int* pieces, int count, const Vector3& d, double reach, double margin) const;
  /// Whether a point that is well inside the face of `piece` has no other feet on the wall moved by `shift`,
  /// of which these pieces, in the wall's frame, are all that are within reach.
  bool is_repeated(int piece, const Vector3& shift, const int* pieces, int count) const;
  /// feet() and, behind them, those nearer than `reach` + `room` that room_of_feet() can be asked for; how
  /// far d may move, by `room` at most, until others come nearer than `reach` or give way where they do not
  /// now. Given all pieces within `reach` + `room` [length].
  double feet_for_a_while(const Vector3& d, double reach, double room, const int* pieces, int count,
                          std::vector<Foot>& out) const;
  /// How far d may move, by that at most, until one of its feet within `reach` begins or ends, if it has
  /// these alone and all are inside plane faces or on their edges, or inside trimmed ones in closed form; 0
  /// where that is not known [length].  below[k] becomes the piece that foot k is on, or its edge.
  double room_of_feet(const Vector3& d, double reach, double room, const int* pieces, int count,
                      const std::vector<Foot>& feet, int* below) const;
  /// That foot on a plane face: given any of these pieces, where its triangle says that d is.
  const PlaneTriangle& triangle(int piece) const { return triangles_[piece]; }
  /// The same on a curved one that has a chart, if it is nearer than `reach`: sets its parameters on the
  /// patch, point, distance and patch.  The result is the side of the face that looks to d; 0: there is none
  /// for certain, ask feet().
  int foot_inside_curved(int piece, const Vector3& d, double reach, const std::vector<Chart>* charts,
                         search::Foot& foot) const;
  /// The same on a face that is a patch, from where it was last; inside the face if its status is interior.
  search::Foot foot_on_patch(int face, const Vector3& d, const Parameter<2>& last) const;

  /// Distance below which two points of a wall are the same [length].
  double same_point() const { return same_point_; }
  /// How far borders of trimmed faces may be from their edges, at most [length].
  double border_slack() const { return border_slack_; }

 private:
  void prefetch(int piece) const {
    nurbs::prefetch(triangles_[piece]);
    nurbs::prefetch(surface_.pieces[piece]);
  }
  void prefetch_triangles(const int* pieces, int count) const {
    for (int k = 0; k < count; ++k) nurbs::prefetch(triangles_[pieces[k]]);
  }
  double least_distance(int piece, const Vector3& d) const;
  double least_distance(int piece, const Vector3& d, const PieceTree::Query& query, double reach) const;
  void add_feet(Minima& minima, const Vector3& d, double reach, const int* pieces, int count) const;
  bool is_well_inside_patch(const int* pieces, int count, const Vector3& d, double reach) const;
  bool is_well_inside_curved(const Piece& piece, const Vector3& d, double reach, double margin) const;
  struct Border {
    int piece;
    EdgeSides::Sides sides;  // of an edge
  };
  bool may_come_over(const Border& border, int face) const;
  bool may_have_foot(const Piece& piece, const Vector3& d, double reach, double margin,
                     const std::vector<Border>& borders) const;
  int without_patches(const Vector3& d, double reach, int* pieces, int count,
                      const std::vector<Border>& borders) const;
  bool has_no_foot_to_come(const int* elements, int count, const Vector3& d, double reach) const;
  bool is_calm_patch(const int* pieces, int count, const Vector3& d, double reach) const;
  const std::vector<int>& elements_of_patch(const int* pieces, int count) const;
  bool may_last(const Foot& foot) const;
  double room_on_triangles(const Vector3& d, double reach, double room, const int* pieces, int count,
                           const std::vector<Foot>& feet, int* below) const;
  double room_on_trimmed(const Vector3& d, double reach, const int* pieces, int count,
                         const std::vector<Foot>& feet, int* below) const;
  double room_beside_edge(const Piece& piece, const Vector3& d, double reach) const;

  static constexpr size_t kInCache = 500;  // pieces

  const Surface& surface_;
  PieceTree tree_;
  std::vector<PlaneTriangle> triangles_;
  SmoothNeighbours neighbours_;
  double same_point_;
  double border_slack_;  // how far borders of trimmed faces may be from their edges
  bool has_inside_;
  mutable EdgeSides edge_sides_;  // finds out about an edge when something is near it
};

}  // namespace brep
