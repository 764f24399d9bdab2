// SPDX-License-Identifier: GPL-2.0-or-later
// Across a smooth edge that is slightly concave there can be two feet, nearly the same: the nearer alone
// counts.
#include <algorithm>
#include <cmath>

#include "brep/minima.h"

namespace brep {
namespace {

void faces_at(const Surface& surface, const Foot& foot, std::vector<int>& faces) {
  faces.assign(1, foot.patch);
  if (foot.status == FootStatus::edge) {
    const Edge& edge = surface.edges[foot.entity];
    for (int k = 0; k < edge.use_count; ++k) faces.push_back(surface.uses[edge.first_use + k].face);
  }
  if (foot.status == FootStatus::corner) {
    const Vertex& vertex = surface.vertices[foot.entity];
    for (int k = 0; k < vertex.corner_count; ++k)
      faces.push_back(surface.corners[vertex.first_corner + k].face);
  }
}

}  // namespace

bool Minima::gives_way(const Foot& foot, const Foot& nearer, const SmoothNeighbours& neighbours) const {
  if (foot.sheet != nearer.sheet) return false;
  const Vector3 a = d_ - foot.point, b = d_ - nearer.point;
  if (a.dot(b) < std::cos(surface_.edge_angle) * foot.distance * nearer.distance) return false;
  thread_local std::vector<int> from, to;
  faces_at(surface_, foot, from);
  faces_at(surface_, nearer, to);
  return neighbours.joined(from, to);
}

bool Minima::repeats(const Foot& foot, const Foot& other) const {
  return foot.sheet == other.sheet && (foot.point - other.point).squaredNorm() <= same_point2_;
}

// On borders to within round-off a point can have the feet of a face, of its edge and of a vertex; which of
// them may give way is not the same, so they are joined last.  The face's stays.
void Minima::choose(const SmoothNeighbours& neighbours) {
  const auto begin = out_.begin() + static_cast<std::ptrdiff_t>(begin_);
  std::sort(begin, out_.end(), [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
  auto end = begin;  // of those that stay; what has gone makes others go as well
  for (auto foot = begin; neighbours.any() && foot != out_.end(); ++foot) {
    bool gone = false;
    for (auto nearer = begin; nearer != foot && !gone; ++nearer)
      gone = !repeats(*foot, *nearer) && gives_way(*foot, *nearer, neighbours);
    if (!gone) std::iter_swap(end++, foot);
  }
  if (neighbours.any()) out_.erase(end, out_.end());
  end = begin;
  for (auto foot = begin; foot != out_.end(); ++foot) {
    const auto other = std::find_if(begin, end, [&](const Foot& kept) { return repeats(*foot, kept); });
    if (other == end)
      *end++ = *foot;
    else if (foot->status < other->status)
      *other = *foot;
  }
  out_.erase(end, out_.end());
}

}  // namespace brep
