// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/gauss_stresses.h"

#include "nurbs/gauss_legendre.h"

namespace structure {

GaussStresses::GaussStresses(const nurbs::Volume& patch, const Material& material, Quadrature quadrature)
    : patch_(patch),
      material_(material),
      at_gauss_points_(patch.space, Quadrature::full),
      at_quadrature_(patch.space, quadrature),
      boxes_(box_grid(patch.space)),
      first_id_{0} {
  for (const SpanBox& box : boxes_) first_id_.push_back(first_id_.back() + box.element_count());
}

const std::vector<PointStress>& GaussStresses::at(int element, const nurbs::NodalVectors& u,
                                                  const std::vector<double>& memory) {
  std::vector<int> nodes(patch_.space.functions_per_element());
  patch_.space.element_control_points(element, nodes.data());
  at_gauss_points_(element, {patch_.control_points, nodes}, tables_);
  points_.resize(tables_.points);
  for (int q = 0; q < tables_.points; ++q) {
    const double* const dR_dX = &tables_.dR_dX[std::size_t(q) * 3 * tables_.padded];
    Matrix3 H = Matrix3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < 3; ++d) H.col(d) += dR_dX[d * tables_.padded + a] * u.col(nodes[a]);
    const double* const state = memory.empty() ? nullptr : &memory[memory_of(element, q)];
    points_[q] = {material_.cauchy_stress(H, state), material_.energy_density(H, state)};
  }
  return points_;
}

std::size_t GaussStresses::element_id(const std::array<int, 3>& span) const {
  std::size_t b = 0;
  while (!boxes_[b].holds(span)) ++b;
  return first_id_[b] + boxes_[b].element(span);
}

/// Where the memory of the point of the quadrature begins that is nearest to a Gauss point.
std::size_t GaussStresses::memory_of(int element, int point) const {
  const std::array<int, 3> span = patch_.space.element_indices(element);
  nurbs::Parameter<3> xi;
  for (int d = 0; d < 3; ++d) {
    const int n = patch_.space.degree(d) + 1;
    const std::vector<double>& breaks = patch_.space.knots(d).breaks();
    xi[d] = nurbs::gauss_legendre(n, breaks[span[d]], breaks[span[d] + 1]).points[point % n];
    point /= n;
  }
  const std::size_t slot = at_quadrature_.nearest_slot(span, xi);
  return (element_id(span) * at_quadrature_.slots() + slot) * material_.state_size();
}

}  // namespace structure
