// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/foot_search.h"

#include <algorithm>

#include "brep/edge_foot.h"
#include "brep/minima.h"
#include "brep/piece_distance.h"
#include "nurbs/processor.h"

namespace brep {

namespace {

double largest_border_slack(const Surface& surface) {
  double largest = surface.trimmed() ? surface.slack : 0.0;
  for (const double slack : surface.edge_slack) largest = std::max(largest, slack);
  return largest;
}

}  // namespace

constexpr int kFew = 3;                    // pieces, which are looked at without a filter
constexpr int kChunk = Minima::kTogether;  // pieces that are filtered together

FootSearch::FootSearch(const Surface& surface)
    : surface_(surface),
      tree_(surface),
      triangles_(plane_triangles(surface)),
      neighbours_(surface),
      same_point_(kSamePoint * surface.slack),
      border_slack_(largest_border_slack(surface)),
      has_inside_(std::any_of(surface.faces.begin(), surface.faces.end(),
                              [](const Face& face) { return face.outward != 0; })),
      edge_sides_(surface) {}

void FootSearch::near(const Vector3& d, double reach, std::vector<int>& pieces) const {
  const size_t begin = pieces.size();
  tree_.near(tree_.query(d, reach), pieces);
  prefetch_triangles(pieces.data() + begin, static_cast<int>(pieces.size() - begin));
  const auto far = [&](int p) { return least_distance(p, d) > reach; };
  pieces.erase(std::remove_if(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end(), far),
               pieces.end());
  std::sort(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end());
  if (surface_.trimmed())  // a piece can have several boxes
    pieces.erase(std::unique(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end()),
                 pieces.end());
}

int FootSearch::activate(const Vector3& d, double reach, const int* pieces, int count, int* active) const {
  const PieceTree::Query query = tree_.query(d, reach);
  const int maybe = tree_.filter(query, pieces, count, active);
  prefetch_triangles(active, maybe);
  const auto far = [&](int p) { return least_distance(p, d, query, reach) > reach; };
  return static_cast<int>(std::remove_if(active, active + maybe, far) - active);
}

// Of a piece from d, at least.
double FootSearch::least_distance(int piece, const Vector3& d) const {
  const PlaneTriangle& triangle = triangles_[piece];
  return triangle.exists() ? triangle.least_distance(d) : distance_of_piece(surface_, piece, d);
}

// Its parts, too; more than `reach` matters to nobody.
double FootSearch::least_distance(int piece, const Vector3& d, const PieceTree::Query& query,
                                  double reach) const {
  const double whole = least_distance(piece, d);
  return whole > reach ? whole : std::max(whole, tree_.distance_of_parts(query, piece));
}

double FootSearch::nearest(const Vector3& d, double reach, const int* pieces, int count) const {
  for (int k = 0; k < count; k += kChunk) {
    int kept[kChunk];
    const PieceTree::Query query = tree_.query(d, reach);
    const int maybe = tree_.filter(query, pieces + k, std::min(kChunk, count - k), kept);
    prefetch_triangles(kept, maybe);
    for (int i = 0; i < maybe; ++i) reach = std::min(reach, least_distance(kept[i], d, query, reach));
  }
  return reach;
}

void FootSearch::prefetch(const int* pieces, int count) const {
  if (count <= kFew)
    for (int k = 0; k < count; ++k) prefetch(pieces[k]);
  else
    tree_.prefetch(pieces, count);
}

void FootSearch::feet(const Vector3& d, double reach, const int* pieces, int count,
                      std::vector<Foot>& out) const {
  Minima minima(surface_, same_point_, d, reach, out);
  add_feet(minima, d, reach, pieces, count);
  minima.leave_nearest(neighbours_);
}

// What is two-sided is in front, wherever d is.
void FootSearch::feet_behind(const Vector3& d, double reach, const int* pieces, int count,
                             std::vector<Foot>& out) const {
  const auto begin = static_cast<std::ptrdiff_t>(out.size());
  Minima minima(surface_, same_point_, d, reach, out, Minima::Of::inside);
  add_feet(minima, d, reach, pieces, count);
  minima.leave_nearest(neighbours_);
  const auto is_two_sided = [&](const Foot& foot) { return surface_.faces[foot.patch].outward == 0; };
  out.erase(std::remove_if(out.begin() + begin, out.end(), is_two_sided), out.end());
  for (auto foot = out.begin() + begin; foot != out.end(); ++foot) {
    foot->side = surface_.faces[foot->patch].outward;
    foot->sheet = surface_.sheet(foot->patch, foot->side);
    foot->distance = -foot->distance;
  }
}

void FootSearch::add_feet(Minima& minima, const Vector3& d, double reach, const int* pieces,
                          int count) const {
  if (count <= kFew) {
    minima.add_of_pieces(pieces, count, triangles_);
  } else {
    const PieceTree::Query query = tree_.query(d, reach);
    for (int k = 0; k < count; k += kChunk) {
      int kept[kChunk];
      const int maybe = tree_.filter(query, pieces + k, std::min(kChunk, count - k), kept);
      for (int i = 0; i < maybe; ++i) prefetch(kept[i]);
      minima.add_of_pieces(kept, maybe, triangles_);
    }
  }
  minima.finish();
}

// The point of these pieces that is nearest to a foot beside them would be on a border.
bool FootSearch::is_well_inside(const int* pieces, int count, const Vector3& d, double reach,
                                double margin) const {
  const Piece& first = surface_.pieces[*pieces];
  if (first.kind == Piece::Kind::element) return is_well_inside_patch(pieces, count, d, reach);
  if (!first.triangle()) return count == 1 && is_well_inside_curved(first, d, reach, margin);
  const double height = triangles_[*pieces].over(d).height;
  for (const int* number = pieces; number < pieces + count; ++number) {
    const Piece& piece = surface_.pieces[*number];
    if (piece.face != first.face) return false;
    const double in = triangles_[*number].from_border(d, piece);
    if (in < margin || in * in + height * height <= reach * reach) return false;
  }
  return true;
}

// On the rim of the moved face there may be feet, but in the plane that touches the face at a nearer one.
bool FootSearch::is_repeated(int piece, const Vector3& shift, const int* pieces, int count) const {
  const int number = surface_.pieces[piece].face;
  const Face& face = surface_.faces[number];
  return std::all_of(pieces, pieces + count, [&](int p) { return surface_.pieces[p].face == number; }) &&
         face.stays(shift, same_point_);
}

bool FootSearch::is_well_inside_curved(const Piece& piece, const Vector3& d, double reach,
                                       double margin) const {
  if (piece.kind == Piece::Kind::trimmed) return surface_.faces[piece.face].distance_of_focus(d) > margin;
  if (!piece.rectangle()) return false;
  const Borders& borders = surface_.borders[piece.borders()];
  for (int i = 0; i < 4; ++i) {
    if (borders.use[i] >= 0 &&
        EdgeFoot(surface_.edges[surface_.uses[borders.use[i]].edge], d).distance2() <= reach * reach)
      return false;
    if (borders.vertex[i] >= 0 &&
        (surface_.vertices[borders.vertex[i]].point - d).squaredNorm() <= reach * reach)
      return false;
  }
  return true;
}

int FootSearch::foot_inside_curved(int piece, const Vector3& d, double reach,
                                   const std::vector<Chart>* charts, search::Foot& foot) const {
  if (!charts) return 0;
  foot.patch = surface_.pieces[piece].face;
  const PolarFoot at = surface_.faces[foot.patch].polar_foot(d);
  if (at.many || !(std::abs(at.height) < reach) || !(*charts)[foot.patch].place(at, foot.xi)) return 0;
  foot.point = at.point;
  foot.distance = std::abs(at.height);
  return at.height < 0.0 ? -1 : 1;
}

search::Foot FootSearch::foot_on_patch(int face, const Vector3& d, const Parameter<2>& last) const {
  return surface_.patches->projector(surface_.faces[face].patch).warm(d, last);
}

}  // namespace brep
