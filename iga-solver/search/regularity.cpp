// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/regularity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/curvature.h"

namespace search {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFlush = 1e-6;  // sine of an angle between tangent planes that counts as none
constexpr int kSamples = 4;      // per direction of an element

}  // namespace

Regularity::Regularity(const MultiPatch& surface) : surface_(surface), shapes_(surface.element_count()) {}

void Regularity::set_control_points(const NodalVectors& control_points) {
  control_points_ = &control_points;
  for (Shape& shape : shapes_) shape.known = false;
  kinks_.clear();
}

bool Regularity::is_regular(const Vector3& d, double reach, int element) const {
  constexpr double kMargin = 2.0;
  Shape& shape = shapes_[element];
  if (!shape.known) measure(element, shape);
  if (!(kMargin * reach * curvature_towards(d, shape) < 1.0)) return false;
  for (int k = 0; k < shape.kink_count; ++k)
    if (kinks_[shape.first_kink + k].squared_distance(d) <= reach * reach) return false;
  return true;
}

bool Regularity::in_valley(const Vector3& d, const SurfacePoint& foot, double distance) const {
  constexpr double kFlat = 1e-6;
  const nurbs::SurfaceShape shape = nurbs::shape_near(surface_, *control_points_, foot);
  const double side = shape.normal.dot(d - shape.point) < 0.0 ? -1.0 : 1.0;
  const auto flat = [&](double curvature) { return std::abs(1.0 - side * distance * curvature) <= kFlat; };
  return flat(shape.curvature[0]) || flat(shape.curvature[1]);
}

// 0 if it bends away.
double Regularity::curvature_towards(const Vector3& d, const Shape& shape) const {
  constexpr double kClearly = 0.2;
  const Vector3 to_d = d - shape.centre;
  const double height = shape.normal.dot(to_d), clearly = kClearly * to_d.norm();
  if (height > clearly) return std::max(shape.greatest, 0.0);
  if (height < -clearly) return std::max(-shape.least, 0.0);
  return std::max(shape.greatest, -shape.least);
}

void Regularity::measure(int element, Shape& shape) const {
  const int p = surface_.patch_of_element(element);
  const Space<2>& space = surface_.patch(p);
  const int in_patch = element - surface_.first_element(p);
  const Indices<2> e = space.element_indices(in_patch);
  const nurbs::SurfaceShape centre =
      nurbs::shape_on_element(surface_, *control_points_, p, in_patch, space.element_centre(in_patch));
  shape.known = true;
  shape.centre = centre.point;
  shape.normal = centre.normal;
  shape.least = kInfinity, shape.greatest = -kInfinity;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      Parameter<2> xi;
      for (int k = 0; k < 2; ++k) {
        const double* knot = &space.knots(k).breaks()[e[k]];
        xi[k] = knot[0] + (knot[1] - knot[0]) * (k == 0 ? i : j) / (kSamples - 1.0);
      }
      const nurbs::SurfaceShape sample = nurbs::shape_on_element(surface_, *control_points_, p, in_patch, xi);
      if (!std::isfinite(sample.curvature[0])) continue;  // a pole: a kink, see below
      shape.least = std::min(shape.least, sample.curvature[0]);
      shape.greatest = std::max(shape.greatest, sample.curvature[1]);
    }
  shape.first_kink = static_cast<int>(kinks_.size());
  for (int side = 0; side < nurbs::kSideCount; ++side)
    if (!smooth_side(p, e, side)) kinks_.push_back(side_box(p, e, side));
  shape.kink_count = static_cast<int>(kinks_.size()) - shape.first_kink;
}

// A side that is a border or a C0 knot line has the first or last row of the element's control points.
Box Regularity::side_box(int patch, const Indices<2>& element, int side) const {
  const Space<2>& space = surface_.patch(patch);
  int indices[power(kMaxDegree + 1, 2)];
  space.element_control_points(space.element_index(element), indices);
  const int rows[2] = {space.degree(0) + 1, space.degree(1) + 1};
  const int i = side / 2, fixed = side % 2 == 1 ? rows[i] - 1 : 0;
  Box box{Vector3::Constant(kInfinity), Vector3::Constant(-kInfinity)};
  for (int along = 0; along < rows[1 - i]; ++along) {
    const int a = i == 0 ? fixed + rows[0] * along : along + rows[0] * fixed;
    const Vector3 point = surface_.control_points_of(patch, *control_points_).col(indices[a]);
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

// Whether the tangent plane goes on beyond a side of an element.
bool Regularity::smooth_side(int patch, const Indices<2>& element, int side) const {
  const Space<2>& space = surface_.patch(patch);
  const int i = side / 2;
  const bool upper = side % 2 == 1;
  const KnotVector& knots = space.knots(i);
  if (element[i] == (upper ? knots.element_count() - 1 : 0)) {
    const nurbs::Border& border = surface_.border(patch, side);
    return border.kind == nurbs::Border::welded && border.max_angle <= kFlush;
  }
  const double knot = knots.breaks()[element[i] + (upper ? 1 : 0)];
  if (!std::binary_search(knots.creases().begin(), knots.creases().end(), knot)) return true;

  Indices<2> beyond = element;
  beyond[i] += upper ? 1 : -1;
  const double* along = &space.knots(1 - i).breaks()[element[1 - i]];
  for (int k = 0; k < kSamples; ++k) {
    Parameter<2> xi;
    xi[i] = knot;
    xi[1 - i] = along[0] + (along[1] - along[0]) * k / (kSamples - 1.0);
    const auto normal = [&](const Indices<2>& e) {
      return nurbs::shape_on_element(surface_, *control_points_, patch, space.element_index(e), xi).normal;
    };
    const Vector3 here = normal(element), there = normal(beyond);
    if (!(here.dot(there) > 0.0 && here.cross(there).norm() <= kFlush)) return false;
  }
  return true;
}

}  // namespace search
