// SPDX-License-Identifier: GPL-2.0-or-later
// One NURBS volume patch of a solid: its knots and weights, its material, and what integrates the boxes of it
// that a rank holds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nurbs/patch.h"
#include "structure/exact_sum.h"
#include "structure/material/material.h"
#include "structure/solid/box_grid.h"
#include "structure/solid/element_tables.h"
#include "structure/solid/integrals.h"
#include "structure/solid/skin_boxes.h"
#include "structure/sweep/mass_sweep.h"

namespace structure {

using nurbs::NodalVectors;

/// How integrals over a solid are worked out.
enum class IntegrationMethod {
  automatic,   ///< affine if the map is, else recomputed; elements for degrees that sweeps do not know
  affine,      ///< sweeps with one Jacobian for all points
  stored,      ///< sweeps with Jacobians from a table of 80 bytes per point (rational: 104)
  recomputed,  ///< sweeps that work Jacobians out anew
  elements     ///< the plain loop over elements, with a table of dR/dX: the reference
};
const char* name(IntegrationMethod method);
/// Throws std::invalid_argument, naming all words, for another one.
IntegrationMethod integration_method_from_name(const std::string& word);

/// The mass of explicit time (time/mass.h): row sums alone, or corrected by the consistent matrix.
enum class TimeMass { lumped, corrected };
const char* name(TimeMass mass);
/// Throws as above.
TimeMass time_mass_from_name(const std::string& word);

struct Integration {
  Quadrature quadrature = Quadrature::full;  ///< of forces and energies; masses are integrated fully
  IntegrationMethod method = IntegrationMethod::automatic;
  TimeMass mass = TimeMass::lumped;
};

/// Elements are counted box after box, those of a box with the first direction fastest.  Columns are those of
/// the body's nodal arrays.
class SolidPatch {
 public:
  /// `part`, `patch`: its boxes, and their columns.  `X`: undeformed positions of the body [length], which
  /// must live on.  Throws std::invalid_argument if the integration is not for it.
  SolidPatch(const nurbs::Volume& volume, std::shared_ptr<const Material> material,
             const Integration& integration, const Part& part, int patch, const NodalVectors& X);
  SolidPatch(const SolidPatch&) = delete;  // what integrates it refers to it
  SolidPatch& operator=(const SolidPatch&) = delete;

  /// What it will take [bytes], beside nodal arrays.
  double expected_bytes() const;
  /// Adds row sums of its mass matrix [mass] by full quadrature and its volume [length^3], then makes ready
  /// to integrate.  Throws std::invalid_argument if the Jacobian determinant of some element is not positive
  /// (a left-handed or folded patch).
  void set_up(Eigen::VectorXd& row_sum_mass, ExactSum& volume);

  const nurbs::Space<3>& space() const { return space_; }
  const Material& material() const { return *material_; }
  const Integration& integration() const { return integration_; }  ///< the method that was chosen
  const Integrals& integrals() const { return *integrals_; }
  /// Made in the first call.
  const MassSweep& mass_sweep() const;
  int border_boxes() const { return border_boxes_; }  ///< those with shares for others come first
  int element_count() const { return first_element_.back(); }
  /// Numbers that the points of an element remember.
  std::size_t remembered() const;

  /// Of its control points, the first direction fastest.
  std::vector<int> columns_of(int element) const;
  /// The element that holds xi, which must be of the part.
  int element_at(const nurbs::Parameter<3>& xi) const;
  /// Where the quadrature point that is nearest in parameters has its memory, among those of the element.
  std::size_t nearest_memory(int element, const nurbs::Parameter<3>& xi) const;
  /// H = du/dX [-].
  Matrix3 displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;

  // As in Body.
  int padded_functions() const { return padded_; }
  void gather(int element, const NodalVectors& nodal, double* values) const;
  void element_force(int element, const double* memory, const double* u, double* f) const;
  const double* element_mass(int element) const { return one(element).mass.data(); }
  /// By what its points remember [energy].
  double dissipated(int element, const double* memory) const;
  Eigen::MatrixXd element_mass_matrix(int element) const;
  double smallest_volume_ratio(int element, const double* u) const;
  std::string describe_element(int element) const;
  std::vector<SkinBox> skin_boxes(nurbs::Face face) const {
    return structure::skin_boxes(space_, face, boxes_);
  }
  void add_net_edges(std::vector<std::array<int, 2>>& edges) const;

 private:
  /// One element, worked out when it is asked for.
  struct OneElement {
    int element = -1;
    std::vector<int> columns;
    ElementTables tables;
    std::vector<double> mass;  // [padded]
  };
  const OneElement& one(int element) const;
  std::array<int, 3> spans_of(int element) const;
  std::size_t box_of(int element) const;
  void choose_method(const nurbs::Volume& patch);
  double element_table_bytes() const;
  void add_mass(Eigen::VectorXd& row_sum_mass, ExactSum& volume) const;
  void add_mass_of_elements(Eigen::VectorXd& row_sum_mass, ExactSum& volume) const;

  nurbs::Space<3> space_;
  std::shared_ptr<const Material> material_;
  Integration integration_;
  const NodalVectors& X_;
  std::optional<Matrix3> J_;  // of an affine map
  std::vector<PlacedBox> boxes_;
  int border_boxes_;
  std::vector<int> first_element_;  // of each box, and of one beyond
  int functions_, padded_;          // per element
  ElementTabulator tabulate_, tabulate_fully_;
  std::unique_ptr<const Integrals> integrals_;
  mutable std::unique_ptr<const MassSweep> mass_sweep_;
  mutable OneElement one_;
};

}  // namespace structure
