// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/patch_faces.h"

#include <Eigen/Geometry>
#include <array>
#include <utility>

#include "nurbs/refinement.h"

namespace brep {

namespace {

// The same surface in smaller elements: of large ones, as fillets have, more are near a point than it takes.
nurbs::Surface in_small_elements(nurbs::Surface patch) {
  constexpr int kLeast = 16;   // elements along each direction
  constexpr int kHighest = 3;  // degree at which a search in an element costs little
  if (std::max(patch.space.degree(0), patch.space.degree(1)) <= kHighest) return patch;
  for (int i = 0; i < 2; ++i)
    while (patch.space.knots(i).element_count() < kLeast) {
      const std::vector<double> breaks = patch.space.knots(i).breaks();
      std::vector<double> middles;
      for (size_t k = 0; k + 1 < breaks.size(); ++k) middles.push_back(0.5 * (breaks[k] + breaks[k + 1]));
      patch = nurbs::insert_knots(patch, i, middles);
    }
  return patch;
}

}  // namespace

PatchFaces::PatchFaces(const std::vector<nurbs::Surface>& patches, double edge_angle) {
  for (const nurbs::Surface& patch : patches) {
    nurbs::check_patch(patch);
    patches_.push_back(in_small_elements(patch));
  }
  for (const nurbs::Surface& patch : patches_) {
    const search::PatchPoints points(patch.control_points, 0, patch.space.control_point_count());
    projectors_.push_back(std::make_unique<search::SurfaceProjector>(patch.space, points));
    constexpr std::array<bool, nurbs::kSideCount> kGoesOn{true, true, true, true};  // edges have their say
    projectors_.back()->second_foot().begin_list(kGoesOn, edge_angle);
    hulls_.emplace_back();
    cones_.emplace_back();
    for (int e = 0; e < patch.space.element_count(); ++e) {
      cones_.back().push_back(cone_of(patch, e));
      hulls_.back().emplace_back(patch, e, cones_.back().back().axis);
    }
  }
}

Vector3 PatchFaces::point(int p, const Parameter<2>& xi) const {
  return nurbs::interpolate(patches_[p].space, patches_[p].control_points, xi);
}

nurbs::SurfaceShape PatchFaces::shape(int p, const Parameter<2>& xi) const {
  return nurbs::shape_near(patches_[p].space, patches_[p].control_points, xi);
}

Vector3 PatchFaces::tangent(int p, const Parameter<2>& xi, int i) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(patches_[p].space, xi, 1, basis);
  Vector3 tangent = Vector3::Zero();
  for (int a = 0; a < basis.count; ++a)
    tangent += basis.dR[i][a] * patches_[p].control_points.col(basis.control_point[a]);
  return tangent;
}

Vector3 PatchFaces::normal(int p, const Parameter<2>& xi) const {
  const Vector3 normal = tangent(p, xi, 0).cross(tangent(p, xi, 1));
  const double length = normal.norm();
  return length > 0.0 ? Vector3(normal / length) : shape(p, xi).normal;
}

// Normals at some points of it, and as much again: they change little within small elements.
PatchFaces::NormalCone PatchFaces::cone_of(const nurbs::Surface& patch, int element) {
  constexpr int kPoints = 4;  // steps along each direction
  constexpr double kAsMuchAgain = 2.0, kAny = 2.0;
  NormalCone cone{Vector3::Zero(), 0.0};
  const nurbs::Indices<2> e = patch.space.element_indices(element);
  std::vector<Vector3> normals;
  for (int i = 0; i <= kPoints; ++i)
    for (int j = 0; j <= kPoints; ++j) {
      const int step[2] = {i, j};
      Parameter<2> xi;
      for (int k = 0; k < 2; ++k) {
        const double* knot = &patch.space.knots(k).breaks()[e[k]];
        xi[k] = knot[0] + (knot[1] - knot[0]) * step[k] / kPoints;
      }
      normals.push_back(nurbs::shape_on_element(patch.space, patch.control_points, element, xi).normal);
      cone.axis += normals.back();
    }
  if (!cone.axis.allFinite() || cone.axis.norm() < 0.5) cone.sine = kAny;  // a pole is there
  cone.axis.normalize();
  for (const Vector3& normal : normals) {
    if (!(normal.dot(cone.axis) > 0.5)) cone.sine = kAny;
    cone.sine = std::max(cone.sine, kAsMuchAgain * normal.cross(cone.axis).norm());
  }
  return cone;
}

// A foot S of d has d - S along a normal, and S is in the hull.
bool PatchFaces::may_have_foot(int p, int element, const Vector3& d, double reach, int side) const {
  const ElementHull& hull = hulls_[p][element];
  if (hull.squared_distance(d) >= reach * reach) return false;
  const NormalCone& cone = cones_[p][element];
  if (!(cone.sine < 1.0)) return true;
  const Vector3 from = d - hull.centre();
  const double along = from.dot(cone.axis), most = hull.radius() + cone.sine * (from.norm() + hull.radius());
  if (side * along < -most) return false;
  return (from - along * cone.axis).norm() <= most;
}

// Where the surface is not curved much, downhill from the nearest element; else by branch and bound, which
// takes a hundred times as long on degrees such as those of fillets.
void PatchFaces::minima_on(int p, const std::vector<int>& elements, const Vector3& d, double reach,
                           std::vector<search::Foot>& feet) const {
  const auto is_calm = [&](int element) { return has_one_foot(p, element, d, reach); };
  const auto away = [&](int element) {
    const ElementHull& hull = hulls_[p][element];
    return hull.squared_distance(d) + (hull.centre() - d).squaredNorm();
  };
  const int nearest =
      *std::min_element(elements.begin(), elements.end(), [&](int a, int b) { return away(a) < away(b); });
  if (std::all_of(elements.begin(), elements.end(), is_calm)) {
    feet.assign(1, projectors_[p]->warm(d, patches_[p].space.element_centre(nearest)));
    // On a border it may have come to a seam, beyond which it would go on.
    if (feet[0].distance < reach && feet[0].status == FootStatus::interior) return;
  }
  projectors_[p]->all_minima_on(d, reach, elements.data(), static_cast<int>(elements.size()), feet);
}

bool PatchFaces::on_border(int p, const Parameter<2>& xi) const {
  for (int i = 0; i < 2; ++i) {
    const nurbs::KnotVector& knots = patches_[p].space.knots(i);
    if (xi[i] <= knots.front() || xi[i] >= knots.back()) return true;
  }
  return false;
}

}  // namespace brep
