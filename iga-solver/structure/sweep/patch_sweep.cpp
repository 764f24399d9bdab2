// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/patch_sweep.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/assert.h"

namespace structure {

bool PatchSweep::can_sweep(const nurbs::Space<3>& space) {
  for (int d = 0; d < 3; ++d)
    if (space.degree(d) < kLowestSweptDegree || space.degree(d) > kHighestSweptDegree) return false;
  return true;
}

PatchSweep::PatchSweep(const nurbs::Space<3>& space, const NodalVectors& X,
                       const std::vector<PlacedBox>& boxes, const Material& material, Quadrature quadrature,
                       const SweepGeometry& geometry, nurbs::SimdLevel level)
    : X_(X), law_{0, nullptr, outside_law(material), {}} {
  const LawCall call = law_call(material);
  law_.loop = call.loop;
  law_.inlined = call.law;
  SweepPlan plan{{}, geometry, level, material.state_size()};
  for (int d = 0; d < 3; ++d) plan.rules[d] = rules_of(space.knots(d), quadrature);
  if (geometry.mode == GeometryMode::affine && !geometry.J)
    throw std::invalid_argument("PatchSweep: geometry is 'affine', and the patch's map is not");
  std::size_t first_element = 0;
  for (const PlacedBox& box : boxes) {
    boxes_.emplace_back(space, box, first_element, plan);
    first_element += box.spans.element_count();
    boxes_.back().reserve(space_);
  }
  if (geometry.mode == GeometryMode::stored)
    for (BoxSweep& box : boxes_) box.tabulate(X_, space_);
}

BoxSweep::LawAtPoints PatchSweep::law_with(const PointMemory& memory) const {
  BoxSweep::LawAtPoints law = law_;
  law.memory = memory;
  return law;
}

void PatchSweep::add_forces(int first, int end, const PointMemory& memory, const NodalVectors& u,
                            NodalVectors& f) const {
  const BoxSweep::LawAtPoints law = law_with(memory);
  for (int b = first; b < end; ++b) boxes_[b].add_forces(law, X_, u, f, space_);
}

void PatchSweep::add_force_changes(const PointMemory& memory, const NodalVectors& u, const NodalVectors& w,
                                   NodalVectors& f) const {
  const BoxSweep::LawAtPoints law = law_with(memory);
  for (const BoxSweep& box : boxes_) box.add_force_changes(law, X_, u, w, f, space_);
}

void PatchSweep::add_energies(const PointMemory& memory, const NodalVectors& u, ExactSum& sum) const {
  const BoxSweep::LawAtPoints law = law_with(memory);
  for (const BoxSweep& box : boxes_) sum.add(box.energy(law, X_, u, space_));
}

PatchSweep::Volume PatchSweep::add_row_sums(Eigen::VectorXd& sums, double density) const {
  Volume volume{{}, std::numeric_limits<double>::infinity()};
  for (const BoxSweep& box : boxes_) {
    const PointSums own = box.add_row_sums(X_, density, sums, space_);
    volume.volume.add(own.sum);
    volume.least_det = std::isnan(own.least_det) ? own.least_det : std::min(volume.least_det, own.least_det);
  }
  return volume;
}

double PatchSweep::table_bytes() const {
  double bytes = 0.0;
  for (const BoxSweep& box : boxes_) bytes += box.table_bytes();
  return bytes;
}

}  // namespace structure
