// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "nurbs/assert.h"
#include "nurbs/memory.h"

namespace structure {

namespace {

NodeNumbering own_nodes(const nurbs::Volume& patch) {
  return NodeNumbering({patch.space.control_point_count()});
}

}  // namespace

Solid::Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material,
             const Integration& integration)
    : Solid(patch, std::move(material), integration, whole_part(patch.space)) {}

Solid::Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material,
             const Integration& integration, const Part& part)
    : Solid({{patch, std::move(material)}}, own_nodes(patch), integration, part) {}

Solid::Solid(const std::vector<MaterialPatch>& patches, const NodeNumbering& nodes,
             const Integration& integration, const Part& part)
    : nodes_(nodes), first_element_{0} {
  for (const MaterialPatch& patch : patches) nurbs::check_patch(patch.volume);
  take_reference(patches, part);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    patches_.push_back(std::make_unique<SolidPatch>(patches[p].volume, patches[p].material, integration, part,
                                                    static_cast<int>(p), reference_));
    first_element_.push_back(first_element_.back() + patches_.back()->element_count());
  }
  expect_equal_memories();
  expect_memory();
  row_sum_mass_ = Eigen::VectorXd::Zero(node_count());
  for (std::size_t p = 0; p < patches_.size(); ++p) try {
      patches_[p]->set_up(row_sum_mass_, volume_);
    } catch (const std::invalid_argument& error) {
      if (patches_.size() == 1) throw;
      throw std::invalid_argument(fmt::format("patch {}: {}", p, error.what()));
    }
  memory_.assign(element_count() * remembered_, 0.0);
  next_memory_ = memory_;
}

void Solid::take_reference(const std::vector<MaterialPatch>& patches, const Part& part) {
  reference_ = NodalVectors::Zero(3, part.columns);
  for (int column = 0; column < part.held(); ++column) {
    const auto [patch, control_point] = nodes_.place(part.nodes[column]);
    reference_.col(column) = patches[patch].volume.control_points.col(control_point);
  }
}

void Solid::expect_equal_memories() {
  remembered_ = patches_.front()->remembered();
  for (const auto& patch : patches_)
    if (patch->remembered() != remembered_)
      throw std::invalid_argument(fmt::format(
          "Solid: elements of its patches remember {} and {} numbers, expected equally many: laws with "
          "memory need the same law and degrees in all patches, and 'quadrature: full' where some are one "
          "element thick and others are not",
          remembered_, patch->remembered()));
}

/// Whether solid, and a solver for it, fit.
void Solid::expect_memory() const {
  constexpr double kBytesPerNode = 230.0;  // as measured by tests/benchmark/structure/large_solid
  constexpr double kOfCorrectedMass = 3 * 3 * sizeof(double);  // its bound, predictions and products
  double bytes = (kBytesPerNode + (corrects_mass() ? kOfCorrectedMass : 0.0)) * node_count();
  for (const auto& patch : patches_) bytes += patch->expected_bytes();
  const nurbs::Space<3>& space = patches_.front()->space();
  nurbs::expect_memory(bytes, fmt::format("a solid of {} elements of degrees {}, {}, {}", element_count(),
                                          space.degree(0), space.degree(1), space.degree(2)));
}

Solid::PatchElement Solid::of(int element) const {
  NURBS_ASSERT(0 <= element && element < element_count(), element, element_count());
  const auto next = std::upper_bound(first_element_.begin(), first_element_.end(), element);
  const auto p = next - first_element_.begin() - 1;
  return {*patches_[p], element - first_element_[p]};
}

double Solid::table_bytes() const {
  double bytes = 0.0;
  for (const auto& patch : patches_) bytes += patch->integrals().table_bytes();
  return bytes;
}

PatchSpaces Solid::patches() const {
  std::vector<nurbs::Space<3>> spaces;
  for (const auto& patch : patches_) spaces.push_back(patch->space());
  return spaces;
}

std::vector<const Material*> Solid::materials() const {
  std::vector<const Material*> materials;
  for (const auto& patch : patches_) materials.push_back(&patch->material());
  return materials;
}

std::string Solid::discretisation() const {
  const Quadrature quadrature = integration().quadrature;
  return quadrature == Quadrature::full ? "" : name(quadrature);
}

nurbs::BoundarySurface Solid::skin(const SkinPiece& piece) const {
  if (piece.patch < 0 || piece.patch >= static_cast<int>(patches_.size()))
    throw std::invalid_argument(
        fmt::format("Solid: skin of patch {}, expected 0 to {}", piece.patch, patches_.size() - 1));
  nurbs::BoundarySurface face = nurbs::boundary_surface(space(piece.patch), piece.face);
  for (int& point : face.volume_control_point) point = static_cast<int>(nodes_.node(piece.patch, point));
  return face;
}

std::string Solid::describe_element(int element) const {
  const PatchElement at = of(element);
  const std::string words = at.patch.describe_element(at.element);
  const auto is_it = [&](const auto& patch) { return patch.get() == &at.patch; };
  const auto p = std::find_if(patches_.begin(), patches_.end(), is_it) - patches_.begin();
  return patches_.size() == 1 ? words : fmt::format("patch {}, {}", p, words);
}

std::vector<std::array<int, 2>> Solid::net_edges() const {
  std::vector<std::array<int, 2>> edges;
  for (const auto& patch : patches_) patch->add_net_edges(edges);
  return edges;
}

void Solid::gather(int element, const NodalVectors& nodal, double* values) const {
  NURBS_ASSERT(nodal.cols() == node_count(), nodal.cols(), node_count());
  const PatchElement at = of(element);
  at.patch.gather(at.element, nodal, values);
}

std::vector<int> Solid::element_nodes(int element) const {
  const PatchElement at = of(element);
  return at.patch.columns_of(at.element);
}

void Solid::element_force(int element, const double* u, double* f) const {
  const PatchElement at = of(element);
  at.patch.element_force(at.element, memory_.data() + element * remembered_, u, f);
}

const double* Solid::element_mass(int element) const {
  const PatchElement at = of(element);
  return at.patch.element_mass(at.element);
}

Eigen::MatrixXd Solid::element_mass_matrix(int element) const {
  const PatchElement at = of(element);
  return at.patch.element_mass_matrix(at.element);
}

double Solid::smallest_volume_ratio(int element, const double* u) const {
  const PatchElement at = of(element);
  return at.patch.smallest_volume_ratio(at.element, u);
}

PointMemory Solid::held(std::size_t patch) const {
  return {memory_.data() + first_element_[patch] * remembered_};
}

PointMemory Solid::evolving(std::size_t patch, double dt) {
  PointMemory memory = held(patch);
  if (remembered_ > 0) memory = {memory.held, next_memory_.data() + first_element_[patch] * remembered_, dt};
  return memory;
}

void Solid::internal_force(const NodalVectors& u, NodalVectors& f) const {
  NURBS_ASSERT(u.cols() == node_count() && f.cols() == node_count(), u.cols(), f.cols(), node_count());
  f.setZero();
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const int border = patches_[p]->border_boxes();
    patches_[p]->integrals().add_forces(0, border, held(p), u, f);
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Integrals& integrals = patches_[p]->integrals();
    integrals.add_forces(patches_[p]->border_boxes(), integrals.box_count(), held(p), u, f);
  }
}

void Solid::internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const {
  NURBS_ASSERT(u.cols() == node_count() && w.cols() == node_count(), u.cols(), w.cols(), node_count());
  f.setZero();
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Integrals& integrals = patches_[p]->integrals();
    if (patches_[p]->material().is_linear())
      integrals.add_forces(0, integrals.box_count(), held(p), w, f);
    else
      integrals.add_force_changes(held(p), u, w, f);
  }
}

void Solid::evolve(const NodalVectors& u, double dt, NodalVectors& f,
                   const std::function<void()>& shares_ready) {
  NURBS_ASSERT(u.cols() == node_count() && f.cols() == node_count(), u.cols(), f.cols(), node_count());
  f.setZero();
  for (std::size_t p = 0; p < patches_.size(); ++p)
    patches_[p]->integrals().add_forces(0, patches_[p]->border_boxes(), evolving(p, dt), u, f);
  shares_ready();
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Integrals& integrals = patches_[p]->integrals();
    integrals.add_forces(patches_[p]->border_boxes(), integrals.box_count(), evolving(p, dt), u, f);
  }
}

void Solid::mass_product(const NodalVectors& a, NodalVectors& f,
                         const std::function<void()>& shares_ready) const {
  NURBS_ASSERT(a.cols() == node_count() && f.cols() == node_count(), a.cols(), f.cols(), node_count());
  f.setZero();
  for (const auto& patch : patches_) patch->mass_sweep().add_products(0, patch->border_boxes(), a, f);
  shares_ready();
  for (const auto& patch : patches_) {
    const MassSweep& sweep = patch->mass_sweep();
    sweep.add_products(patch->border_boxes(), sweep.box_count(), a, f);
  }
}

ExactSum Solid::strain_energy_sum(const NodalVectors& u) const {
  ExactSum sum;
  for (std::size_t p = 0; p < patches_.size(); ++p) patches_[p]->integrals().add_energies(held(p), u, sum);
  return sum;
}

ExactSum Solid::dissipated_sum() const {
  ExactSum sum;
  for (int e = 0; remembered_ > 0 && e < element_count(); ++e) {
    const PatchElement at = of(e);
    sum.add(at.patch.dissipated(at.element, memory_.data() + e * remembered_));
  }
  return sum;
}

void Solid::set_memory(std::vector<double> memory) {
  if (memory.size() != memory_.size())
    throw std::invalid_argument(
        fmt::format("Solid: memory of {} numbers, expected {}", memory.size(), memory_.size()));
  memory_ = std::move(memory);
}

Matrix3 Solid::stress(const NodalVectors& u, const nurbs::Parameter<3>& xi, int patch) const {
  const SolidPatch& of = *patches_[patch];
  const int element = of.element_at(xi);
  const double* const memory = memory_.data() + (first_element_[patch] + element) * remembered_;
  return of.material().stress(of.displacement_gradient(u, xi), memory + of.nearest_memory(element, xi));
}

}  // namespace structure
