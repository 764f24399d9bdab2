// SPDX-License-Identifier: GPL-2.0-or-later
#include "loose_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "brep/disjoint_sets.h"
#include "io/boundary_keys.h"
#include "search/surface_projector.h"
#include "structure/analysis/rigid_motions.h"
#include "structure/weld.h"

namespace app {

namespace {

constexpr double kNear = 0.05;  // of an element's width: less is a gap by mistake

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
};

/// From a face to another one, at a point of it.
struct Gap {
  const OpenFace *from, *to;
  double distance, width;  ///< of the element there
  double share() const { return distance / width; }
  std::string in_words() const {
    constexpr double kTouching = 1e-9;
    return share() < kTouching ? fmt::format("touches face {}", from->name())
                               : fmt::format("is {:.3g} from face {}, {:.2g} of an element's width", distance,
                                             from->name(), share());
  }
};

std::deque<OpenFace> open_faces(const io::ModelFile& model) {
  std::vector<nurbs::Space<3>> spaces;
  for (int p = 0; p < model.patch_count(); ++p) spaces.push_back(model.volume(p).space);
  std::deque<OpenFace> faces;  // which do not move
  for (const structure::SkinPiece& piece : structure::free_faces(spaces, model.nodes))
    faces.emplace_back(io::skin_of(model.geometry, model.nodes, piece));
  return faces;
}

/// A point of an element, and how wide the element is.
template <class Visit>
void for_each_sample(const OpenFace& face, Visit visit) {
  const nurbs::Space<2>& space = face.skin.face.space;
  for (int e = 0; e < space.element_count(); ++e) {
    const nurbs::Indices<2> at = space.element_indices(e);
    const auto middle = face.projector.tangents(space.element_centre(e));  // per half an element
    const double width = 2.0 * std::min(middle.along[0].norm(), middle.along[1].norm());
    visit(middle.point, width);
    for (int corner = 0; corner < 4; ++corner)
      visit(face.projector
                .tangents({space.knots(0).breaks()[at[0] + corner % 2],
                           space.knots(1).breaks()[at[1] + corner / 2]})
                .point,
            width);
  }
}

/// The narrowest gap, if there is one.
std::optional<Gap> gap_between(const OpenFace& from, const OpenFace& to) {
  search::Box near = from.box;
  near.inflate(kNear * (from.box.high - from.box.low).norm());
  if (!near.overlaps(to.box)) return {};
  std::optional<Gap> narrowest;
  for_each_sample(from, [&](const nurbs::Vector3& point, double width) {
    const double reach = (narrowest ? narrowest->share() : kNear) * width;
    if (!(to.box.squared_distance(point) < reach * reach)) return;
    const double distance = to.projector.cold(point).distance;
    if (distance < reach) narrowest = Gap{&from, &to, distance, width};
  });
  return narrowest;
}

/// Of the nodes of a piece, which rise.
std::size_t free_motions(const io::ModelFile& model, const std::vector<structure::Id>& nodes) {
  nurbs::NodalVectors X(3, nodes.size());
  for (std::size_t column = 0; column < nodes.size(); ++column) {
    const auto place = model.nodes.place(nodes[column]);
    X.col(static_cast<Eigen::Index>(column)) =
        model.volume(place.patch).control_points.col(place.control_point);
  }
  return structure::free_rigid_motions(X, io::supports_of(model.boundary).on(nodes),
                                       io::springs_of(model.boundary, model.geometry, model.nodes, nodes))
      .size();
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

FreeMotions free_motions(const io::ModelFile& model) {
  const Pieces pieces = pieces_of(model.nodes);
  std::vector<std::vector<structure::Id>> nodes(pieces.count);
  for (structure::Id node = 0; node < model.nodes.node_count(); ++node)
    nodes[pieces.of_patch[model.nodes.place(node).patch]].push_back(node);
  for (int piece = 0; piece < pieces.count; ++piece)
    if (const std::size_t count = free_motions(model, nodes[piece]); count > 0) {
      const auto first = std::find(pieces.of_patch.begin(), pieces.of_patch.end(), piece);
      return {count, pieces.count == 1
                         ? "it"
                         : fmt::format("patch {} and what is welded to it", first - pieces.of_patch.begin())};
    }
  return {};
}

void expect_held_pieces(const io::ModelFile& model) {
  if (std::holds_alternative<io::ModeAnalysis>(*model.analysis) || pieces_of(model.nodes).count == 1) return;
  if (const FreeMotions free = free_motions(model); free.count > 0)
    throw std::runtime_error(
        fmt::format("{}: {}: 'boundary' leaves {} free in {} of its 6 rigid motions, expected none: hold it, "
                    "or let whole faces of one mesh meet those of what is held",
                    model.file, io::analysis_word(*model.analysis), free.whose, free.count));
}

std::string almost_welded(const io::ModelFile& model) {
  const Pieces pieces = pieces_of(model.nodes);
  if (!model.welds || pieces.count == 1) return "";
  const std::deque<OpenFace> faces = open_faces(model);
  std::map<std::pair<int, int>, Gap> gaps;  // the narrowest between two pieces
  for (const OpenFace& from : faces)
    for (const OpenFace& to : faces) {
      const int a = pieces.of_patch[from.skin.piece.patch], b = pieces.of_patch[to.skin.piece.patch];
      if (a == b) continue;
      const std::optional<Gap> gap = gap_between(from, to);
      if (!gap) continue;
      Gap& least = gaps.emplace(std::minmax(a, b), *gap).first->second;
      if (gap->share() < least.share()) least = *gap;
    }
  if (gaps.empty()) return "";
  const Gap& gap = std::min_element(gaps.begin(), gaps.end(), [](const auto& a, const auto& b) {
                     return a.second.share() < b.second.share();
                   })->second;
  return fmt::format(
      "the body falls into {} pieces: face {} {}, and is not welded to it{}; welds are where control points "
      "stand within 1e-9 of the body's size: let whole faces of one mesh meet, or 'weld: no' if it is meant",
      pieces.count, gap.to->name(), gap.in_words(),
      gaps.size() == 1 ? "" : fmt::format(" ({} such places in all)", gaps.size()));
}

}  // namespace app
