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

// Whether elements share a side or a corner.
bool touch(const nurbs::Indices<2>& a, const nurbs::Indices<2>& b) {
  return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1;
}

// d S / d xi_i
std::array<Vector3, 2> tangents_of(const nurbs::Surface& patch, const Parameter<2>& xi) {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(patch.space, xi, 1, basis);
  std::array<Vector3, 2> tangents{Vector3::Zero(), Vector3::Zero()};
  for (int i = 0; i < 2; ++i)
    for (int a = 0; a < basis.count; ++a)
      tangents[i] += basis.dR[i][a] * patch.control_points.col(basis.control_point[a]);
  return tangents;
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
      Cones cones = cones_of(patch, e);
      const ElementHull& hull = hulls_.back().emplace_back(patch, e, cones.normal.axis);
      for (int i = 0; i < 2; ++i) cones.extent[i] = hull.extent(cones.tangent[i].axis);
      cones_.back().push_back(cones);
    }
  }
}

Vector3 PatchFaces::point(int p, const Parameter<2>& xi) const { return projectors_[p]->tangents(xi).point; }

nurbs::SurfaceShape PatchFaces::shape(int p, const Parameter<2>& xi) const {
  return nurbs::shape_near(patches_[p].space, patches_[p].control_points, xi);
}

Vector3 PatchFaces::tangent(int p, const Parameter<2>& xi, int i) const {
  return tangents_of(patches_[p], xi)[i];
}

Vector3 PatchFaces::normal(int p, const Parameter<2>& xi) const {
  constexpr double kClearly = 1e-6;  // beside a pole round-off would be what is left of a tangent
  const search::SurfaceProjector::Tangents at = projectors_[p]->tangents(xi);
  const Vector3 normal = at.along[0].cross(at.along[1]);
  const double length = normal.norm(), most = std::max(at.along[0].norm(), at.along[1].norm());
  return length > kClearly * most * most ? Vector3(normal / length) : shape(p, xi).normal;
}

// Those given are some of an element, so as much again: they change little within small elements.
PatchFaces::Cone PatchFaces::cone_around(const std::vector<Vector3>& directions) {
  constexpr double kAsMuchAgain = 2.0, kAny = 2.0;
  Cone cone{Vector3::Zero(), 0.0};
  for (const Vector3& direction : directions) cone.axis += direction;
  if (!cone.axis.allFinite() || cone.axis.norm() < 0.5) cone.sine = kAny;  // a pole is there
  cone.axis.normalize();
  for (const Vector3& direction : directions) {
    if (!(direction.dot(cone.axis) > 0.5)) cone.sine = kAny;
    cone.sine = std::max(cone.sine, kAsMuchAgain * direction.cross(cone.axis).norm());
  }
  return cone;
}

PatchFaces::Cones PatchFaces::cones_of(const nurbs::Surface& patch, int element) {
  constexpr int kPoints = 4;  // steps along each direction
  const nurbs::Indices<2> e = patch.space.element_indices(element);
  std::vector<Vector3> normals, tangents[2];
  for (int i = 0; i <= kPoints; ++i)
    for (int j = 0; j <= kPoints; ++j) {
      const int step[2] = {i, j};
      Parameter<2> xi;
      for (int k = 0; k < 2; ++k) {
        const double* knot = &patch.space.knots(k).breaks()[e[k]];
        xi[k] = knot[0] + (knot[1] - knot[0]) * step[k] / kPoints;
      }
      normals.push_back(nurbs::shape_on_element(patch.space, patch.control_points, element, xi).normal);
      const auto at = tangents_of(patch, xi);
      for (int k = 0; k < 2; ++k) tangents[k].push_back(at[k].normalized());
    }
  return {cone_around(normals), {cone_around(tangents[0]), cone_around(tangents[1])}, {}};
}

// A foot S of d, nearer than reach, is in the hull; d - S is along a normal, and square to all tangents.
bool PatchFaces::may_have_foot(int p, int element, const Vector3& d, double reach, int side,
                               double margin) const {
  const ElementHull& hull = hulls_[p][element];
  if (hull.squared_distance(d) >= reach * reach) return false;
  const Cones& cones = cones_[p][element];
  const Vector3 from = d - hull.centre();
  for (int i = 0; i < 2; ++i) {
    const Cone& cone = cones.tangent[i];
    if (!(cone.sine < 1.0)) continue;
    const double beyond = std::abs(from.dot(cone.axis)) - cones.extent[i] - margin;
    if (beyond > 0.0 &&
        beyond * beyond * (1.0 - cone.sine * cone.sine) > cone.sine * cone.sine * reach * reach)
      return false;
  }
  const Cone& cone = cones.normal;
  if (!(cone.sine < 1.0)) return true;
  const double along = from.dot(cone.axis), most = hull.radius() + cone.sine * reach + margin;
  if (side * along < -most) return false;
  return (from - along * cone.axis).norm() <= most;
}

// Where the surface is not curved much, downhill from the nearest element; else by branch and bound, which
// takes a hundred times as long on degrees such as those of fillets.
void PatchFaces::minima_on(int p, const std::vector<int>& elements, const Vector3& d, double reach,
                           std::vector<search::Foot>& feet) const {
  feet.clear();
  if (!follow_downhill(p, elements, d, reach, feet))
    projectors_[p]->all_minima_on(d, reach, elements.data(), static_cast<int>(elements.size()), feet);
}

// False if the distance may have several minima.  It has one at most where elements hang together and
// curvatures are half of what would be too much, so that it is convex, up to twice the reach.  Not if going
// downhill ends on a border, and goes on beyond: at a seam, where elements hang together the other way round.
bool PatchFaces::follow_downhill(int p, const std::vector<int>& elements, const Vector3& d, double reach,
                                 std::vector<search::Foot>& feet) const {
  const auto is_calm = [&](int element) { return has_one_foot(p, element, d, reach); };
  if (!std::all_of(elements.begin(), elements.end(), is_calm) || !hang_together(p, elements)) return false;
  const auto away = [&](int element) { return hulls_[p][element].squared_distance(d); };
  const int nearest =
      *std::min_element(elements.begin(), elements.end(), [&](int a, int b) { return away(a) < away(b); });
  const Parameter<2> start = below(p, nearest, d);
  if ((point(p, start) - d).squaredNorm() > 4.0 * reach * reach) return false;
  const search::Foot foot = projectors_[p]->warm(d, start);
  if (on_border(p, foot.xi) && !is_lowest_of(p, elements, d, foot)) return false;
  if (foot.distance < reach) feet.push_back(foot);
  return true;
}

// About where the foot of d would be if the element were plane.
Parameter<2> PatchFaces::below(int p, int element, const Vector3& d) const {
  Parameter<2> xi = patches_[p].space.element_centre(element);
  const nurbs::Indices<2> e = patches_[p].space.element_indices(element);
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& breaks = patches_[p].space.knots(i).breaks();
    const Cones& cones = cones_[p][element];
    const double along = cones.tangent[i].axis.dot(d - hulls_[p][element].centre()) / cones.extent[i];
    if (std::isfinite(along)) xi[i] += 0.5 * (breaks[e[i] + 1] - breaks[e[i]]) * std::clamp(along, -1.0, 1.0);
  }
  return xi;
}

// Whether a point of the border is lower than all elements: those that are nearer are beside it, and no way
// round leads back to d.
bool PatchFaces::is_lowest_of(int p, const std::vector<int>& elements, const Vector3& d,
                              const search::Foot& border) const {
  const nurbs::Space<2>& space = patches_[p].space;
  const nurbs::Indices<2> own = space.element_indices(space.element_at(border.xi));
  return is_shallow(p, elements) && std::all_of(elements.begin(), elements.end(), [&](int e) {
           return touch(own, space.element_indices(e)) || !may_have_foot(p, e, d, border.distance, 0);
         });
}

// Whether elements that hang together turn by so little, all of them, that they are over a plane.
bool PatchFaces::is_shallow(int p, const std::vector<int>& elements) const {
  constexpr double kLittle = 0.5;  // cosine
  const Vector3& up = cones_[p][elements.front()].normal.axis;
  return std::all_of(elements.begin(), elements.end(), [&](int e) {
    const Cones& cones = cones_[p][e];
    return cones.normal.sine < 1.0 && cones.tangent[0].sine < 1.0 && cones.tangent[1].sine < 1.0 &&
           cones.normal.axis.dot(up) > kLittle;
  });
}

// By sides and corners, one after the other; elements are few.
bool PatchFaces::hang_together(int p, const std::vector<int>& elements) const {
  thread_local std::vector<nurbs::Indices<2>> left;
  left.clear();
  for (const int element : elements) left.push_back(patches_[p].space.element_indices(element));
  auto reached = left.begin() + 1;  // those before it hang together
  for (auto from = left.begin(); from != reached; ++from)
    reached = std::partition(reached, left.end(), [&](const auto& e) { return touch(*from, e); });
  return reached == left.end();
}

bool PatchFaces::on_border(int p, const Parameter<2>& xi) const {
  for (int i = 0; i < 2; ++i) {
    const nurbs::KnotVector& knots = patches_[p].space.knots(i);
    if (xi[i] <= knots.front() || xi[i] >= knots.back()) return true;
  }
  return false;
}

}  // namespace brep
