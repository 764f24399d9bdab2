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

// Whether slightly concave smooth edges, one of them bent by so much [rad], lead from one to the other.
bool are_joined(const Surface& surface, const Foot& foot, const Foot& other,
                const SmoothNeighbours& neighbours, double bend) {
  thread_local std::vector<int> from, to;
  faces_at(surface, foot, from);
  faces_at(surface, other, to);
  return neighbours.joined(from, to, bend);
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
constexpr double kLeastBend = 0.01;  // of the angle between the feet

bool Minima::gives_way(const Foot& foot, const Foot& nearer, const SmoothNeighbours& neighbours) const {
  if (foot.sheet != nearer.sheet) return false;
  const double angle = angle_between(foot, nearer);
  return angle <= surface_.edge_angle && are_joined(surface_, foot, nearer, neighbours, kLeastBend * angle);
}

double Minima::angle_between(const Foot& foot, const Foot& other) const {
  const Vector3 a = d_ - foot.point, b = d_ - other.point;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// By how much the direction to a foot turns at most where d moves by less than half of the distance
// [rad/length].
double Minima::turn(const Foot& foot) const {
  const bool is_over_plane =
      foot.status == FootStatus::interior && surface_.faces[foot.patch].kind == Kind::plane;
  return is_over_plane ? 0.0 : 2.0 / foot.distance;
}

// A foot that gives way does so as long as one to which it does is nearer, and they are not apart by more
// than the angle of edges; one that does not as long as none is nearer that is less than this angle apart.
double Minima::room_to_choose(const SmoothNeighbours& neighbours) {
  constexpr double kNoEnd = std::numeric_limits<double>::infinity(), kNotGone = -1.0;
  if (!neighbours.any() || out_.size() <= begin_ + 1) return kNoEnd;
  sort_by_distance();
  double room = kNoEnd;
  for (size_t k = begin_; k < out_.size(); ++k) {
    const Foot& foot = out_[k];
    double stays = kNoEnd, gone = kNotGone;
    for (size_t l = begin_; l < out_.size(); ++l) {
      const Foot& other = out_[l];
      if (l == k || other.sheet != foot.sheet) continue;
      if (repeats(foot, other)) return 0.0;
      const double until_nearer = 0.5 * std::abs(foot.distance - other.distance);
      const double left = surface_.edge_angle - angle_between(foot, other),
                   turning = turn(foot) + turn(other);
      const double until_turned = turning > 0.0 ? std::abs(left) / turning : kNoEnd;
      if (left < 0.0)
        stays = std::min(stays, std::max(l > k ? until_nearer : 0.0, until_turned));
      else if (l > k)
        stays = std::min(stays, until_nearer);
      else if (are_joined(surface_, foot, other, neighbours, kLeastBend * surface_.edge_angle))
        gone = std::max(gone, std::min(until_nearer, until_turned));
      else
        return 0.0;
    }
    room = std::min(room, gone > kNotGone ? gone : stays);
  }
  return room;
}

bool Minima::repeats(const Foot& foot, const Foot& other) const {
  return foot.sheet == other.sheet && (foot.point - other.point).squaredNorm() <= same_point2_;
}

void Minima::sort_by_distance() {
  std::sort(out_.begin() + static_cast<std::ptrdiff_t>(begin_), out_.end(), comes_before);
}

// On borders to within round-off a point can have the feet of a face, of its edge and of a vertex; which of
// them may give way is not the same, so they are joined last.  The face's stays.
void Minima::choose(const SmoothNeighbours& neighbours) {
  const auto begin = out_.begin() + static_cast<std::ptrdiff_t>(begin_);
  sort_by_distance();
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
