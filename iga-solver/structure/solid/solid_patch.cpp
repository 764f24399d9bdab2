// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/solid_patch.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "nurbs/assert.h"
#include "structure/body.h"
#include "structure/solid/element_loop.h"
#include "structure/solid/enum_words.h"
#include "structure/sweep/affine_map.h"
#include "structure/sweep/patch_sweep.h"

namespace structure {

namespace {

/// Stored geometry of so many bytes stays in the cache, where it is read in less time than it is worked out
/// anew.
constexpr double kCachedTable = 1 << 20;

constexpr const char* kMasses[] = {"lumped", "corrected"};
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
  return enum_from_name<IntegrationMethod>("method", kMethods, word);
}

const char* name(TimeMass mass) { return kMasses[static_cast<int>(mass)]; }

TimeMass time_mass_from_name(const std::string& word) {
  return enum_from_name<TimeMass>("mass", kMasses, word);
}

SolidPatch::SolidPatch(const nurbs::Volume& volume, std::shared_ptr<const Material> material,
                       const Integration& integration, const Part& part, int patch, const NodalVectors& X)
    : space_(volume.space),
      material_(std::move(material)),
      integration_(integration),
      X_(X),
      boxes_(boxes_of(part, patch, space_)),
      border_boxes_(part.patches[patch].border),
      first_element_{0},
      functions_(space_.functions_per_element()),
      padded_(padded(functions_)),
      tabulate_(space_, integration.quadrature),
      tabulate_fully_(space_, Quadrature::full) {
  for (const PlacedBox& box : boxes_)
    first_element_.push_back(first_element_.back() + box.spans.element_count());
  choose_method(volume);
}

double SolidPatch::expected_bytes() const {
  double per_element = 2.0 * sizeof(double) * static_cast<double>(remembered());
  if (integration_.method == IntegrationMethod::stored) per_element += element_table_bytes();
  if (integration_.method == IntegrationMethod::elements)
    per_element += sizeof(double) * (3.0 * padded_ + 1.0) * tabulate_.slots();
  const bool has_bands = integration_.mass == TimeMass::corrected && !J_;
  return per_element * element_count() + (has_bands ? MassSweep::expected_bytes(space_, boxes_) : 0.0);
}

const MassSweep& SolidPatch::mass_sweep() const {
  if (!mass_sweep_)
    mass_sweep_ = std::make_unique<MassSweep>(space_, X_, boxes_, material_->density(), J_.has_value());
  return *mass_sweep_;
}

void SolidPatch::set_up(Eigen::VectorXd& row_sum_mass, ExactSum& volume) {
  add_mass(row_sum_mass, volume);
  if (integration_.method == IntegrationMethod::elements)
    integrals_ = std::make_unique<ElementLoop>(space_, X_, boxes_, *material_, integration_.quadrature);
  else
    integrals_ = std::make_unique<PatchSweep>(space_, X_, boxes_, *material_, integration_.quadrature,
                                              SweepGeometry{geometry_mode(integration_.method), J_});
}

std::size_t SolidPatch::remembered() const {
  return std::size_t(tabulate_.slots()) * material_->state_size();
}

/// Stored geometry of an element [bytes].
double SolidPatch::element_table_bytes() const {
  return sizeof(double) * table_numbers(space_.rational()) * double(tabulate_.slots());
}

/// By the whole patch, so that it is the same on any number of ranks.
void SolidPatch::choose_method(const nurbs::Volume& patch) {
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

/// Also looks for folds.
void SolidPatch::add_mass(Eigen::VectorXd& row_sum_mass, ExactSum& volume) const {
  if (!PatchSweep::can_sweep(space_)) return add_mass_of_elements(row_sum_mass, volume);
  const PatchSweep sweep(space_, X_, boxes_, *material_, Quadrature::full, {GeometryMode::recomputed});
  const PatchSweep::Volume own = sweep.add_row_sums(row_sum_mass, material_->density());
  volume.add(own.volume);
  if (own.least_det > 0.0) return;
  for (int e = 0; e < element_count(); ++e) one(e);  // throws at the fold, with its place
  throw std::invalid_argument(fmt::format(
      "the Jacobian determinant is {} at a quadrature point, expected more than 0", own.least_det));
}

void SolidPatch::add_mass_of_elements(Eigen::VectorXd& row_sum_mass, ExactSum& volume) const {
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(boxes_[b].columns.size());
    std::vector<int> local(boxes_[b].columns.size());
    std::iota(local.begin(), local.end(), 0);
    for (int e = first_element_[b]; e < first_element_[b + 1]; ++e) {
      const std::vector<int> nodes = element_columns(space_, boxes_[b].spans, local, spans_of(e));
      const std::vector<double>& mass = one(e).mass;
      for (int a = 0; a < functions_; ++a) share[nodes[a]] += mass[a];
      volume.add(std::accumulate(mass.begin(), mass.end(), 0.0) / material_->density());
    }
    for (std::size_t a = 0; a < local.size(); ++a) row_sum_mass[boxes_[b].write()[a]] += share[a];
  }
}

std::array<int, 3> SolidPatch::spans_of(int element) const {
  NURBS_ASSERT(0 <= element && element < element_count(), element, element_count());
  const std::size_t b = box_of(element);
  return boxes_[b].spans.span(element - first_element_[b]);
}

std::size_t SolidPatch::box_of(int element) const {
  return std::upper_bound(first_element_.begin(), first_element_.end(), element) - first_element_.begin() - 1;
}

/// Of its control points.
std::vector<int> SolidPatch::columns_of(int element) const {
  const PlacedBox& box = boxes_[box_of(element)];
  return element_columns(space_, box.spans, box.read(), spans_of(element));
}

const SolidPatch::OneElement& SolidPatch::one(int element) const {
  if (one_.element == element) return one_;
  one_.element = -1;  // until all is known
  const int in_patch = space_.element_index(spans_of(element));
  one_.columns = columns_of(element);
  tabulate_(in_patch, {X_, one_.columns}, one_.tables);
  one_.mass.assign(padded_, 0.0);
  tabulate_fully_.add_row_sums(in_patch, {X_, one_.columns}, one_.mass.data());
  for (double& mass : one_.mass) mass *= material_->density();
  one_.element = element;
  return one_;
}

std::string SolidPatch::describe_element(int element) const {
  const std::array<int, 3> spans = spans_of(element);
  const std::vector<int> columns = columns_of(element);
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(space_, space_.element_centre(space_.element_index(spans)), 0, basis);
  Vector3 centre = Vector3::Zero();
  for (int a = 0; a < basis.count; ++a) centre += basis.R[a] * X_.col(columns[a]);
  return fmt::format("spans {}, {}, {} of xi, eta, zeta, undeformed about {}", spans[0], spans[1], spans[2],
                     text(centre));
}

void SolidPatch::add_net_edges(std::vector<std::array<int, 2>>& edges) const {
  for (const PlacedBox& box : boxes_) {
    const std::vector<int>& columns = box.read();
    const std::array<int, 3> counts = box_node_counts(space_, box.spans);
    const int strides[3] = {1, counts[0], counts[0] * counts[1]};
    for (int node = 0; node < static_cast<int>(columns.size()); ++node)
      for (int d = 0; d < 3; ++d)
        if (node / strides[d] % counts[d] + 1 < counts[d])
          edges.push_back({columns[node], columns[node + strides[d]]});
  }
}

void SolidPatch::gather(int element, const NodalVectors& nodal, double* values) const {
  const std::vector<int>& columns = one(element).columns;
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < functions_; ++a) values[i * padded_ + a] = nodal(i, columns[a]);
    std::fill(values + i * padded_ + functions_, values + (i + 1) * padded_, 0.0);
  }
}

void SolidPatch::element_force(int element, const double* memory, const double* u, double* f) const {
  force_kernel(padded_)(*material_, one(element).tables.geometry(), {memory}, u, f);
}

Eigen::MatrixXd SolidPatch::element_mass_matrix(int element) const {
  const int in_patch = space_.element_index(spans_of(element));
  return material_->density() * tabulate_fully_.products(in_patch, {X_, columns_of(element)});
}

double SolidPatch::dissipated(int element, const double* memory) const {
  const ElementTables& tables = one(element).tables;
  double energy = 0.0;
  for (int q = 0; q < tables.points; ++q)
    energy += tables.wJ[q] * material_->dissipated_density(memory + tables.slot[q] * material_->state_size());
  return energy;
}

double SolidPatch::smallest_volume_ratio(int element, const double* u) const {
  return structure::smallest_volume_ratio(one(element).tables.geometry(), u);
}

int SolidPatch::element_at(const nurbs::Parameter<3>& xi) const {
  const std::array<int, 3> span = space_.element_indices(space_.element_at(xi));
  std::size_t b = 0;
  while (!boxes_[b].spans.holds(span)) ++b;
  return first_element_[b] + boxes_[b].spans.element(span);
}

Matrix3 SolidPatch::displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const {
  const std::vector<int> columns = columns_of(element_at(xi));
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(space_, xi, 1, basis);
  return parameter_gradient(basis, columns, u) * parameter_gradient(basis, columns, X_).inverse();
}

std::size_t SolidPatch::nearest_memory(int element, const nurbs::Parameter<3>& xi) const {
  return std::size_t(tabulate_.nearest_slot(spans_of(element), xi)) * material_->state_size();
}

}  // namespace structure
