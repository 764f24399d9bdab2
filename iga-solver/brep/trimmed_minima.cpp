// SPDX-License-Identifier: GPL-2.0-or-later
// Feet on pieces of trimmed faces: their surfaces, edges, vertices.
#include <Eigen/Geometry>

#include "brep/edge_foot.h"
#include "brep/minima.h"

namespace brep {

void Minima::add_of_other(const Piece& piece) {
  switch (piece.kind) {
    case Piece::Kind::triangle:
      return;
    case Piece::Kind::rectangle:
      return add_of_rectangle(piece);
    case Piece::Kind::trimmed:
      return add_of_trimmed(piece.face);
    case Piece::Kind::element:
      if (!elements().empty() && surface_.pieces[elements().front()].face != piece.face) add_of_elements();
      elements().push_back(static_cast<int>(&piece - surface_.pieces.data()));
      return;
    case Piece::Kind::edge:
      return piece.chunk() < 0 ? add_of_edge(piece.edge[0], kAll) : add_of_chunk(piece);
    case Piece::Kind::vertex:
      return add_of_vertex(piece.vertex[0], kAll);
  }
}

void Minima::add_of_trimmed(int number) {
  const Face& face = surface_.faces[number];
  if (face.distance_of_whole(d_) >= reach_) return;
  const Projection foot = face.project(d_);
  if (!surface_.domains[number].inside(foot.xi)) return;
  const int side = foot.height < 0.0 ? -1 : 1;
  keep({{foot.xi, foot.point, std::abs(foot.height), FootStatus::interior, 0, number},
        surface_.sheet(number, side),
        side,
        number});
}

// Of one patch; on its border edges have their say.
void Minima::add_of_elements() {
  thread_local std::vector<int> of_patch;
  thread_local std::vector<search::Foot> feet;
  of_patch.clear();
  const int face = surface_.pieces[elements().front()].face, patch = surface_.faces[face].patch;
  for (const int piece : elements())
    if (surface_.patches->may_have_foot(patch, surface_.pieces[piece].element(), d_, reach_, met_side(face)))
      of_patch.push_back(surface_.pieces[piece].element());
  elements().clear();
  if (of_patch.empty()) return;
  surface_.patches->minima_on(patch, of_patch, d_, reach_, feet);
  for (const search::Foot& foot : feet)
    if (!surface_.patches->on_border(patch, foot.xi) && surface_.domains[face].inside(foot.xi) &&
        (foot.status == FootStatus::interior || is_lowest_beside(face, foot.xi, foot.distance)))
      add_on_patch(face, foot);
}

// Whether no point of a patch beside this one is nearer: where d is on the axis of a round one, or square
// above a border beyond the centre, derivatives do not tell.
bool Minima::is_lowest_beside(int face, const Parameter<2>& xi, double distance) const {
  constexpr double kBeside = 1e-3, kNearer = 1.0 - 1e-9;
  const int patch = surface_.faces[face].patch;
  const nurbs::Space<2>& space = surface_.patches->patch(patch).space;
  const nurbs::Indices<2> e = space.element_indices(space.element_at(xi));
  double step[2];
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& breaks = space.knots(i).breaks();
    step[i] = kBeside * (breaks[e[i] + 1] - breaks[e[i]]);
  }
  for (int way = 0; way < 9; ++way) {
    const int along[2] = {way % 3 - 1, way / 3 - 1};
    const Parameter<2> beside{xi[0] + along[0] * step[0], xi[1] + along[1] * step[1]};
    if (way != 4 && surface_.domains[face].inside(beside) &&
        (surface_.patches->point(patch, beside) - d_).norm() < kNearer * distance)
      return false;
  }
  return true;
}

void Minima::add_on_patch(int face, const search::Foot& foot) {
  const Vector3 normal = surface_.patches->normal(surface_.faces[face].patch, foot.xi);
  const int side = normal.dot(d_ - foot.point) < 0.0 ? -1 : 1;
  Foot on_face{foot, surface_.sheet(face, side), side, face};
  on_face.patch = face;
  keep(on_face);
}

void Minima::add_of_chunk(const Piece& piece) {
  const Edge& edge = surface_.edges[piece.edge[0]];
  const Chunk& chunk = surface_.chunks[edge.first_chunk + piece.chunk()];
  const double away = reach_ + chunk.radius, slack = surface_.slack_of_edge(piece.edge[0]);
  double s;
  if ((d_ - chunk.centre).squaredNorm() >= away * away || !minimum_on(chunk, d_, slack, s)) return;
  const auto on = chunk.curve.derivatives(s);
  const Vector3 from = d_ - on.point;
  if (from.squaredNorm() >= reach_ * reach_) return;
  const double begin = surface_.chunks[edge.first_chunk].curve.begin,
               end = surface_.chunks[edge.first_chunk + edge.chunk_count - 1].curve.end;
  const double t = chunk.curve.begin + s * (chunk.curve.end - chunk.curve.begin);
  const EdgePoint at{on.point, on.first.normalized(), (t - begin) / (end - begin)};
  const Across axes = across(at.tangent);
  const double q[2] = {from.dot(axes.u), from.dot(axes.v)};
  add_in_wedge(local_uses(surface_, edge, at, axes), kAll, {at, q, slack});
}

}  // namespace brep
