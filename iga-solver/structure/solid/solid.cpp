// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/solid.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "nurbs/assert.h"
#include "nurbs/memory.h"
#include "structure/solid/element_loop.h"
#include "structure/sweep/affine_map.h"
#include "structure/sweep/patch_sweep.h"

namespace structure {

namespace {

/// Stored geometry of so many bytes stays in the cache, where it is read in less time than it is worked out
/// anew.
constexpr double kCachedTable = 1 << 20;

constexpr const char* kMethods[] = {"auto", "affine", "stored", "recomputed", "elements"};

GeometryMode geometry_mode(IntegrationMethod method) {
  return method == IntegrationMethod::affine   ? GeometryMode::affine
         : method == IntegrationMethod::stored ? GeometryMode::stored
                                               : GeometryMode::recomputed;
}

/// dX/dxi and du/dxi alike: J(i, d) = sum_A q_A,i dR_A/dxi_d.
Matrix3 parameter_gradient(const nurbs::RationalBasis<3>& basis, const std::vector<int>& columns,
                           const NodalVectors& q) {
  Matrix3 J = Matrix3::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 3; ++d) J.col(d) += basis.dR[d][a] * q.col(columns[a]);
  return J;
}

}  // namespace

const char* name(IntegrationMethod method) { return kMethods[static_cast<int>(method)]; }

IntegrationMethod integration_method_from_name(const std::string& word) {
  for (int i = 0; i < 5; ++i)
    if (word == kMethods[i]) return static_cast<IntegrationMethod>(i);
  throw std::invalid_argument(
      fmt::format("method is '{}', expected one of: {}", word, fmt::join(kMethods, ", ")));
}

Solid::Solid(nurbs::Volume patch, std::shared_ptr<const Material> material, const Integration& integration)
    : Solid(patch, std::move(material), integration, patch.space.control_point_count(),
            patch.space.element_count()) {
  boxes_ = whole_patch(space_);
  reference_ = std::move(patch.control_points);
  set_up();
}

Solid::Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material,
             const Integration& integration, const Part& part)
    : Solid(patch, std::move(material), integration, part.columns, part.elements.size()) {
  boxes_ = boxes_of(part, space_);
  border_boxes_ = part.border_boxes;
  reference_ = NodalVectors::Zero(3, part.columns);
  for (int column = 0; column < part.held(); ++column)
    reference_.col(column) = patch.control_points.col(part.nodes[column]);
  set_up();
}

Solid::Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material,
             const Integration& integration, int columns, std::size_t elements)
    : space_(patch.space),
      material_(std::move(material)),
      integration_(integration),
      first_element_{0},
      functions_(space_.functions_per_element()),
      padded_(padded(functions_)),
      tabulate_(space_, integration.quadrature),
      tabulate_fully_(space_, Quadrature::full),
      remembered_(std::size_t(tabulate_.slots()) * material_->state_size()) {
  nurbs::check_patch(patch);
  choose_method(patch);
  expect_memory(columns, elements);
}

void Solid::set_up() {
  for (const PlacedBox& box : boxes_)
    first_element_.push_back(first_element_.back() + box.spans.element_count());
  integrate_mass();
  if (integration_.method == IntegrationMethod::elements)
    integrals_ =
        std::make_unique<ElementLoop>(space_, reference_, boxes_, *material_, integration_.quadrature);
  else
    integrals_ = std::make_unique<PatchSweep>(space_, reference_, boxes_, *material_, integration_.quadrature,
                                              SweepGeometry{geometry_mode(integration_.method), J_});
  memory_.assign(element_count() * remembered_, 0.0);
  next_memory_ = memory_;
}

/// Stored geometry of an element [bytes].
double Solid::element_table_bytes() const {
  return sizeof(double) * table_numbers(space_.rational()) * double(tabulate_.slots());
}

/// Whether solid, and a solver for it, fit.
void Solid::expect_memory(int columns, std::size_t elements) const {
  constexpr double kBytesPerNode = 230.0;  // as measured by tests/benchmark/structure/large_solid
  const int points = tabulate_.slots();
  double per_element = 2.0 * sizeof(double) * static_cast<double>(remembered_);
  if (integration_.method == IntegrationMethod::stored) per_element += element_table_bytes();
  if (integration_.method == IntegrationMethod::elements)
    per_element += sizeof(double) * (3.0 * padded_ + 1.0) * points;
  nurbs::expect_memory(kBytesPerNode * columns + per_element * static_cast<double>(elements),
                       fmt::format("a solid of {} elements of degrees {}, {}, {}", elements, space_.degree(0),
                                   space_.degree(1), space_.degree(2)));
}

/// By the whole patch, so that it is the same on any number of ranks.
void Solid::choose_method(const nurbs::Volume& patch) {
  IntegrationMethod& method = integration_.method;
  const bool can_sweep = PatchSweep::can_sweep(space_);
  if (method == IntegrationMethod::automatic || method == IntegrationMethod::affine)
    J_ = affine_jacobian(patch);
  const double table = element_table_bytes() * static_cast<double>(space_.element_count());
  if (method == IntegrationMethod::automatic)
    method = !can_sweep              ? IntegrationMethod::elements
             : J_                    ? IntegrationMethod::affine
             : table <= kCachedTable ? IntegrationMethod::stored
                                     : IntegrationMethod::recomputed;
  if (method != IntegrationMethod::elements && !can_sweep)
    throw std::invalid_argument(
        fmt::format("Solid: method is '{}' and the degrees are {}, {}, {}, expected degrees {} to {} (or "
                    "'auto', 'elements')",
                    name(method), space_.degree(0), space_.degree(1), space_.degree(2), kLowestSweptDegree,
                    kHighestSweptDegree));
  if (method == IntegrationMethod::affine && !J_)
    throw std::invalid_argument(
        "Solid: method is 'affine', expected 'auto', 'stored' or 'recomputed': the Jacobian of the patch is "
        "not the same everywhere");
}

/// Row sums by full quadrature, which also looks for folds.
void Solid::integrate_mass() {
  row_sum_mass_ = Eigen::VectorXd::Zero(node_count());
  double least_det = -1.0;  // not known
  if (PatchSweep::can_sweep(space_)) {
    const PatchSweep sweep(space_, reference_, boxes_, *material_, Quadrature::full,
                           {GeometryMode::recomputed});
    const PatchSweep::Volume volume = sweep.add_row_sums(row_sum_mass_, material_->density());
    volume_ = volume.volume;
    least_det = volume.least_det;
  }
  // Degrees that are not swept, or a fold: found again, with its place.
  if (!(least_det > 0.0)) integrate_mass_of_elements();
}

void Solid::integrate_mass_of_elements() {
  row_sum_mass_.setZero();
  volume_ = ExactSum();
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(boxes_[b].columns.size());
    std::vector<int> local(boxes_[b].columns.size());
    std::iota(local.begin(), local.end(), 0);
    for (int e = first_element_[b]; e < first_element_[b + 1]; ++e) {
      const std::vector<int> nodes = element_columns(space_, boxes_[b].spans, local, spans_of(e));
      const std::vector<double>& mass = one(e).mass;
      for (int a = 0; a < functions_; ++a) share[nodes[a]] += mass[a];
      volume_.add(std::accumulate(mass.begin(), mass.end(), 0.0) / material_->density());
    }
    for (std::size_t a = 0; a < local.size(); ++a) row_sum_mass_[boxes_[b].write()[a]] += share[a];
  }
}

std::array<int, 3> Solid::spans_of(int element) const {
  NURBS_ASSERT(0 <= element && element < element_count(), element, element_count());
  const std::size_t b = box_of(element);
  return boxes_[b].spans.span(element - first_element_[b]);
}

std::size_t Solid::box_of(int element) const {
  return std::upper_bound(first_element_.begin(), first_element_.end(), element) - first_element_.begin() - 1;
}

const Solid::OneElement& Solid::one(int element) const {
  if (one_.element == element) return one_;
  one_.element = -1;  // until all is known
  const int in_patch = space_.element_index(spans_of(element));
  one_.columns = element_nodes(element);
  tabulate_(in_patch, {reference_, one_.columns}, one_.tables);
  one_.mass.assign(padded_, 0.0);
  tabulate_fully_.add_row_sums(in_patch, {reference_, one_.columns}, one_.mass.data());
  for (double& mass : one_.mass) mass *= material_->density();
  one_.element = element;
  return one_;
}

std::string Solid::discretisation() const {
  return integration_.quadrature == Quadrature::full ? "" : name(integration_.quadrature);
}

nurbs::BoundarySurface Solid::skin(const SkinPiece& piece) const {
  if (piece.patch != 0)
    throw std::invalid_argument(fmt::format("Solid: skin of patch {}, expected 0: it has one", piece.patch));
  return nurbs::boundary_surface(space_, piece.face);
}

std::string Solid::describe_element(int element) const {
  const std::array<int, 3> spans = spans_of(element);
  const std::vector<int> columns = element_nodes(element);
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(space_, space_.element_centre(space_.element_index(spans)), 0, basis);
  Vector3 centre = Vector3::Zero();
  for (int a = 0; a < basis.count; ++a) centre += basis.R[a] * reference_.col(columns[a]);
  return fmt::format("spans {}, {}, {} of xi, eta, zeta, undeformed about {}", spans[0], spans[1], spans[2],
                     text(centre));
}

std::vector<std::array<int, 2>> Solid::net_edges() const {
  std::vector<std::array<int, 2>> edges;
  for (const PlacedBox& box : boxes_) {
    const std::vector<int>& columns = box.read();
    const std::array<int, 3> counts = box_node_counts(space_, box.spans);
    const int strides[3] = {1, counts[0], counts[0] * counts[1]};
    for (int node = 0; node < static_cast<int>(columns.size()); ++node)
      for (int d = 0; d < 3; ++d)
        if (node / strides[d] % counts[d] + 1 < counts[d])
          edges.push_back({columns[node], columns[node + strides[d]]});
  }
  return edges;
}

void Solid::gather(int element, const NodalVectors& nodal, double* values) const {
  NURBS_ASSERT(nodal.cols() == node_count(), nodal.cols(), node_count());
  const std::vector<int>& columns = one(element).columns;
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < functions_; ++a) values[i * padded_ + a] = nodal(i, columns[a]);
    std::fill(values + i * padded_ + functions_, values + (i + 1) * padded_, 0.0);
  }
}

std::vector<int> Solid::element_nodes(int element) const {
  const PlacedBox& box = boxes_[box_of(element)];
  return element_columns(space_, box.spans, box.read(), spans_of(element));
}

void Solid::element_force(int element, const double* u, double* f) const {
  const double* const memory = memory_.data() + element * remembered_;
  force_kernel(padded_)(*material_, one(element).tables.geometry(), {memory}, u, f);
}

const double* Solid::element_mass(int element) const { return one(element).mass.data(); }

double Solid::smallest_volume_ratio(int element, const double* u) const {
  return structure::smallest_volume_ratio(one(element).tables.geometry(), u);
}

void Solid::internal_force(const NodalVectors& u, NodalVectors& f) const {
  NURBS_ASSERT(u.cols() == node_count() && f.cols() == node_count(), u.cols(), f.cols(), node_count());
  integrals_->internal_force({memory_.data()}, u, f);
}

void Solid::internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const {
  if (material_->is_linear()) return internal_force(w, f);
  NURBS_ASSERT(u.cols() == node_count() && w.cols() == node_count(), u.cols(), w.cols(), node_count());
  f.setZero();
  integrals_->add_force_changes({memory_.data()}, u, w, f);
}

void Solid::evolve(const NodalVectors& u, double dt, NodalVectors& f,
                   const std::function<void()>& shares_ready) {
  NURBS_ASSERT(u.cols() == node_count() && f.cols() == node_count(), u.cols(), f.cols(), node_count());
  PointMemory memory{memory_.data()};
  if (remembered_ > 0) memory = {memory_.data(), next_memory_.data(), dt};
  f.setZero();
  integrals_->add_forces(0, border_boxes_, memory, u, f);
  shares_ready();
  integrals_->add_forces(border_boxes_, integrals_->box_count(), memory, u, f);
}

ExactSum Solid::strain_energy_sum(const NodalVectors& u) const {
  ExactSum sum;
  integrals_->add_energies({memory_.data()}, u, sum);
  return sum;
}

void Solid::set_memory(std::vector<double> memory) {
  if (memory.size() != memory_.size())
    throw std::invalid_argument(
        fmt::format("Solid: memory of {} numbers, expected {}", memory.size(), memory_.size()));
  memory_ = std::move(memory);
}

int Solid::element_at(const nurbs::Parameter<3>& xi) const {
  const std::array<int, 3> span = space_.element_indices(space_.element_at(xi));
  std::size_t b = 0;
  while (!boxes_[b].spans.holds(span)) ++b;
  return first_element_[b] + boxes_[b].spans.element(span);
}

Matrix3 Solid::displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const {
  const std::vector<int> columns = element_nodes(element_at(xi));
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(space_, xi, 1, basis);
  return parameter_gradient(basis, columns, u) * parameter_gradient(basis, columns, reference_).inverse();
}

/// Where the quadrature point that is nearest in parameters has its memory.
std::size_t Solid::nearest_memory(const nurbs::Parameter<3>& xi) const {
  const int element = element_at(xi);
  const std::size_t slot = tabulate_.nearest_slot(spans_of(element), xi);
  return element * remembered_ + slot * material_->state_size();
}

Matrix3 Solid::stress(const NodalVectors& u, const nurbs::Parameter<3>& xi) const {
  return material_->stress(displacement_gradient(u, xi), memory_.data() + nearest_memory(xi));
}

}  // namespace structure
