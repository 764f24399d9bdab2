// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/mesh_estimate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace contact {

namespace {

/// From its area by the midpoint rule [length].
double size_of(const nurbs::Space<2>& space, int element, const nurbs::NodalVectors& control_points,
               int first) {
  const nurbs::Indices<2> at = space.element_indices(element);
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate_on_element(space, element, space.element_centre(element), 1, basis);
  Vector3 edges[2];
  for (int d = 0; d < 2; ++d) {
    edges[d].setZero();
    for (int a = 0; a < basis.count; ++a)
      edges[d] += basis.dR[d][a] * control_points.col(first + basis.control_point[a]);
    edges[d] *= space.knots(d).breaks()[at[d] + 1] - space.knots(d).breaks()[at[d]];
  }
  return std::sqrt(edges[0].cross(edges[1]).norm());
}

}  // namespace

std::unique_ptr<MeshEstimate> MeshEstimate::of(const coupling::StructureSolver& structure,
                                               const nurbs::NodalVectors& control_points) {
  const nurbs::MultiPatch& surface = structure.surface().topology;
  std::vector<coupling::MeshedSolid> solids;
  for (int p = 0; p < surface.patch_count(); ++p) {
    const std::optional<coupling::MeshedSolid> solid = structure.solid_below(p);
    if (!solid) return nullptr;
    solids.push_back(*solid);
  }
  if (solids.empty()) return nullptr;  // of faces
  return std::unique_ptr<MeshEstimate>(new MeshEstimate(surface, std::move(solids), control_points));
}

MeshEstimate::MeshEstimate(const nurbs::MultiPatch& surface, std::vector<coupling::MeshedSolid> solids,
                           const nurbs::NodalVectors& control_points)
    : surface_(surface), solids_(std::move(solids)) {
  for (int p = 0; p < surface.patch_count(); ++p)
    for (int e = 0; e < surface.patch(p).element_count(); ++e)
      size_.push_back(size_of(surface.patch(p), e, control_points, surface.first_control_point(p)));
  for (const double size : size_) area_ += size * size;
}

double MeshEstimate::missing(const Contact& contact, double hertz_constant) const {
  return missing(contact, hertz_constant, contact.overlap);
}

double MeshEstimate::missing_at_peak(const Contact& contact, double hertz_constant, double mass,
                                     double speed) const {
  return missing(contact, hertz_constant, depth(contact, hertz_constant, mass, speed));
}

double MeshEstimate::missing(const Contact& contact, double hertz_constant, double overlap) const {
  const double a = std::sqrt(contact.effective_radius * overlap), E_star = kOfModulus * hertz_constant;
  const double modulus = solids_[contact.foot.patch].plane_modulus;
  return std::max(0.0, kCorner * E_star * a / (modulus * size(contact.foot)));
}

double MeshEstimate::depth(const Contact& contact, double hertz_constant, double mass, double speed) {
  return std::pow(1.25 * mass * speed * speed / (hertz_constant * std::sqrt(contact.effective_radius)), 0.4);
}

double MeshEstimate::duration(const Contact& contact, double hertz_constant, double mass, double speed) {
  constexpr double kDuration = 2.943;
  return kDuration * depth(contact, hertz_constant, mass, speed) / speed;
}

double MeshEstimate::waves(const Contact& contact, double hertz_constant, double mass, double speed) const {
  constexpr double kLayers = 3.0;
  const double waves = kLayers * (size(contact.foot) / solids_[contact.foot.patch].shear_speed);
  return std::max(0.0, waves / duration(contact, hertz_constant, mass, speed));
}

double MeshEstimate::mass_near(const Contact& contact, double hertz_constant, double mass,
                               double speed) const {
  const coupling::MeshedSolid& solid = solids_[contact.foot.patch];
  const double reach = 0.5 * solid.shear_speed * duration(contact, hertz_constant, mass, speed),
               deep = std::min(reach, solid.mass / (solid.density * area_));
  return std::min(nurbs::kPi * solid.density * reach * deep * deep, solid.mass);
}

}  // namespace contact
