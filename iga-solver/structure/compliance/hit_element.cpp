// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/hit_element.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace structure {

namespace {

/// Directions of a patch along one of its faces.
std::array<int, 2> along(nurbs::Face face) {
  const int d = static_cast<int>(face) / 2;
  return {d == 0 ? 1 : 0, d == 2 ? 1 : 2};
}

}  // namespace

BodyElement element_behind(const ReferenceBody& body, const SkinPiece& piece, int element) {
  const nurbs::Space<3>& space = body.patches[piece.patch].space;
  const int face = static_cast<int>(piece.face), d = face / 2;
  const std::array<int, 2> directions = along(piece.face);
  const int count = space.knots(directions[0]).element_count();
  nurbs::Indices<3> at{};
  at[d] = face % 2 == 0 ? 0 : space.knots(d).element_count() - 1;
  at[directions[0]] = element % count, at[directions[1]] = element / count;
  return {piece.patch, space.element_index(at)};
}

int element_on(const ReferenceBody& body, const SkinPiece& piece, int volume_element) {
  const nurbs::Space<3>& space = body.patches[piece.patch].space;
  const int face = static_cast<int>(piece.face), d = face / 2;
  const std::array<int, 2> directions = along(piece.face);
  const nurbs::Indices<3> at = space.element_indices(volume_element);
  if (at[d] != (face % 2 == 0 ? 0 : space.knots(d).element_count() - 1)) return -1;
  return at[directions[0]] + space.knots(directions[0]).element_count() * at[directions[1]];
}

// Near a free edge the half-space's traction on the other face is without limit, near a wall that stands on
// the skin its displacement.
HitElement::HitElement(const ReferenceBody& body, const NearElements& near, const SkinPiece& piece,
                       const FaceSurface& surface, int element)
    : surface_(surface), element_(element), volume_(element_behind(body, piece, element)) {
  constexpr double kNearest = 0.25;
  const nurbs::Indices<2> span = surface.space().element_indices(element);
  for (int k = 0; k < 2; ++k) {
    const std::vector<double>& breaks = surface.space().knots(k).breaks();
    lowest_[k] = low_[k] = breaks[span[k]];
    highest_[k] = high_[k] = breaks[span[k] + 1];
  }
  for (int k = 0; k < 2; ++k) {
    const double margin = kNearest * (high_[k] - low_[k]);
    if (is_edge(near, piece, k, 0)) lowest_[k] += margin;
    if (is_edge(near, piece, k, 1)) highest_[k] -= margin;
  }
}

bool HitElement::is_edge(const NearElements& near, const SkinPiece& piece, int direction, int side) const {
  constexpr double kSteep = 0.5;
  const nurbs::KnotVector& knots = surface_.space().knots(direction);
  const int span = surface_.space().element_indices(element_)[direction];
  const auto beyond = static_cast<nurbs::Face>(2 * along(piece.face)[direction] + side);
  if (span == (side == 0 ? 0 : knots.element_count() - 1) && near.is_free(piece.patch, beyond)) return true;
  nurbs::Parameter<2> ends[] = {low_, high_}, middle = surface_.space().element_centre(element_);
  middle[direction] = ends[0][direction] = ends[1][direction] =
      side == 0 ? low_[direction] : high_[direction];
  const std::vector<Vector3> corners = {surface_.at(element_, ends[0]).point,
                                        surface_.at(element_, ends[1]).point};
  const SkinPoint foot = surface_.at(element_, middle);
  const std::vector<BodyElement> neighbours = near.neighbours(volume_);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const BodyElement& neighbour) {
    return near.rise(neighbour, foot.point, foot.outward_normal) > kSteep &&
           near.has_corners(neighbour, corners);
  });
}

double HitElement::room(const nurbs::Parameter<2>& xi) const {
  const nurbs::Parameter<2> foot = inside(xi);
  const Vector3 point = surface_.at(element_, foot).point;
  double room = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k)
    for (const double end : {low_[k], high_[k]}) {
      if (end == (end == low_[k] ? lowest_[k] : highest_[k])) continue;
      nurbs::Parameter<2> at = foot;
      at[k] = end;
      room = std::min(room, (surface_.at(element_, at).point - point).norm());
    }
  return room;
}

nurbs::Parameter<2> HitElement::inside(nurbs::Parameter<2> xi) const {
  for (int k = 0; k < 2; ++k) xi[k] = std::clamp(xi[k], lowest_[k], highest_[k]);
  return xi;
}

}  // namespace structure
