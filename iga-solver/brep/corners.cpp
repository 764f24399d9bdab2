// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/assembly.h"
#include "brep/disjoint_sets.h"
#include "brep/edge_uses.h"
#include "brep/sides.h"

namespace brep {
namespace {

// The corners of a wall before they are sorted by vertices.
class Corners {
 public:
  Corners(Surface& surface, const std::vector<int>& mate)
      : surface_(surface), mate_(mate), of_side_(4 * surface.pieces.size(), -1) {}

  void make(const std::vector<LoopCorner>& of_loops) {
    const int pieces = static_cast<int>(surface_.pieces.size());
    for (int p = 0; p < pieces; ++p) {
      if (surface_.pieces[p].triangle())
        for (int i = 0; i < 3; ++i) triangle_corner(p, i);
      else
        face_corners(p);
    }
    for (const LoopCorner& at : of_loops) add(at.face, at.vertex, at.ray[0], at.ray[1], at.turned);
    sort_by_vertex();
    const int vertices = static_cast<int>(surface_.vertices.size());
    for (int v = 0; v < vertices; ++v) link(v);
    move_split_vertices();
  }

 private:
  struct Found {
    Corner corner;
    int vertex;
  };

  int use_at(int side) const {
    const Piece& piece = surface_.pieces[piece_of_side(side)];
    return piece.triangle() ? piece.edge[side % 4] : surface_.borders[piece.borders()].use[side % 4];
  }
  int ray(int use, int vertex) const {
    const Edge& edge = surface_.edges[surface_.uses[use].edge];
    return 2 * use + (edge.vertex[0] == vertex ? 0 : 1);
  }
  const Vector3& at(int piece, int i) const {
    return surface_.vertices[surface_.pieces[piece].vertex[i]].point;
  }
  double angle(int piece, int i) const {
    const Vector3 a = at(piece, (i + 1) % 3) - at(piece, i), b = at(piece, (i + 2) % 3) - at(piece, i);
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  // The fan of triangles of one plane face, counterclockwise from the edge that leaves corner i of a piece.
  void triangle_corner(int p, int i) {
    const int leaving = use_at(side_number(p, i));
    if (leaving < 0) return;
    const int vertex = surface_.pieces[p].vertex[i], corner = static_cast<int>(found_.size());
    double turned = 0.0;
    int side = side_number(p, i), arriving = -1;
    while (arriving < 0) {
      const int piece = piece_of_side(side), k = side % 4;
      of_side_[side] = corner;
      turned += angle(piece, k);
      const int before = side_number(piece, (k + 2) % 3);
      arriving = use_at(before);
      side = mate_[before];
    }
    add(surface_.pieces[p].face, vertex, ray(leaving, vertex), ray(arriving, vertex), turned);
  }

  void face_corners(int p) {
    const int face = surface_.pieces[p].face;
    const Borders& borders = surface_.borders[surface_.pieces[p].borders()];
    const Face& shape = surface_.faces[face];
    if (shape.whole_turn(0) || shape.whole_turn(1)) {
      if (borders.vertex[0] < 0) return;
      of_side_[side_number(p, 0)] = static_cast<int>(found_.size());
      add(face, borders.vertex[0], -1, -1, 0.0);
      return;
    }
    for (int i = 0; i < 4; ++i) {
      if (borders.use[i] < 0) continue;
      const int before = borders.use[(i + 3) % 4] >= 0 ? (i + 3) % 4 : (i + 2) % 4;
      const int vertex = borders.vertex[i];
      for (int k = (before + 1) % 4;; k = (k + 1) % 4) {
        of_side_[side_number(p, k)] = static_cast<int>(found_.size());
        if (k == i) break;
      }
      const double turned = before == (i + 3) % 4 ? 0.5 * nurbs::kPi : shape.high[0] - shape.low[0];
      add(face, vertex, ray(borders.use[i], vertex), ray(borders.use[before], vertex), turned);
    }
  }

  void add(int face, int vertex, int first, int second, double turned) {
    Corner corner{};
    corner.face = face;
    corner.ray[0] = first, corner.ray[1] = second;
    corner.reflex = turned >= nurbs::kPi - 1e-6;
    found_.push_back({corner, vertex});
  }

  void sort_by_vertex() {
    for (Vertex& vertex : surface_.vertices) vertex.corner_count = 0;
    for (const Found& found : found_) ++surface_.vertices[found.vertex].corner_count;
    int sum = 0;
    for (Vertex& vertex : surface_.vertices) {
      vertex.first_corner = sum;
      sum += vertex.corner_count;
      vertex.corner_count = 0;
    }
    surface_.corners.resize(found_.size());
    place_.resize(found_.size());
    for (size_t c = 0; c < found_.size(); ++c) {
      Vertex& vertex = surface_.vertices[found_[c].vertex];
      place_[c] = vertex.first_corner + vertex.corner_count++;
      surface_.corners[place_[c]] = found_[c].corner;
    }
    vertex_of_.resize(found_.size());
  }

  // Which corners of a vertex hang together, and in what way.
  void link(int v) {
    const Vertex vertex = surface_.vertices[v];
    const int count = vertex.corner_count;
    if (count == 0) return;
    Corner* corners = surface_.corners.data() + vertex.first_corner;
    rays_.clear();
    for (int c = 0; c < count; ++c)
      for (const int ray : corners[c].ray)
        if (ray >= 0) rays_.emplace_back(ray, c);
    std::sort(rays_.begin(), rays_.end());
    fans_.reset(count);
    groups_.reset(2 * count);
    regions_.reset(2 * count);
    for (const auto& [ray, c] : rays_) {
      const Edge& edge = surface_.edges[surface_.uses[ray / 2].edge];
      const Uses uses = edge.varies ? uses_at_end(surface_, edge, ray % 2).uses : uses_of(surface_, edge);
      const EdgeUse& use = uses.with_number(ray / 2);
      const EdgeUse& next = uses.next(use);
      const int next_ray = 2 * uses.number(next) + ray % 2;
      const auto found = std::lower_bound(rays_.begin(), rays_.end(), std::make_pair(next_ray, 0));
      const int to = found->second;
      fans_.join(c, to);
      regions_.join(2 * c + (use.side < 0), 2 * to + (next.side > 0));
      if (joins(use.wedge)) groups_.join(2 * c + (use.side < 0), 2 * to + (next.side > 0));
    }
    number(corners, count);
    split(v);
  }

  void number(Corner* corners, int count) {
    groups_.number(group_);
    regions_.number(region_);
    for (int n = 0; n < 2 * count; ++n) {
      Corner& corner = corners[n / 2];
      corner.group[n % 2] = static_cast<std::int16_t>(group_[n]);
      corner.region[n % 2] = static_cast<std::int16_t>(region_[n]);
      corner.leads[n % 2] = groups_.find(n) == n;
    }
  }

  // Corners of one fan in a row; every fan but the first has a new vertex.
  void split(int v) {
    const Vertex vertex = surface_.vertices[v];
    const int fans = fans_.number(fan_), first = vertex.first_corner;
    for (int c = 0; c < vertex.corner_count; ++c) vertex_of_[first + c] = v;
    if (fans == 1) return;
    const std::vector<Corner> corners(surface_.corners.begin() + first,
                                      surface_.corners.begin() + first + vertex.corner_count);
    moved_.resize(surface_.corners.size(), -1);
    int place = first;
    for (int fan = 0; fan < fans; ++fan) {
      const int number = fan == 0 ? v : static_cast<int>(surface_.vertices.size());
      if (fan > 0) surface_.vertices.push_back({vertex.point, 0, 0});
      const int begin = place;
      for (int c = 0; c < vertex.corner_count; ++c)
        if (fan_[c] == fan) {
          surface_.corners[place] = corners[c];
          moved_[first + c] = place;
          vertex_of_[place++] = number;
        }
      surface_.vertices[number].first_corner = begin;
      surface_.vertices[number].corner_count = place - begin;
    }
  }

  void move_split_vertices() {
    if (moved_.empty()) return;
    for (size_t side = 0; side < of_side_.size(); ++side) {
      if (of_side_[side] < 0) continue;
      int place = place_[of_side_[side]];
      if (moved_[place] >= 0) place = moved_[place];
      Piece& piece = surface_.pieces[side / 4];
      (piece.triangle() ? piece.vertex : surface_.borders[piece.borders()].vertex)[side % 4] =
          vertex_of_[place];
    }
    for (size_t c = 0; c < surface_.corners.size(); ++c)
      for (const int ray : surface_.corners[c].ray)
        if (ray >= 0) surface_.edges[surface_.uses[ray / 2].edge].vertex[ray % 2] = vertex_of_[c];
  }

  Surface& surface_;
  std::vector<int> mate_;
  std::vector<int> of_side_;  // the corner where a side begins
  std::vector<Found> found_;
  std::vector<int> place_;      // of a found corner among those of the surface
  std::vector<int> vertex_of_;  // of a corner of the surface
  std::vector<int> moved_;      // where a corner of the surface went when its vertex was split
  std::vector<std::pair<int, int>> rays_;
  DisjointSets fans_{0}, groups_{0}, regions_{0};
  std::vector<int> fan_, group_, region_;
};

}  // namespace

void make_corners(Surface& surface, const MatchedSides& matched) { Corners(surface, matched.mate).make({}); }

void make_corners(Surface& surface, const std::vector<LoopCorner>& of_loops) {
  Corners(surface, {}).make(of_loops);
}

}  // namespace brep
