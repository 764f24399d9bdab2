// SPDX-License-Identifier: GPL-2.0-or-later
// What a meshed body makes of contacts after Hertz, estimated from the size of its elements: how much of the
// force is missing where the mesh's give is not taken off (compliance.h), and whether a contact is too short
// for a give that is static (iga-solver/structure/compliance/README.md has both).
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "coupling/contact/contact_model.h"
#include "coupling/structure_solver.h"

namespace contact {

class MeshEstimate {
 public:
  /// Of the surface as it is now; null unless the structure knows what is below all of it.
  static std::unique_ptr<MeshEstimate> of(const coupling::StructureSolver& structure,
                                          const nurbs::NodalVectors& control_points);

  /// 0.8 (E*/E') a/h, a = (r* overlap)^(1/2): the share of the force that is missing [-].  `hertz_constant`:
  /// ContactModel's, 4/3 E*; 0 if that is not a number, and without overlap.
  double missing(const Contact& contact, double hertz_constant) const;
  /// The same at the end of an impact's approach, overlap delta = (5 m V^2 / (4 K))^(2/5) (Johnson 1985, sec.
  /// 11.4) [-].
  double missing_at_peak(const Contact& contact, double hertz_constant, double mass, double speed) const;
  /// F r*/(E' h^3), squared: a surface that turns by an angle below a contact moves its foot by as many
  /// radii, and the force with it; elements bear that up to about one half (theory.md) [-].  With
  /// Contact::missing.
  double squared_turning(const Contact& contact, double hertz_constant) const {
    const double modulus = solids_[contact.foot.patch].plane_modulus,
                 a_over_h = contact.missing * modulus / (kCorner * kOfModulus * hertz_constant),
                 squared = a_over_h * a_over_h,
                 a2 = contact.effective_radius * std::max(contact.overlap, 0.0);
    const double of_force = contact.force.squaredNorm() * contact.effective_radius * contact.effective_radius;
    return a2 > 0.0 ? of_force * squared * squared * squared / (modulus * modulus * a2 * a2 * a2) : 0.0;
  }
  /// 3 h/c_s over the time that a sphere of this mass is in contact after an impact at a speed, 2.943 delta/V
  /// [-]; 0 if the constant is not a number.
  double waves(const Contact& contact, double hertz_constant, double mass, double speed) const;
  /// Of the body, what waves reach and come back from while that sphere is in contact: pi rho a min(a, T)^2
  /// within a = c_s t/2 [mass]; T: its thickness, from volume and area of the surface.
  double mass_near(const Contact& contact, double hertz_constant, double mass, double speed) const;
  /// h/c_s, how long a shear wave takes through that element [time].
  double delay(int patch, const nurbs::Indices<2>& element) const {
    const int number = surface_.first_element(patch) + surface_.patch(patch).element_index(element);
    return size_[number] / solids_[patch].shear_speed;
  }
  /// h: side of a square as large as the element that the foot is on [length].
  double size(const nurbs::SurfacePoint& foot) const { return size_[element(foot)]; }

 private:
  MeshEstimate(const nurbs::MultiPatch& surface, std::vector<coupling::MeshedSolid> solids,
               const nurbs::NodalVectors& control_points);
  double missing(const Contact& contact, double hertz_constant, double overlap) const;
  int element(const nurbs::SurfacePoint& foot) const {
    return surface_.first_element(foot.patch) + surface_.patch(foot.patch).element_at(foot.xi);
  }

  /// How deep that sphere comes [length], and how long it is in contact [time].
  static double depth(const Contact& contact, double hertz_constant, double mass, double speed);
  static double duration(const Contact& contact, double hertz_constant, double mass, double speed);

  static constexpr double kCorner = 0.8;      // of quadratic elements
  static constexpr double kOfModulus = 0.75;  // E* over the constant

  const nurbs::MultiPatch& surface_;
  std::vector<coupling::MeshedSolid> solids_;  // below each patch
  std::vector<double> size_;                   // of each element
  double area_ = 0.0;                          // of the surface
};

}  // namespace contact
