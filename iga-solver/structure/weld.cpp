// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/weld.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "nurbs/boundary.h"
#include "nurbs/coincident.h"

namespace structure {

namespace {

using nurbs::Vector3;

std::vector<int> control_point_counts(const std::vector<nurbs::Volume>& patches) {
  std::vector<int> counts;
  for (const nurbs::Volume& patch : patches) counts.push_back(patch.space.control_point_count());
  return counts;
}

/// Whether a control point belongs to the rim of its net.
bool on_face(const nurbs::Space<3>& space, int control_point) {
  for (int d = 0, rest = control_point; d < 3; rest /= space.control_point_count(d++))
    if (const int i = rest % space.control_point_count(d); i == 0 || i == space.control_point_count(d) - 1)
      return true;
  return false;
}

/// A face of a patch, and its nodes.
struct FaceNet {
  int patch;
  nurbs::Face face;
  nurbs::BoundarySurface surface;
  std::vector<Id> nodes;  // per control point

  int count(int d) const { return surface.space.control_point_count(d); }
  Id node(int i, int j) const { return nodes[i + count(0) * j]; }
  std::array<Id, 4> corners() const {
    const int u = count(0) - 1, v = count(1) - 1;
    std::array<Id, 4> corners{node(0, 0), node(u, 0), node(0, v), node(u, v)};
    std::sort(corners.begin(), corners.end());
    return corners;
  }
  /// Shrunk to a curve: no surface.
  bool collapsed() const {
    bool along[2] = {true, true};
    for (int j = 0; j < count(1); ++j)
      for (int i = 0; i < count(0); ++i) {
        along[0] = along[0] && node(i, j) == node(0, j);
        along[1] = along[1] && node(i, j) == node(i, 0);
      }
    return along[0] || along[1];
  }
  std::string name() const {
    return patch == 0 ? nurbs::face_name(face) : fmt::format("{} {}", patch, nurbs::face_name(face));
  }
  std::string mesh() const {
    return fmt::format("{} x {} control points of degrees {}, {}", count(0), count(1),
                       surface.space.degree(0), surface.space.degree(1));
  }
};

std::vector<FaceNet> faces_of(const std::vector<nurbs::Volume>& patches, const NodeNumbering& numbering) {
  std::vector<FaceNet> faces;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (int f = 0; f < 6; ++f) {
      const auto face = static_cast<nurbs::Face>(f);
      FaceNet net{static_cast<int>(p), face, nurbs::boundary_surface(patches[p].space, face), {}};
      for (const int a : net.surface.volume_control_point)
        net.nodes.push_back(numbering.node(static_cast<int>(p), a));
      faces.push_back(std::move(net));
    }
  return faces;
}

/// How the directions of one face run on another one.
struct Turn {
  bool swapped, flipped[2];
};

/// Knots of a direction from either end: between lines of no smoothness, each part of length 1.  What such
/// parts have for lengths changes no function of the place.
std::vector<double> relative_knots(const nurbs::KnotVector& knots, bool flipped) {
  const std::vector<double>& all = knots.knots();
  const auto is_joint = [&](double knot) {
    const auto [first, last] = std::equal_range(all.begin(), all.end(), knot);
    return last - first >= knots.degree();
  };
  std::vector<double> joints, relative;
  for (const double knot : knots.breaks())
    if (is_joint(knot)) joints.push_back(knot);
  for (const double knot : all) {
    const auto next = std::upper_bound(joints.begin() + 1, joints.end() - 1, knot);
    const double before = *(next - 1);
    relative.push_back(static_cast<double>(next - joints.begin()) - 1.0 + (knot - before) / (*next - before));
  }
  if (!flipped) return relative;
  for (double& knot : relative) knot = static_cast<double>(joints.size()) - 1.0 - knot;
  std::reverse(relative.begin(), relative.end());
  return relative;
}

constexpr double kSame = 1e-9;  // of knots and weights, as of places: what they move is of that share

bool same_knots(const nurbs::KnotVector& a, const nurbs::KnotVector& b, bool flipped) {
  if (a.degree() != b.degree() || a.knots().size() != b.knots().size()) return false;
  const std::vector<double> of_a = relative_knots(a, false), of_b = relative_knots(b, flipped);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(),
                    [](double x, double y) { return std::abs(x - y) <= kSame; });
}

bool same_knots(const FaceNet& a, const FaceNet& b, const Turn& turn) {
  for (int d = 0; d < 2; ++d)
    if (!same_knots(a.surface.space.knots(d), b.surface.space.knots(turn.swapped ? 1 - d : d),
                    turn.flipped[d]))
      return false;
  return true;
}

/// Of `b`, turned, the control point that stands where (i, j) of `a` does.
int turned(const FaceNet& a, const FaceNet& b, const Turn& turn, int i, int j) {
  int at[2] = {turn.flipped[0] ? a.count(0) - 1 - i : i, turn.flipped[1] ? a.count(1) - 1 - j : j};
  if (turn.swapped) std::swap(at[0], at[1]);
  return at[0] + b.count(0) * at[1];
}

bool same_nodes(const FaceNet& a, const FaceNet& b, const Turn& turn) {
  for (int d = 0; d < 2; ++d)
    if (a.count(d) != b.count(turn.swapped ? 1 - d : d)) return false;
  for (int j = 0; j < a.count(1); ++j)
    for (int i = 0; i < a.count(0); ++i)
      if (a.node(i, j) != b.nodes[turned(a, b, turn, i, j)]) return false;
  return true;
}

/// But for a common factor.
bool same_weights(const FaceNet& a, const FaceNet& b, const Turn& turn) {
  const auto ratio = [&](int i, int j) {
    return b.surface.space.weight(turned(a, b, turn, i, j)) / a.surface.space.weight(i + a.count(0) * j);
  };
  const double wanted = ratio(0, 0);
  for (int j = 0; j < a.count(1); ++j)
    for (int i = 0; i < a.count(0); ++i)
      if (!(std::abs(ratio(i, j) / wanted - 1.0) <= kSame)) return false;
  return true;
}

/// What one face has otherwise than the other, however this is turned.
enum class Difference { none, weights, knots, control_points };

Difference difference(const FaceNet& a, const FaceNet& b) {
  Difference least = Difference::control_points;
  for (int k = 0; k < 8; ++k) {
    const Turn turn{(k & 4) != 0, {(k & 1) != 0, (k & 2) != 0}};
    if (!same_nodes(a, b, turn)) continue;
    least = std::min(least, !same_knots(a, b, turn)     ? Difference::knots
                            : !same_weights(a, b, turn) ? Difference::weights
                                                        : Difference::none);
  }
  return least;
}

Vector3 centre(const nurbs::Volume& patch, const FaceNet& net) {
  nurbs::Parameter<2> middle;
  for (int d = 0; d < 2; ++d)
    middle[d] = 0.5 * (net.surface.space.knots(d).front() + net.surface.space.knots(d).back());
  return nurbs::interpolate(net.surface.space,
                            patch.control_points(Eigen::all, net.surface.volume_control_point), middle);
}

/// Tangents in the middle of a face: one that leads into the patch, and the normal of the other two.
struct FaceSide {
  Vector3 inward, normal;
};

FaceSide side_of(const nurbs::Volume& patch, nurbs::Face face) {
  const int across = static_cast<int>(face) / 2;
  const bool is_upper = static_cast<int>(face) % 2 == 1;
  nurbs::Parameter<3> middle;
  for (int d = 0; d < 3; ++d) {
    const nurbs::KnotVector& knots = patch.space.knots(d);
    middle[d] = d != across ? 0.5 * (knots.front() + knots.back()) : is_upper ? knots.back() : knots.front();
  }
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(patch.space, middle, 1, basis);
  Vector3 tangents[3];
  for (int d = 0; d < 3; ++d) {
    tangents[d].setZero();
    for (int k = 0; k < basis.count; ++k)
      tangents[d] += basis.dR[d][k] * patch.control_points.col(basis.control_point[k]);
  }
  return {is_upper ? Vector3(-tangents[across]) : tangents[across],
          tangents[(across + 1) % 3].cross(tangents[(across + 2) % 3])};
}

/// On a face that two patches share one is on each side.
void expect_opposite_sides(const std::vector<nurbs::Volume>& patches, const FaceNet& a, const FaceNet& b,
                           double tolerance) {
  if (a.patch == b.patch) return;
  const nurbs::Volume &first = patches[a.patch], &second = patches[b.patch];
  const FaceSide side = side_of(first, a.face);
  const double first_way = side.inward.dot(side.normal),
               second_way = side_of(second, b.face).inward.dot(side.normal);
  if (!(first_way * second_way > 0.0)) return;
  const bool is_given_twice =
      first.control_points.cols() == second.control_points.cols() &&
      (first.control_points - second.control_points).cwiseAbs().maxCoeff() <= tolerance;
  throw std::invalid_argument(
      is_given_twice
          ? fmt::format("patches {} and {} are one volume given twice, expected it once", a.patch, b.patch)
          : fmt::format(
                "patches {} and {} lie in each other: both are on the same side of the face that they "
                "share, '{}' and '{}', expected one on each side; remove one of them, or move them apart",
                a.patch, b.patch, a.name(), b.name()));
}

double extent(const std::vector<nurbs::Volume>& patches) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const nurbs::Volume& patch : patches) {
    low = low.cwiseMin(patch.control_points.rowwise().minCoeff());
    high = high.cwiseMax(patch.control_points.rowwise().maxCoeff());
  }
  return (high - low).norm();
}

/// Pairs of faces with the same four corners, each once.
template <class Visit>
void for_each_touching_pair(const std::vector<FaceNet>& faces, Visit visit) {
  std::map<std::array<Id, 4>, std::vector<const FaceNet*>> by_corners;
  for (const FaceNet& face : faces) {
    if (face.collapsed()) continue;
    std::vector<const FaceNet*>& before = by_corners[face.corners()];
    for (const FaceNet* other : before) visit(*other, face);
    before.push_back(&face);
  }
}

constexpr const char* kOneMesh =
    "expected one mesh on both: the same degrees, knots and weights, so that they can be welded";

/// Faces are meant to be one surface, as a rule, if they share corners and centre, or all control points.
void expect_one_mesh(const std::vector<nurbs::Volume>& patches, const NodeNumbering& nodes,
                     double tolerance) {
  for_each_touching_pair(faces_of(patches, nodes), [&](const FaceNet& a, const FaceNet& b) {
    const Difference other = difference(a, b);
    if (other == Difference::none) return expect_opposite_sides(patches, a, b, tolerance);
    if (other != Difference::control_points)
      throw std::invalid_argument(
          fmt::format("faces '{}' and '{}' have the same control points, but other {}, {}", a.name(),
                      b.name(), other == Difference::knots ? "degrees or knots" : "weights", kOneMesh));
    if ((centre(patches[a.patch], a) - centre(patches[b.patch], b)).norm() > tolerance) return;
    throw std::invalid_argument(fmt::format("faces '{}' ({}) and '{}' ({}) are one surface, {}", a.name(),
                                            a.mesh(), b.name(), b.mesh(), kOneMesh));
  });
}

/// Of another patch, how many nodes of a face it has, and how many of those inside it.
struct Shared {
  int all = 0, inside = 0;
};

std::map<int, Shared> shared_nodes(const FaceNet& face, const NodeNumbering& nodes) {
  std::map<int, Shared> shared;
  for (int j = 0; j < face.count(1); ++j)
    for (int i = 0; i < face.count(0); ++i) {
      const auto found = std::lower_bound(nodes.welded().begin(), nodes.welded().end(), face.node(i, j));
      if (found == nodes.welded().end() || *found != face.node(i, j)) continue;
      std::set<int> others;
      for (const auto& [patch, control_point] : nodes.places_of_welded(found - nodes.welded().begin()))
        if (patch != face.patch) others.insert(patch);
      const bool is_inside = 0 < i && i + 1 < face.count(0) && 0 < j && j + 1 < face.count(1);
      for (const int patch : others) ++shared[patch].all, shared[patch].inside += is_inside;
    }
  return shared;
}

/// Where a face meets another patch in part, some control points may stand at one place by chance.
void expect_whole_faces(const std::vector<nurbs::Volume>& patches, const NodeNumbering& nodes) {
  for (const FaceNet& face : faces_of(patches, nodes)) {
    const int count = face.count(0) * face.count(1);
    for (const auto& [patch, shared] : shared_nodes(face, nodes))
      if (shared.inside > 0 && shared.all < count)
        throw std::invalid_argument(fmt::format(
            "patch {} meets face '{}' in part: {} of the {} control points of that face stand where it has "
            "some, expected all, or none inside; divide patches so that whole faces meet, or move them apart",
            patch, face.name(), shared.all, count));
  }
}

}  // namespace

NodeNumbering without_welds(const std::vector<nurbs::Volume>& patches) {
  return NodeNumbering(control_point_counts(patches));
}

NodeNumbering weld(const std::vector<nurbs::Volume>& patches, double relative_tolerance) {
  // Only faces touch: nets inside them may be as fine as they like.
  std::vector<int> rim;
  std::vector<Vector3> points;
  int before = 0;
  for (const nurbs::Volume& patch : patches) {
    for (int a = 0; a < patch.space.control_point_count(); ++a)
      if (on_face(patch.space, a)) {
        rim.push_back(before + a);
        points.emplace_back(patch.control_points.col(a));
      }
    before += patch.space.control_point_count();
  }
  nurbs::NodalVectors rim_points(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) rim_points.col(static_cast<Eigen::Index>(k)) = points[k];
  const std::vector<int> first_of_rim = nurbs::first_coincident(rim_points, relative_tolerance);

  std::vector<int> first(before);
  for (int place = 0; place < before; ++place) first[place] = place;
  for (std::size_t k = 0; k < rim.size(); ++k) first[rim[k]] = rim[first_of_rim[k]];
  NodeNumbering nodes(control_point_counts(patches), first);
  if (nodes.welded().empty()) return nodes;
  expect_one_mesh(patches, nodes, relative_tolerance * extent(patches));
  expect_whole_faces(patches, nodes);
  return nodes;
}

namespace {

/// Faces on the same nodes, which are sorted, each once: round faces may have their seams at different
/// places.
std::map<std::vector<Id>, std::vector<SkinPiece>> faces_by_nodes(const std::vector<nurbs::Space<3>>& patches,
                                                                 const NodeNumbering& nodes) {
  std::map<std::vector<Id>, std::vector<SkinPiece>> by_nodes;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (int f = 0; f < 6; ++f) {
      const SkinPiece piece{p, static_cast<nurbs::Face>(f)};
      std::vector<Id> on_face;
      for (const int point : nurbs::boundary_surface(patches[p], piece.face).volume_control_point)
        on_face.push_back(nodes.node(p, point));
      std::sort(on_face.begin(), on_face.end());
      on_face.erase(std::unique(on_face.begin(), on_face.end()), on_face.end());
      by_nodes[on_face].push_back(piece);
    }
  return by_nodes;
}

}  // namespace

std::vector<SkinPiece> free_faces(const std::vector<nurbs::Space<3>>& patches, const NodeNumbering& nodes) {
  std::vector<SkinPiece> free;
  for (const auto& [on_face, pieces] : faces_by_nodes(patches, nodes))
    if (pieces.size() == 1) free.push_back(pieces.front());
  std::sort(free.begin(), free.end(), [](const SkinPiece& a, const SkinPiece& b) {
    return std::pair(a.patch, a.face) < std::pair(b.patch, b.face);
  });
  return free;
}

std::vector<std::pair<SkinPiece, SkinPiece>> welded_faces(const std::vector<nurbs::Space<3>>& patches,
                                                          const NodeNumbering& nodes) {
  std::vector<std::pair<SkinPiece, SkinPiece>> welded;
  for (const auto& [on_face, pieces] : faces_by_nodes(patches, nodes))
    for (std::size_t k = 0; k < pieces.size() && pieces.size() > 1; ++k)
      welded.emplace_back(pieces[k], pieces[(k + 1) % pieces.size()]);
  return welded;
}

}  // namespace structure
