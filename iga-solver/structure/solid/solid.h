// SPDX-License-Identifier: GPL-2.0-or-later
// A deformable solid: one NURBS volume patch of one material.
// Source: Hughes, Cottrell & Bazilevs (2005); Gao & Feng (2019), eqs. 16-19.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nurbs/patch.h"
#include "structure/body.h"
#include "structure/material/material.h"
#include "structure/solid/box_grid.h"
#include "structure/solid/element_tables.h"
#include "structure/solid/integrals.h"

namespace structure {

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

struct Integration {
  Quadrature quadrature = Quadrature::full;  ///< of forces and energies; masses are integrated fully
  IntegrationMethod method = IntegrationMethod::automatic;
};

/// Matrix-free: no stiffness is assembled.  The same sums in the same order in every run.  Elements are
/// counted box after box (box_grid.h), those of a box with the first direction fastest.
class Solid final : public Body {
 public:
  /// The patch gives the reference configuration X.  Throws std::invalid_argument if the patch is not valid,
  /// if the Jacobian determinant of some element is not positive (a left-handed or folded patch), or if the
  /// integration is not for it.
  Solid(nurbs::Volume patch, std::shared_ptr<const Material> material, const Integration& integration = {});
  /// A part of it, cut at box_cuts: keeps the knots and weights of the patch, and its own control points.
  Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material, const Integration& integration,
        const Part& part);
  Solid(const Solid&) = delete;  // what integrates it refers to it
  Solid& operator=(const Solid&) = delete;

  const nurbs::Space<3>& space() const { return space_; }
  const Integration& integration() const { return integration_; }  ///< the method that was chosen
  double table_bytes() const { return integrals_->table_bytes(); }
  /// H = du/dX [-] at a parameter point.
  Matrix3 displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;
  /// First Piola-Kirchhoff stress [stress] at a parameter point; the Cauchy stress while strains are small.
  /// A law with memory takes that of the nearest quadrature point.
  Matrix3 stress(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;

  int node_count() const override { return static_cast<int>(reference_.cols()); }
  const NodalVectors& reference() const override { return reference_; }
  PatchSpaces patches() const override { return std::vector{space_}; }
  /// Throws std::invalid_argument unless it is a face of patch 0.
  nurbs::BoundarySurface skin(const SkinPiece& piece) const override;
  ExactSum volume_sum() const override { return volume_; }
  const Material& material() const override { return *material_; }
  std::string discretisation() const override;
  const Eigen::VectorXd& row_sum_mass() const override { return row_sum_mass_; }

  void internal_force(const NodalVectors& u, NodalVectors& f) const override;
  void internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const override;
  void evolve(
      const NodalVectors& u, double dt, NodalVectors& f,
      const std::function<void()>& shares_ready = [] {}) override;
  void commit() override { memory_.swap(next_memory_); }
  const std::vector<double>& memory() const override { return memory_; }
  void set_memory(std::vector<double> memory) override;
  ExactSum strain_energy_sum(const NodalVectors& u) const override;

  int element_count() const override { return first_element_.back(); }
  int padded_functions() const override { return padded_; }
  void gather(int element, const NodalVectors& nodal, double* values) const override;
  std::vector<int> element_nodes(int element) const override;
  void element_force(int element, const double* u, double* f) const override;
  const double* element_mass(int element) const override;
  double smallest_volume_ratio(int element, const double* u) const override;
  std::string describe_element(int element) const override;
  std::vector<std::array<int, 2>> net_edges() const override;

 private:
  /// Without boxes and control points yet.
  Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material, const Integration& integration,
        int columns, std::size_t elements);
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
  int element_at(const nurbs::Parameter<3>& xi) const;
  void set_up();
  void choose_method(const nurbs::Volume& patch);
  double element_table_bytes() const;
  void expect_memory(int columns, std::size_t elements) const;
  void integrate_mass();
  void integrate_mass_of_elements();
  std::size_t nearest_memory(const nurbs::Parameter<3>& xi) const;

  nurbs::Space<3> space_;  // of the whole patch
  NodalVectors reference_;
  std::shared_ptr<const Material> material_;
  Integration integration_;
  std::optional<Matrix3> J_;  // of an affine map
  std::vector<PlacedBox> boxes_;
  int border_boxes_ = 0;            // those with shares for others come first
  std::vector<int> first_element_;  // of each box, and of one beyond
  int functions_, padded_;          // per element
  ElementTabulator tabulate_, tabulate_fully_;
  std::unique_ptr<const Integrals> integrals_;
  std::size_t remembered_;                    // numbers per element
  std::vector<double> memory_, next_memory_;  // as PointMemory
  Eigen::VectorXd row_sum_mass_;
  ExactSum volume_;
  mutable OneElement one_;
};

}  // namespace structure
