// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/faced_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "brep/builder.h"
#include "brep/closed_form.h"
#include "nurbs/borders.h"
#include "nurbs/point_grid.h"

namespace brep {
namespace {

using nurbs::Border;
using nurbs::KnotVector;

constexpr double kMeet = 1e-9;  // of the size: what is nearer is one point, as in find_borders

double size_of(const std::vector<nurbs::Surface>& patches) {
  Vector3 low = patches.front().control_points.col(0), high = low;
  for (const nurbs::Surface& patch : patches) {
    low = low.cwiseMin(patch.control_points.rowwise().minCoeff());
    high = high.cwiseMax(patch.control_points.rowwise().maxCoeff());
  }
  return (high - low).norm();
}

// A side of a patch as a curve, along the patch's own direction.
Spline<3> side_of(const nurbs::Surface& patch, int side) {
  const KnotVector& knots = patch.space.knots(1 - side / 2);
  const std::vector<int> points = nurbs::side_control_points(patch.space, side);
  Spline<3> spline{knots.degree(), knots.knots(), {}, {}};
  spline.points = patch.control_points(Eigen::all, points);
  if (patch.space.rational())
    for (const int point : points) spline.weights.push_back(patch.space.weight(point));
  return spline;
}

// From its start to its end, never back.
bool is_straight(const Spline<3>& curve) {
  constexpr double kRoundOff = 1e-14;  // of the length
  const Vector3 start = curve.points.leftCols<1>(), way = curve.points.rightCols<1>() - start;
  double last = 0.0;
  for (Eigen::Index k = 0; k < curve.points.cols(); ++k) {
    const Vector3 from = curve.points.col(k) - start;
    const double along = from.dot(way);
    if (along < last || from.cross(way).norm() > kRoundOff * way.squaredNorm()) return false;
    last = along;
  }
  return last > 0.0;
}

class Modeller {
 public:
  Modeller(const std::vector<nurbs::Surface>& patches, const nurbs::Borders& borders)
      : patches_(patches),
        borders_(borders),
        curves_(nurbs::curves_of_sides(patches)),
        edges_(nurbs::kSideCount * patches.size(), {kNone, false}),
        corners_(kMeet * size_of(patches), 4 * patches.size()) {
    model_.patches = patches;
    for (int p = 0; p < static_cast<int>(patches.size()); ++p) add_face(p);
  }
  CadModel model() { return std::move(model_); }

 private:
  static constexpr int kNone = -1;
  struct MadeEdge {
    int number;
    bool reversed;  // it runs against the side, or against the first of the sides that are this curve
  };

  // Counterclockwise: along eta-, xi+, and back along eta+ and xi-.
  void add_face(int p) {
    CadFace face;
    face.shape.kind = Kind::nurbs;
    face.shape.patch = p;
    face.number = p + 1;
    const KnotVector &u = patches_[p].space.knots(0), &v = patches_[p].space.knots(1);
    const Eigen::Vector2d corner[] = {
        {u.front(), v.front()}, {u.back(), v.front()}, {u.back(), v.back()}, {u.front(), v.back()}};
    face.loops.emplace_back();
    constexpr int kSides[] = {2, 1, 3, 0};
    for (int k = 0; k < 4; ++k) {
      Trim trim;
      trim.curve = {1, {0, 0, 1, 1}, (Eigen::Matrix2d() << corner[k], corner[(k + 1) % 4]).finished(), {}};
      const MadeEdge edge = edge_of(p, kSides[k]);
      trim.edge = edge.number;
      trim.forward = (k < 2) != edge.reversed;
      face.loops.back().push_back(std::move(trim));
    }
    model_.faces.push_back(std::move(face));
  }

  // Sides that are one curve have the edge of the one that comes first; a pole has none.
  MadeEdge edge_of(int p, int side) {
    if (borders_[p][side].kind == Border::pole) return {kNone, false};
    const nurbs::SideCurve& curve = curves_[p][side];
    MadeEdge& made = edges_[curve.first];
    if (made.number == kNone) {
      model_.edges.push_back(along(side_of(patches_[p], side)));
      made = {static_cast<int>(model_.edges.size()) - 1, curve.reversed};
    }
    return {made.number, made.reversed != curve.reversed};
  }

  CadEdge along(Spline<3> curve) {
    CadEdge edge;
    const Vector3 start = curve.points.leftCols<1>(), end = curve.points.rightCols<1>();
    edge.vertex[0] = vertex_at(start), edge.vertex[1] = vertex_at(end);
    edge.origin = edge.axis = edge.radial = Vector3::Zero();
    if (is_straight(curve)) {
      edge.kind = CadEdge::Kind::line;
      edge.origin = start;
      edge.axis = (end - start).normalized();
      edge.length = (end - start).norm();
      return edge;
    }
    edge.kind = CadEdge::Kind::spline;
    edge.curve = std::move(curve);
    return edge;
  }

  int vertex_at(const Vector3& point) {
    int vertex = kNone;
    corners_.for_each_near(point, [&](int known) { vertex = vertex < 0 ? known : std::min(vertex, known); });
    if (vertex >= 0) return vertex;
    vertex = static_cast<int>(model_.vertices.size());
    model_.vertices.push_back({point});
    corners_.add(vertex, point);
    return vertex;
  }

  const std::vector<nurbs::Surface>& patches_;
  const nurbs::Borders& borders_;
  CadModel model_;
  std::vector<std::array<nurbs::SideCurve, nurbs::kSideCount>> curves_;
  std::vector<MadeEdge> edges_;  // of the first side of each curve
  nurbs::PointGrid corners_;
};

bool any_turn(const nurbs::Borders& borders, double edge_angle) {
  for (const auto& sides : borders)
    for (const Border& border : sides)
      if (border.kind == Border::welded && border.max_angle > edge_angle) return true;
  return false;
}

// More than two sides in one place.
bool more_meet(const std::vector<nurbs::Surface>& patches, const nurbs::Borders& borders) {
  nurbs::PointGrid middles(kMeet * size_of(patches), nurbs::kSideCount * patches.size());
  const auto middle = [&](size_t p, int side) {
    const nurbs::Space<2>& space = patches[p].space;
    nurbs::Parameter<2> xi;
    for (int i = 0; i < 2; ++i) xi[i] = 0.5 * (space.knots(i).front() + space.knots(i).back());
    xi[side / 2] = side % 2 == 1 ? space.knots(side / 2).back() : space.knots(side / 2).front();
    return nurbs::interpolate(space, patches[p].control_points, xi);
  };
  for (size_t p = 0; p < patches.size(); ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side) {
      if (borders[p][side].kind == Border::pole) continue;
      const Vector3 at = middle(p, side);
      int others = 0;
      middles.for_each_near(at, [&](int) { ++others; });
      if (others > 1) return true;
      middles.add(static_cast<int>(p), at);
    }
  return false;
}

// Nothing but a line: its control points are.
bool has_no_area(const nurbs::Surface& patch) {
  const Vector3 start = patch.control_points.col(0);
  Eigen::Index farthest;
  const double length =
      std::sqrt((patch.control_points.colwise() - start).colwise().squaredNorm().maxCoeff(&farthest));
  const Vector3 way = patch.control_points.col(farthest) - start;
  for (const auto& point : patch.control_points.colwise())
    if (way.cross(point - start).norm() > kMeet * length * length) return false;
  return true;
}

}  // namespace

std::optional<FacedPatches> closed_forms(const std::vector<nurbs::Surface>& patches, double edge_angle) {
  std::vector<Face> faces;
  std::vector<Chart> charts;
  for (const nurbs::Surface& patch : patches) {
    const std::optional<ClosedForm> form = closed_form(patch);
    if (!form) return std::nullopt;
    faces.push_back(form->face);
    charts.push_back(form->chart);
  }
  return FacedPatches{from_faces(faces, edge_angle), std::move(charts), {}};
}

CadModel model_of(const std::vector<nurbs::Surface>& patches, const nurbs::Borders& borders) {
  return Modeller(patches, borders).model();
}

std::optional<FacedPatches> faced_patches(const std::vector<nurbs::Surface>& patches, bool from_words,
                                          double edge_angle) {
  PatchParts cut(patches, edge_angle);
  const std::vector<nurbs::Surface> parts = cut.parts_of(patches);
  const nurbs::Borders borders = nurbs::find_borders(parts);
  const bool turn = !cut.none() || any_turn(borders, edge_angle) || more_meet(parts, borders);
  if (!turn && !from_words) return std::nullopt;
  std::optional<FacedPatches> faced = closed_forms(parts, edge_angle);
  if (!faced && (!turn || std::any_of(parts.begin(), parts.end(), has_no_area))) return std::nullopt;
  if (!faced) {
    std::vector<int> all(parts.size());
    std::iota(all.begin(), all.end(), 0);
    faced = FacedPatches{from_cad(model_of(parts, borders), all, edge_angle), {}, {}};
  }
  faced->parts = std::move(cut);
  return faced;
}

}  // namespace brep
