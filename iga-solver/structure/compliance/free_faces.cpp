// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/free_faces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/gauss_legendre.h"

namespace structure {

FaceSurface::FaceSurface(const ReferenceBody& body, const SkinPiece& piece)
    : body_(body),
      patch_(piece.patch),
      face_(nurbs::boundary_surface(body.patches[piece.patch].space, piece.face)),
      X_(body.patches[piece.patch].control_points(Eigen::all, face_.volume_control_point)) {}

std::vector<Id> FaceSurface::nodes_of(int element) const {
  std::vector<int> points(space().functions_per_element());
  space().element_control_points(element, points.data());
  std::vector<Id> nodes;
  for (const int point : points) nodes.push_back(body_.nodes.node(patch_, face_.volume_control_point[point]));
  return nodes;
}

Vector3 FaceSurface::place(int element, const nurbs::Parameter<2>& xi) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space(), element, xi, 0, basis);
  return nurbs::interpolate(basis, X_);
}

FaceSurface::Tangents FaceSurface::tangents(const nurbs::RationalBasis<2>& basis) const {
  Tangents at{Vector3::Zero(), {Vector3::Zero(), Vector3::Zero()}, {}};
  for (int a = 0; a < basis.count; ++a) {
    const Vector3 X = X_.col(basis.control_point[a]);
    at.point += basis.R[a] * X;
    for (int d = 0; d < 2; ++d) at.t[d] += basis.dR[d][a] * X;
  }
  at.area = face_.outward_sign * at.t[0].cross(at.t[1]);
  return at;
}

SkinPoint FaceSurface::at(int element, const nurbs::Parameter<2>& xi) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space(), element, xi, 1, basis);
  const Tangents at = tangents(basis);
  if (!(at.area.norm() > 1e-9 * at.t[0].norm() * at.t[1].norm()))
    throw std::invalid_argument(fmt::format(
        "the skin has no normal at ({:.6g}, {:.6g}, {:.6g}), where an edge of its patch is a point",
        at.point[0], at.point[1], at.point[2]));
  return {at.point, at.area.normalized(), nodes_of(element), {basis.R, basis.R + basis.count}};
}

Matrix3 FaceSurface::frame(int element, const nurbs::Parameter<2>& xi) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space(), element, xi, 1, basis);
  const Tangents at = tangents(basis);
  Matrix3 frame;
  frame.col(0) = at.t[0].normalized();
  frame.col(2) = at.area.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

// Where the surface of the half-space is free, too.
bool FaceSurface::is_in_tangent_plane(int element, const SkinPoint& foot) const {
  constexpr double kFlat = 1e-9;  // of the element's size
  std::vector<int> points(space().functions_per_element());
  space().element_control_points(element, points.data());
  double out = 0.0, size = 0.0;
  for (const int point : points) {
    out = std::max(out, std::abs(foot.outward_normal.dot(X_.col(point) - foot.point)));
    size = std::max(size, (X_.col(point) - X_.col(points.front())).norm());
  }
  return out <= kFlat * size;
}

void FaceSurface::integrate(int element, const std::vector<SkinPoint>& feet,
                            const std::vector<HalfSpace>& half_spaces) const {
  const nurbs::Indices<2> span = space().element_indices(element);
  Cell cell;
  for (int d = 0; d < 2; ++d) {
    cell.low[d] = space().knots(d).breaks()[span[d]];
    cell.high[d] = space().knots(d).breaks()[span[d] + 1];
  }
  std::vector<int> all;
  for (std::size_t f = 0; f < feet.size(); ++f)
    if (!is_in_tangent_plane(element, feet[f])) all.push_back(static_cast<int>(f));
  integrate(element, cell, 0, all, feet, half_spaces);
}

/// Its longer diagonal.
double FaceSurface::size_of(int element, const Cell& cell) const {
  const auto [low, high] = cell;
  return std::max((place(element, low) - place(element, high)).norm(),
                  (place(element, {low[0], high[1]}) - place(element, {high[0], low[1]})).norm());
}

// A traction falls as the square of the distance: a cell is cut in four for feet that are nearer than its
// size.
void FaceSurface::integrate(int element, const Cell& cell, int depth, const std::vector<int>& feet_here,
                            const std::vector<SkinPoint>& feet,
                            const std::vector<HalfSpace>& half_spaces) const {
  constexpr int kDeepest = 6;
  if (feet_here.empty()) return;
  const nurbs::Parameter<2> middle = {0.5 * (cell.low[0] + cell.high[0]), 0.5 * (cell.low[1] + cell.high[1])};
  const Vector3 centre = place(element, middle);
  const double size = size_of(element, cell);
  std::vector<int> near, far;
  for (const int f : feet_here)
    (depth < kDeepest && (feet[f].point - centre).norm() < size ? near : far).push_back(f);
  for (int quarter = 0; quarter < 4; ++quarter) {
    Cell part = cell;
    for (int d = 0; d < 2; ++d) ((quarter >> d & 1) != 0 ? part.low : part.high)[d] = middle[d];
    integrate(element, part, depth + 1, near, feet, half_spaces);
  }
  add_cell(element, cell, far, feet, half_spaces);
}

void FaceSurface::add_cell(int element, const Cell& cell, const std::vector<int>& feet_here,
                           const std::vector<SkinPoint>& feet,
                           const std::vector<HalfSpace>& half_spaces) const {
  if (feet_here.empty()) return;
  const int points = std::max(space().degree(0), space().degree(1)) + 2;
  const nurbs::QuadratureRule x = nurbs::gauss_legendre(points, cell.low[0], cell.high[0]),
                              y = nurbs::gauss_legendre(points, cell.low[1], cell.high[1]);
  nurbs::RationalBasis<2> basis;
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      nurbs::evaluate_on_element(space(), element, {x.points[i], y.points[j]}, 1, basis);
      const Tangents at = tangents(basis);
      const double weight = x.weights[i] * y.weights[j] * at.area.norm();
      if (!(weight > 0.0)) continue;
      for (const int f : feet_here) {
        const Matrix3 t = weight * half_spaces[f].traction(at.point - feet[f].point, at.area.normalized());
        for (int a = 0; a < basis.count; ++a)
          local_.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(f)) +=
              basis.R[a] * t;
      }
    }
}

}  // namespace structure
