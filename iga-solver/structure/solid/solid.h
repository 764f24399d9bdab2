// SPDX-License-Identifier: GPL-2.0-or-later
// A deformable solid: one NURBS volume patch of one material, integrated with (p+1)^3 Gauss points per
// element. Source: Hughes, Cottrell & Bazilevs (2005); Gao & Feng (2019), eqs. 16-19.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "nurbs/patch.h"
#include "structure/body.h"
#include "structure/material/material.h"
#include "structure/solid/element_kernel.h"

namespace structure {

/// Matrix-free: no stiffness is assembled; dR/dX at every quadrature point is stored.  Reference kernel: one
/// plain loop over elements, in element order, so results are the same in every run.
class Solid final : public Body {
 public:
  /// The patch gives the reference configuration X.  Throws std::invalid_argument if the patch is not valid
  /// or if the Jacobian determinant of some element is not positive (a left-handed or folded patch).
  Solid(nurbs::Volume patch, std::shared_ptr<const Material> material);

  const nurbs::Volume& patch() const { return patch_; }
  /// H = du/dX [-] at a parameter point.
  Matrix3 displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;
  /// First Piola-Kirchhoff stress [stress] at a parameter point; the Cauchy stress while strains are small.
  /// A law with memory takes that of the nearest quadrature point.
  Matrix3 stress(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;

  int node_count() const override { return patch_.space.control_point_count(); }
  const NodalVectors& reference() const override { return patch_.control_points; }
  PatchSpaces patches() const override { return std::vector{patch_.space}; }
  /// Throws std::invalid_argument unless it is a face of patch 0.
  nurbs::BoundarySurface skin(const SkinPiece& piece) const override;
  double volume() const override;
  const Material& material() const override { return *material_; }
  const Eigen::VectorXd& row_sum_mass() const override { return row_sum_mass_; }

  void internal_force(const NodalVectors& u, NodalVectors& f) const override;
  void evolve(const NodalVectors& u, double dt, NodalVectors& f) override;
  void commit() override { memory_.swap(next_memory_); }
  const std::vector<double>& memory() const override { return memory_; }
  void set_memory(std::vector<double> memory) override;
  double strain_energy(const NodalVectors& u) const override;

  int element_count() const override { return patch_.space.element_count(); }
  int padded_functions() const override { return padded_; }
  void gather(int element, const NodalVectors& nodal, double* values) const override;
  void element_force(int element, const double* u, double* f) const override;
  const double* element_mass(int element) const override {
    return &element_mass_[std::size_t(element) * padded_];
  }
  double smallest_volume_ratio(int element, const double* u) const override;
  std::string describe_element(int element) const override;

 private:
  void integrate_element(int element);
  void integrate_point(int element, int point, const nurbs::Parameter<3>& xi, double weight);
  ElementGeometry geometry(int element) const;
  ElementMemory held_memory(int element) const;
  std::size_t nearest_point(const nurbs::Parameter<3>& xi) const;
  template <class ElementForce>
  void assemble(const NodalVectors& u, NodalVectors& f, ElementForce element_force) const;
  const int* element_nodes(int element) const { return &nodes_[std::size_t(element) * functions_]; }

  nurbs::Volume patch_;
  std::shared_ptr<const Material> material_;
  int functions_, padded_, points_;           // per element
  std::vector<int> nodes_;                    // [element][function]
  std::vector<double> dR_dX_;                 // [element][point][direction][padded]
  std::vector<double> wJ_;                    // [element][point]
  std::vector<double> element_mass_;          // [element][padded]
  std::size_t remembered_;                    // numbers per element
  std::vector<double> memory_, next_memory_;  // [element][point][Material::state_size()]
  Eigen::VectorXd row_sum_mass_;
  ForceKernel force_kernel_;
};

}  // namespace structure
