// SPDX-License-Identifier: GPL-2.0-or-later
// Across a smooth edge that is slightly concave there can be two feet, nearly the same: the nearer alone
// counts.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "brep/minima.h"

namespace brep {
namespace {

// The face beside this one on the sheet that its side belongs to at this edge; -1: the sheet ends there.
int face_beside(const Surface& surface, const Edge& edge, int face, int side) {
  const Uses uses = uses_of(surface, edge);
  for (const EdgeUse& use : uses) {
    if (use.face != face) continue;
    const EdgeUse& other = use.side == side ? uses.next(use) : uses.before(use);
    if (joins((use.side == side ? use : other).wedge)) return other.face;
  }
  return -1;
}

// Faces of its sheet that meet in a foot.
void faces_at(const Surface& surface, const Foot& foot, std::vector<int>& faces) {
  faces.assign(1, foot.patch);
  if (foot.status == FootStatus::edge) {
    const int beside = face_beside(surface, surface.edges[foot.entity], foot.patch, foot.side);
    if (beside >= 0) faces.push_back(beside);
  }
  if (foot.status == FootStatus::corner) {
    const Vertex& vertex = surface.vertices[foot.entity];
    const Corner* corners = surface.corners.data() + vertex.first_corner;
    const auto of_foot = [&](const Corner& corner) { return corner.face == foot.patch; };
    const Corner* own = std::find_if(corners, corners + vertex.corner_count, of_foot);
    if (own == corners + vertex.corner_count) return;
    const int group = own->group[foot.side < 0];
    for (int c = 0; c < vertex.corner_count; ++c)
      if (corners[c].group[0] == group || corners[c].group[1] == group) faces.push_back(corners[c].face);
  }
}

// By distance; feet that are as far by their places, so that pieces which are too far do not change the
// order.
bool comes_before(const Foot& a, const Foot& b) {
  if (a.distance != b.distance) return a.distance < b.distance;
  const auto place = [](const Foot& foot) {
    return std::make_tuple(foot.patch, foot.status, foot.entity, foot.side, foot.xi[0], foot.xi[1]);
  };
  return place(a) < place(b);
}

}  // namespace

// Where the concave edge between them bends by much less than they are apart, as round-off in a plane does,
// it is not the reason that there are two.
bool Minima::gives_way(const Foot& foot, const Foot& nearer, const SmoothNeighbours& neighbours) const {
  constexpr double kLeastBend = 0.01;  // of the angle between the feet
  if (foot.sheet != nearer.sheet) return false;
  const Vector3 a = d_ - foot.point, b = d_ - nearer.point;
  if (a.dot(b) < std::cos(surface_.edge_angle) * foot.distance * nearer.distance) return false;
  const double angle = a.cross(b).norm() / (foot.distance * nearer.distance);
  thread_local std::vector<int> from, to;
  faces_at(surface_, foot, from);
  faces_at(surface_, nearer, to);
  return neighbours.joined(from, to, kLeastBend * angle);
}

bool Minima::repeats(const Foot& foot, const Foot& other) const {
  return foot.sheet == other.sheet && (foot.point - other.point).squaredNorm() <= same_point2_;
}

// On borders to within round-off a point can have the feet of a face, of its edge and of a vertex; which of
// them may give way is not the same, so they are joined last.  The face's stays.
void Minima::choose(const SmoothNeighbours& neighbours) {
  const auto begin = out_.begin() + static_cast<std::ptrdiff_t>(begin_);
  std::sort(begin, out_.end(), comes_before);
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
