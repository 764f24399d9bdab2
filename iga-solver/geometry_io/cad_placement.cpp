// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_placement.h"

#include <cmath>
#include <stdexcept>

namespace geometry_io {
namespace {

using FaceKind = brep::Kind;
using brep::Vector3;

// A rotation, the same factor for all lengths, and a shift.
struct Similarity {
  Eigen::Matrix3d rotation;
  double factor;
  Placement placement;

  explicit Similarity(const Placement& given)
      : factor(std::cbrt(given.linear().determinant())), placement(given) {
    rotation = given.linear() / factor;
    if (!(factor > 0.0) || !((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() < 1e-12))
      throw std::invalid_argument(
          "scale is not the same in all directions, expected one factor for the faces of a CAD file");
  }
  // Turned alone, exactly if there is nothing to turn.
  Vector3 direction(const Vector3& v) const {
    return placement.linear().isDiagonal(0.0) ? v : Vector3(rotation * v);
  }
};

// Which parameters of a face are lengths.
bool is_length(FaceKind kind, int direction) {
  return kind == FaceKind::plane ||
         (direction == 1 && (kind == FaceKind::cylinder || kind == FaceKind::cone));
}

void place_face(brep::CadFace& face, const Similarity& by) {
  brep::Face& shape = face.shape;
  shape.frame.origin = by.placement * shape.frame.origin;
  shape.frame.x = by.direction(shape.frame.x);
  shape.frame.y = by.direction(shape.frame.y);
  shape.frame.z = by.direction(shape.frame.z);
  shape.R *= by.factor;
  if (shape.kind != FaceKind::cone) shape.r *= by.factor;
  face.tolerance *= by.factor;
  for (int d = 0; d < 2; ++d) {
    if (!is_length(shape.kind, d)) continue;
    shape.low[d] *= by.factor;
    shape.high[d] *= by.factor;
    for (brep::Loop& loop : face.loops)
      for (brep::Trim& trim : loop) trim.curve.points.row(d) *= by.factor;
  }
}

void place_edge(brep::CadEdge& edge, const Similarity& by) {
  edge.origin = by.placement * edge.origin;
  edge.axis = by.direction(edge.axis);
  edge.radial = by.direction(edge.radial);
  edge.R *= by.factor;
  if (edge.kind == brep::CadEdge::Kind::line) edge.length *= by.factor;
  edge.tolerance *= by.factor;
  edge.curve.points = (by.placement * edge.curve.points).eval();
}

}  // namespace

void place(brep::CadModel& model, const Placement& placement) {
  const Similarity by(placement);
  for (brep::CadFace& face : model.faces) place_face(face, by);
  for (brep::CadEdge& edge : model.edges) place_edge(edge, by);
  for (brep::CadVertex& vertex : model.vertices) {
    vertex.point = by.placement * vertex.point;
    vertex.tolerance *= by.factor;
  }
  for (nurbs::Surface& patch : model.patches) place(patch.control_points, placement);
}

}  // namespace geometry_io
