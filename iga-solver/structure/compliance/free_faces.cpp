// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/free_faces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace structure {

std::vector<double> SkinPoint::forces_on(const std::vector<Id>& rising) const {
  std::vector<double> forces(rising.size(), 0.0);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    forces[std::lower_bound(rising.begin(), rising.end(), nodes[a]) - rising.begin()] += R[a];
  return forces;
}

FaceSurface::FaceSurface(const ReferenceBody& body, const SkinPiece& piece)
    : body_(body),
      patch_(piece.patch),
      face_(nurbs::boundary_surface(body.patches[piece.patch].space, piece.face)),
      X_(body.patches[piece.patch].control_points(Eigen::all, face_.volume_control_point)),
      near_rule_(nurbs::gauss_legendre(std::max(space().degree(0), space().degree(1)) + 2, 0.0, 1.0)),
      far_rule_(nurbs::gauss_legendre(std::max(space().degree(0), space().degree(1)) + 1, 0.0, 1.0)),
      along_{std::vector<nurbs::BasisFunctions>(near_rule_.points.size()),
             std::vector<nurbs::BasisFunctions>(near_rule_.points.size())},
      net_(4, space().functions_per_element()),
      R_(space().functions_per_element()) {}

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

std::array<Vector3, 2> FaceSurface::tangents(int element, const nurbs::Parameter<2>& xi) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space(), element, xi, 1, basis);
  const Tangents at = tangents(basis);
  return {at.t[0], at.t[1]};
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
  std::vector<int> points(space().functions_per_element());
  space().element_control_points(element, points.data());
  for (std::size_t a = 0; a < points.size(); ++a) {
    const double w = space().weight(points[a]);
    net_.col(static_cast<Eigen::Index>(a)) << w * X_.col(points[a]), w;
  }
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

// A traction falls as the square of the distance: a cell is cut in four for feet that are about as near as
// its size, and far ones have fewer points, both so that more would change c by some millionths.
void FaceSurface::integrate(int element, const Cell& cell, int depth, const std::vector<int>& feet_here,
                            const std::vector<SkinPoint>& feet,
                            const std::vector<HalfSpace>& half_spaces) const {
  constexpr int kDeepest = 4;
  constexpr double kInside = 1.01,
                   kFar = 2.03;  // sizes; not such as regular meshes have, or rounding decides
  if (feet_here.empty()) return;
  const nurbs::Parameter<2> middle = {0.5 * (cell.low[0] + cell.high[0]), 0.5 * (cell.low[1] + cell.high[1])};
  const Vector3 centre = place(element, middle);
  const double size = size_of(element, cell);
  std::vector<int> inside, near, far;
  for (const int f : feet_here) {
    const double distance = (feet[f].point - centre).norm();
    (depth < kDeepest && distance < kInside * size ? inside
     : distance < kFar * size                      ? near
                                                   : far)
        .push_back(f);
  }
  for (int quarter = 0; quarter < 4; ++quarter) {
    Cell part = cell;
    for (int d = 0; d < 2; ++d) ((quarter >> d & 1) != 0 ? part.low : part.high)[d] = middle[d];
    integrate(element, part, depth + 1, inside, feet, half_spaces);
  }
  add_cell(element, cell, near_rule_, near, feet, half_spaces);
  add_cell(element, cell, far_rule_, far, feet, half_spaces);
}

void FaceSurface::add_cell(int element, const Cell& cell, const nurbs::QuadratureRule& rule,
                           const std::vector<int>& feet_here, const std::vector<SkinPoint>& feet,
                           const std::vector<HalfSpace>& half_spaces) const {
  if (feet_here.empty()) return;
  const double length[2] = {cell.high[0] - cell.low[0], cell.high[1] - cell.low[1]};
  const auto points = static_cast<int>(rule.points.size());
  const nurbs::Indices<2> span = space().element_indices(element);
  for (int d = 0; d < 2; ++d)
    for (int i = 0; i < points; ++i)
      nurbs::evaluate_basis(space().knots(d), space().knots(d).span_of_element(span[d]),
                            cell.low[d] + length[d] * rule.points[i], 1, along_[d][i]);
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      const Vector3 point = evaluate(along_[0][i], along_[1][j]);
      const double size = area_.norm();
      const double weight = length[0] * rule.weights[i] * length[1] * rule.weights[j] * size;
      if (!(weight > 0.0)) continue;
      const Vector3 outward_normal = area_ / size;
      for (const int f : feet_here) {
        const Matrix3 t = weight * half_spaces[f].traction(point - feet[f].point, outward_normal);
        double* const sums = local_.col(static_cast<Eigen::Index>(f) * R_.size()).data();
        for (Eigen::Index a = 0; a < R_.size(); ++a) Matrix3::Map(sums + 9 * a) += R_[a] * t;
      }
    }
}

/// Point of the element that net_ is of, from functions along both directions; leaves R_ and the area vector
/// (outwards) in area_.
Vector3 FaceSurface::evaluate(const nurbs::BasisFunctions& x, const nurbs::BasisFunctions& y) const {
  const int p = space().degree(0), q = space().degree(1);
  Eigen::Matrix<double, 4, 3> sums = Eigen::Matrix<double, 4, 3>::Zero();  // of w X and w: value, derivatives
  for (int b = 0, k = 0; b <= q; ++b)
    for (int a = 0; a <= p; ++a, ++k) {
      R_[k] = net_(3, k) * x.values[0][a] * y.values[0][b];
      const Eigen::Vector4d P = net_.col(k);
      sums.col(0) += x.values[0][a] * y.values[0][b] * P;
      sums.col(1) += x.values[1][a] * y.values[0][b] * P;
      sums.col(2) += x.values[0][a] * y.values[1][b] * P;
    }
  const double inverse_W = 1.0 / sums(3, 0);
  R_ *= inverse_W;
  const Vector3 point = inverse_W * sums.col(0).head<3>();
  const Vector3 t_0 = inverse_W * (sums.col(1).head<3>() - sums(3, 1) * point),
                t_1 = inverse_W * (sums.col(2).head<3>() - sums(3, 2) * point);
  area_ = face_.outward_sign * t_0.cross(t_1);
  return point;
}

}  // namespace structure
