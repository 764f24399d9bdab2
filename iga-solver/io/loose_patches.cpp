// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/loose_patches.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "brep/disjoint_sets.h"
#include "search/surface_projector.h"
#include "structure/weld.h"

namespace io {

namespace {

constexpr double kNear = 0.05;  // of an element's width: less is a gap by mistake
constexpr double kTouching = 1e-9;

/// A face that is not welded to another one.
struct OpenFace {
  structure::SkinSurface skin;
  search::Box box;
  search::SurfaceProjector projector;

  explicit OpenFace(structure::SkinSurface of)
      : skin(std::move(of)),
        box{skin.X.rowwise().minCoeff(), skin.X.rowwise().maxCoeff()},
        projector(skin.face.space, skin.X) {}
  std::string name() const {
    return fmt::format("'{} {}'", skin.piece.patch, nurbs::face_name(skin.piece.face));
  }
  nurbs::Vector3 outward(const search::SurfaceProjector::Tangents& at) const {
    return skin.face.outward_sign * at.along[0].cross(at.along[1]).normalized();
  }
};

/// From a face to another one, at a point of it.
struct Gap {
  const OpenFace *from, *to;
  double distance, width;  ///< of the element there
  double share() const { return distance / width; }
  std::string in_words() const {
    return share() < kTouching ? fmt::format("touches face {}", from->name())
                               : fmt::format("is {:.3g} from face {}, {:.2g} of an element's width", distance,
                                             from->name(), share());
  }
};

std::deque<OpenFace> open_faces(const ModelFile& model) {
  std::vector<nurbs::Space<3>> spaces;
  for (int p = 0; p < model.patch_count(); ++p) spaces.push_back(model.volume(p).space);
  std::deque<OpenFace> faces;  // which do not move
  for (const structure::SkinPiece& piece : structure::free_faces(spaces, model.nodes))
    faces.emplace_back(skin_of(model.geometry, model.nodes, piece));
  return faces;
}

/// An element's middle and, `inset` of the way from there to its corners, four points more; and how wide it
/// is.
template <class Visit>
void for_each_sample(const OpenFace& face, double inset, Visit visit) {
  const nurbs::Space<2>& space = face.skin.face.space;
  for (int e = 0; e < space.element_count(); ++e) {
    const nurbs::Indices<2> at = space.element_indices(e);
    const nurbs::Parameter<2> centre = space.element_centre(e);
    const auto middle = face.projector.tangents(centre);  // per half an element
    const double width = 2.0 * std::min(middle.along[0].norm(), middle.along[1].norm());
    visit(middle, width);
    for (int corner = 0; corner < 4; ++corner) {
      nurbs::Parameter<2> xi{space.knots(0).breaks()[at[0] + corner % 2],
                             space.knots(1).breaks()[at[1] + corner / 2]};
      for (int d = 0; d < 2; ++d) xi[d] = inset * xi[d] + (1.0 - inset) * centre[d];
      visit(face.projector.tangents(xi), width);
    }
  }
}

/// Whether there is no material between a point of a face and its foot on another one.
bool are_face_to_face(const OpenFace& from, const search::SurfaceProjector::Tangents& at, const OpenFace& to,
                      const search::Foot& foot, double width) {
  constexpr double kOpposite = -0.5;
  const auto there = to.projector.tangents(foot.xi);
  const nurbs::Vector3 normal = from.outward(at);
  return normal.dot(to.outward(there)) < kOpposite &&
         (foot.distance < kTouching * width || normal.dot(there.point - at.point) > 0.0);
}

/// The narrowest gap, if there is one.  Faces of one piece may meet at their borders, and are that near to
/// each other on both sides of a thin plate.
std::optional<Gap> gap_between(const OpenFace& from, const OpenFace& to, bool are_one_piece) {
  search::Box near = from.box;
  near.inflate(kNear * (from.box.high - from.box.low).norm());
  if (!near.overlaps(to.box)) return {};
  std::optional<Gap> narrowest;
  std::vector<search::Foot> feet;
  for_each_sample(from, are_one_piece ? 0.5 : 1.0, [&](const auto& at, double width) {
    const double reach = (narrowest ? narrowest->share() : kNear) * width;
    if (!(to.box.squared_distance(at.point) < reach * reach)) return;
    to.projector.all_minima(at.point, reach, feet);
    if (feet.empty()) return;
    const search::Foot& foot = feet.front();
    if (!are_one_piece || are_face_to_face(from, at, to, foot, width))
      narrowest = Gap{&from, &to, foot.distance, width};
  });
  return narrowest;
}

std::string almost_welded(const ModelFile& model) {
  if (!model.welds) return "";
  const Pieces pieces = pieces_of(model.nodes);
  const auto piece = [&](const OpenFace& face) { return pieces.of_patch[face.skin.piece.patch]; };
  const std::deque<OpenFace> faces = open_faces(model);
  std::map<std::pair<int, int>, Gap> gaps;  // the narrowest between two patches
  for (const OpenFace& from : faces)
    for (const OpenFace& to : faces) {
      if (&from == &to) continue;
      const std::optional<Gap> gap = gap_between(from, to, piece(from) == piece(to));
      if (!gap) continue;
      Gap& least = gaps.emplace(std::minmax(from.skin.piece.patch, to.skin.piece.patch), *gap).first->second;
      if (gap->share() < least.share()) least = *gap;
    }
  if (gaps.empty()) return "";
  const Gap& gap = std::min_element(gaps.begin(), gaps.end(), [](const auto& a, const auto& b) {
                     return a.second.share() < b.second.share();
                   })->second;
  const bool is_crack = piece(*gap.from) == piece(*gap.to);
  return fmt::format(
      "the body {}: face {} {}, and is not welded to it{}; welds are where control points "
      "stand within 1e-9 of the body's size: let whole faces of one mesh meet, or {} if it is meant",
      is_crack ? "has a crack" : fmt::format("falls into {} pieces", pieces.count), gap.to->name(),
      gap.in_words(), gaps.size() == 1 ? "" : fmt::format(" ({} such places in all)", gaps.size()),
      is_crack ? "leave it so" : "'weld: no'");
}

std::string hinges(const ModelFile& model) {
  using PatchPair = std::pair<int, int>;
  std::vector<nurbs::Space<3>> spaces;
  for (int p = 0; p < model.patch_count(); ++p) spaces.push_back(model.volume(p).space);
  std::map<structure::Id, std::vector<PatchPair>> across_faces;  // of nodes on welded faces
  for (const auto& [a, b] : structure::welded_faces(spaces, model.nodes))
    for (const int point : nurbs::boundary_surface(spaces[a.patch], a.face).volume_control_point)
      across_faces[model.nodes.node(a.patch, point)].emplace_back(a.patch, b.patch);
  std::map<PatchPair, int> shared;  // nodes, of patches that no faces around them join
  for (std::size_t i = 0; i < model.nodes.welded().size(); ++i) {
    brep::DisjointSets sets(model.patch_count());
    for (const auto& [a, b] : across_faces[model.nodes.welded()[i]]) sets.join(a, b);
    const auto places = model.nodes.places_of_welded(i);
    for (const auto& place : places)
      if (sets.find(place.patch) != sets.find(places.front().patch)) {
        ++shared[{places.front().patch, place.patch}];
        break;
      }
  }
  if (shared.empty()) return "";
  const auto& [patches, count] = *shared.begin();
  return fmt::format(
      "patches {} and {} share {}, but no face there{}: nothing keeps them from turning about it; let "
      "whole faces of one mesh meet",
      patches.first, patches.second, count == 1 ? "a corner" : fmt::format("an edge ({} nodes)", count),
      shared.size() == 1 ? "" : fmt::format(" ({} such pairs in all)", shared.size()));
}

}  // namespace

Pieces pieces_of(const structure::NodeNumbering& nodes) {
  brep::DisjointSets sets(nodes.patch_count());
  for (std::size_t i = 0; i < nodes.welded().size(); ++i) {
    const auto places = nodes.places_of_welded(i);
    for (const auto& place : places) sets.join(places.front().patch, place.patch);
  }
  Pieces pieces;
  pieces.count = sets.number(pieces.of_patch);
  return pieces;
}

std::vector<std::string> loose_patches(const ModelFile& model) {
  std::vector<std::string> told;
  for (std::string looseness : {almost_welded(model), hinges(model)})
    if (!looseness.empty()) told.push_back(std::move(looseness));
  return told;
}

}  // namespace io
