// SPDX-License-Identifier: GPL-2.0-or-later
// What meshes do under a point force, by the solid's own internal force.
#pragma once

#include <array>
#include <vector>

#include "models.h"
#include "nurbs/boundary.h"
#include "structure/compliance/smooth_seams.h"
#include "structure/solid/solid.h"
#include "structure/weld.h"

namespace point_force {

using models::NodalVectors;
using models::Vector3;
using nurbs::Volume;
using structure::Quadrature;
using structure::ReferenceBody;

constexpr double kNu = 0.286;

inline ReferenceBody body_of(const Volume& patch, double E = 1.0, Quadrature quadrature = Quadrature::full) {
  return {{patch}, {models::elastic(E, kNu)}, structure::without_welds({patch}), quadrature};
}
inline ReferenceBody block_body(const Vector3& size, const std::array<int, 3>& elements, int degree,
                                Quadrature quadrature = Quadrature::full) {
  return body_of(models::block(size, elements, degree), 1.0, quadrature);
}
inline const std::vector<structure::SkinPiece> kTop = {{0, nurbs::Face::zeta_plus}};

/// Nodal forces of a unit force along the normal of a piece, as it is met; their work on displacements is the
/// foot's own.
inline NodalVectors unit_force(const ReferenceBody& body, const nurbs::Parameter<2>& xi,
                               const structure::SkinPiece& piece = kTop[0]) {
  const structure::FaceSurface top(body, piece);
  const structure::SkinPoint foot =
      structure::SmoothSeams(body, {piece}).carried(top.at(top.space().element_at(xi), xi));
  NodalVectors load = NodalVectors::Zero(3, body.patches[0].control_points.cols());
  for (std::size_t a = 0; a < foot.R.size(); ++a) load.col(foot.nodes[a]) = foot.R[a] * foot.outward_normal;
  return load;
}

/// u of K u = load on what is `free` (1 or 0), by conjugate gradients down to `goal` of the load;
/// product(d, q): q = K d.
template <class Product>
NodalVectors solved(const NodalVectors& load, const NodalVectors& free, double goal, Product product) {
  NodalVectors r = load.cwiseProduct(free), u = 0.0 * r, d = r, q = r;
  const double least = goal * goal * r.squaredNorm();
  for (double rr = r.squaredNorm(); rr > least;) {
    product(d, q);
    q = q.cwiseProduct(free);
    const double step = rr / d.cwiseProduct(q).sum();
    u += step * d;
    r -= step * q;
    const double next = r.squaredNorm();
    d = r + next / rr * d;
    rr = next;
  }
  return u;
}

/// Displacements under nodal forces, the body held where `is_held(X)`.
template <class IsHeld>
NodalVectors displacements(const ReferenceBody& body, const NodalVectors& load, IsHeld is_held) {
  const Volume& patch = body.patches[0];
  const structure::Solid solid(patch, body.materials[0], {body.quadrature});
  NodalVectors free = NodalVectors::Zero(3, load.cols());
  for (int a = 0; a < solid.node_count(); ++a)
    if (!is_held(patch.control_points.col(a))) free.col(a).setOnes();
  return solved(load, free, 1e-10,
                [&](const NodalVectors& d, NodalVectors& q) { solid.internal_force(d, q); });
}

/// Normal displacement of the foot by a unit force there.
template <class IsHeld>
double mesh_compliance(const ReferenceBody& body, const nurbs::Parameter<2>& xi, IsHeld is_held,
                       const structure::SkinPiece& piece = kTop[0]) {
  const NodalVectors load = unit_force(body, xi, piece);
  return displacements(body, load, is_held).cwiseProduct(load).sum();
}

}  // namespace point_force
