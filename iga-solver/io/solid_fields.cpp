// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/solid_fields.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/unit_names.h"
#include "nurbs/assert.h"
#include "vtk/bezier_projection.h"

namespace io {

namespace {

using structure::Matrix3;
using structure::PointStress;

/// In VTK's order.
Eigen::VectorXd tensor_components(const PointStress& at) {
  const Matrix3& s = at.cauchy;
  return Eigen::Matrix<double, 6, 1>{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

/// The largest first.
Eigen::VectorXd principal_stresses(const PointStress& at) {
  return Eigen::SelfAdjointEigenSolver<Matrix3>(at.cauchy, Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

/// sqrt(3/2 s : s) of the deviator s.
Eigen::VectorXd von_mises_stress(const PointStress& at) {
  const Matrix3 deviator = at.cauchy - at.cauchy.trace() / 3.0 * Matrix3::Identity();
  return Eigen::VectorXd::Constant(1, std::sqrt(1.5) * deviator.norm());
}

Eigen::VectorXd energy_density(const PointStress& at) {
  return Eigen::VectorXd::Constant(1, at.energy_density);
}

/// One of the two is there: nodal values, or what is projected.
struct FieldRow {
  const char* word;
  int components;
  const char* UnitNames::*unit;
  nurbs::NodalVectors SolidState::*nodal;
  Eigen::VectorXd (*at_point)(const PointStress& at);
};
constexpr FieldRow kFields[] = {
    {"displacement", 3, &UnitNames::length, &SolidState::u, nullptr},
    {"velocity", 3, &UnitNames::velocity, &SolidState::v, nullptr},
    {"stress", 6, &UnitNames::stress, nullptr, tensor_components},
    {"principal_stress", 3, &UnitNames::stress, nullptr, principal_stresses},
    {"von_mises", 1, &UnitNames::stress, nullptr, von_mises_stress},
    {"energy_density", 1, &UnitNames::energy_density, nullptr, energy_density},
};

const FieldRow& row_of(const std::string& word) {
  const auto* const row = std::find_if(std::begin(kFields), std::end(kFields),
                                       [&](const FieldRow& field) { return field.word == word; });
  NURBS_ASSERT(row != std::end(kFields), word.size());
  return *row;
}

/// Elements of which a face is among these.
std::vector<int> elements_at(const nurbs::Space<3>& space, const std::vector<nurbs::Face>& faces) {
  std::vector<int> elements;
  for (int element = 0; element < space.element_count(); ++element) {
    const std::array<int, 3> span = space.element_indices(element);
    if (std::any_of(faces.begin(), faces.end(), [&](nurbs::Face face) {
          const int d = static_cast<int>(face) / 2;
          const bool upper = static_cast<int>(face) % 2 == 1;
          return span[d] == (upper ? space.knots(d).element_count() - 1 : 0);
        }))
      elements.push_back(element);
  }
  return elements;
}

}  // namespace

std::vector<std::string> field_words() {
  std::vector<std::string> words;
  for (const FieldRow& field : kFields) words.emplace_back(field.word);
  return words;
}

SolidFields::SolidFields(nurbs::Volume patch, std::shared_ptr<const structure::Material> material,
                         structure::Quadrature quadrature, geometry_io::Units units,
                         std::vector<std::string> words)
    : patch_(std::move(patch)),
      material_(std::move(material)),
      quadrature_(quadrature),
      units_(units),
      words_(std::move(words)) {}

vtk::PatchFields<3> SolidFields::at(const SolidState& state,
                                    const std::optional<std::vector<nurbs::Face>>& faces) const {
  vtk::PatchFields<3> fields{patch_, {}, {}};
  const UnitNames unit = unit_names(units_);
  for (const std::string& word : words_)
    if (const FieldRow& field = row_of(word); field.nodal)
      fields.control_points.push_back({word, state.*field.nodal, unit.*field.unit});
  std::vector<int> elements(patch_.space.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  fields.bezier_points = projected(state, faces ? elements_at(patch_.space, *faces) : elements);
  return fields;
}

std::vector<vtk::Field> SolidFields::projected(const SolidState& state,
                                               const std::vector<int>& elements) const {
  std::vector<const FieldRow*> rows;
  int components = 0;
  for (const std::string& word : words_)
    if (row_of(word).at_point) {
      rows.push_back(&row_of(word));
      components += rows.back()->components;
    }
  if (rows.empty()) return {};

  structure::GaussStresses stresses(patch_, *material_, quadrature_);
  vtk::BezierProjection projection(patch_.space, components);
  Eigen::MatrixXd values(components, patch_.space.functions_per_element());
  for (const int element : elements) {
    const std::vector<PointStress>& points = stresses.at(element, state.u, state.memory);
    for (std::size_t q = 0; q < points.size(); ++q) {
      int first = 0;
      for (const FieldRow* row : rows) {
        values.col(q).segment(first, row->components) = row->at_point(points[q]);
        first += row->components;
      }
    }
    projection.add(element, values);
  }

  const Eigen::MatrixXd coefficients = projection.coefficients();
  std::vector<vtk::Field> fields;
  int first = 0;
  for (const FieldRow* row : rows) {
    fields.push_back(
        {row->word, coefficients.middleRows(first, row->components), unit_names(units_).*row->unit});
    first += row->components;
  }
  return fields;
}

std::string SolidFields::units() const {
  const UnitNames unit = unit_names(units_);
  std::string text = fmt::format("{}: coordinates in {}, time in {}", geometry_io::units_name(units_),
                                 unit.length, unit.time);
  for (const std::string& word : words_) text += fmt::format(", {} in {}", word, unit.*row_of(word).unit);
  return text;
}

}  // namespace io
