// SPDX-License-Identifier: GPL-2.0-or-later
// How faces meet round an edge, at one point of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "brep/sides.h"
#include "brep/surface.h"

namespace brep {

/// Axes of the plane across an edge, at one point of it.
struct Across {
  Vector3 u, v;
};
/// Of a line or a circle: those of EdgeFoot::q.
Across across(const Edge& edge, const Vector3& point);
/// Of a spline with this tangent there.
Across across(const Vector3& tangent);

/// A face that meets there, with its angle round the edge; of its use the wedge is not known yet.
struct Meeting {
  EdgeUse use;
  double angle;  ///< [rad]
};
Meeting meeting(const Side& side, const Across& across, int face, int edge);

/// What a wedge of this angle [rad] is.
Wedge wedge_of(double angle, double edge_angle);

/// Meetings by their angle, with the wedges between them; of those at one angle the first stays the first.
template <class Meetings>
void sort_round(Meetings& met, double edge_angle) {
  std::stable_sort(met.begin(), met.end(),
                   [](const Meeting& a, const Meeting& b) { return a.angle < b.angle; });
  for (size_t k = 0; k < met.size(); ++k) {
    const double next = k + 1 < met.size() ? met[k + 1].angle : met[0].angle + nurbs::kTwoPi;
    met[k].use.wedge = wedge_of(next - met[k].angle, edge_angle);
    met[k].use.wide = next - met[k].angle >= nurbs::kPi;
  }
}

/// Uses of one edge, counterclockwise.
struct Uses {
  const EdgeUse* first;
  int count;
  const int* numbers;  ///< of Surface::uses; null: one after the other from first_number
  int first_number;
  int number(const EdgeUse& use) const {
    const auto k = static_cast<int>(&use - first);
    return numbers != nullptr ? numbers[k] : first_number + k;
  }
  const EdgeUse& with_number(int wanted) const {
    const EdgeUse* use = first;
    while (number(*use) != wanted) ++use;
    return *use;
  }
  const EdgeUse& next(const EdgeUse& use) const { return &use + 1 < first + count ? *(&use + 1) : *first; }
  const EdgeUse& before(const EdgeUse& use) const { return *((&use > first ? &use : first + count) - 1); }
  const EdgeUse* begin() const { return first; }
  const EdgeUse* end() const { return first + count; }
};
inline Uses uses_of(const Surface& surface, const Edge& edge) {
  return {surface.uses.data() + edge.first_use, edge.use_count, nullptr, edge.first_use};
}

/// A point of any edge.
struct EdgePoint {
  Vector3 point, tangent;
  double part;  ///< how much of the edge's range of parameters is before it, 0 to 1
};
EdgePoint at_end(const Surface& surface, const Edge& edge, int end);
EdgePoint at_part(const Surface& surface, const Edge& edge, double part);

/// Parameters of a point of an edge on the face of a use, which is a patch.
Parameter<2> parameters_at(const Surface& surface, int use, const EdgePoint& at);
/// Normal of a use's face at a point of its edge.
Vector3 normal_at(const Surface& surface, int use, const EdgePoint& at);
/// How that face meets the edge there.
Side side_at(const Surface& surface, int use, const EdgePoint& at);

/// Uses of an edge of trimmed faces as they are at one point of it; their order may be another one there.
/// Valid until the next call of the same thread.
Uses local_uses(const Surface& surface, const Edge& edge, const EdgePoint& at, const Across& across);

/// At an end of any edge: its uses, and the axes that they refer to.
struct UsesAtEnd {
  Uses uses;
  Across across;
};
UsesAtEnd uses_at_end(const Surface& surface, const Edge& edge, int end);

}  // namespace brep
