// SPDX-License-Identifier: GPL-2.0-or-later
// A deformable solid: one NURBS volume patch of one material, integrated with (p+1)^3 Gauss points per
// element. Source: Hughes, Cottrell & Bazilevs (2005); Gao & Feng (2019), eqs. 16-19.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "nurbs/patch.h"
#include "structure/material/material.h"
#include "structure/solid/element_kernel.h"

namespace structure {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// Matrix-free: no stiffness is assembled; dR/dX at every quadrature point is stored.  Reference kernel: one
/// plain loop over elements, in element order, so results are the same in every run.
class Solid {
 public:
  /// The patch gives the reference configuration X.  Throws std::invalid_argument if the patch is not valid
  /// or if the Jacobian determinant of some element is not positive (a left-handed or folded patch).
  Solid(nurbs::Volume patch, std::shared_ptr<const Material> material);

  const nurbs::Volume& patch() const { return patch_; }
  const Material& material() const { return *material_; }
  int node_count() const { return patch_.space.control_point_count(); }
  double volume() const;  ///< [length^3]

  /// f = internal forces [force] of the displacements u [length], both 3 x node_count, f sized by the caller:
  /// equilibrium is f = external forces.  What points remember is held.  No allocation.
  void internal_force(const NodalVectors& u, NodalVectors& f) const;
  /// The same at the end of a time step dt [time], over which the memory evolves from what it was at the last
  /// commit(): the step may be worked out again, and nothing else sees it before commit().
  void evolve(const NodalVectors& u, double dt, NodalVectors& f);
  /// The end of a step: what points remember is now what evolve() found.
  void commit() { memory_.swap(next_memory_); }
  /// What points remember, [element][point][Material::state_size()]: empty for a law without memory.
  const std::vector<double>& memory() const { return memory_; }
  /// Throws std::invalid_argument if the size does not fit.
  void set_memory(std::vector<double> memory);
  /// Stored energy of the displacements [energy].
  double strain_energy(const NodalVectors& u) const;
  /// Row sums of the consistent mass matrix, integral of density R_A [mass], one per node, all > 0.
  const Eigen::VectorXd& row_sum_mass() const { return row_sum_mass_; }

  /// H = du/dX [-] at a parameter point.
  Matrix3 displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;
  /// First Piola-Kirchhoff stress [stress] at a parameter point; the Cauchy stress while strains are small.
  /// A law with memory takes that of the nearest quadrature point.
  Matrix3 stress(const NodalVectors& u, const nurbs::Parameter<3>& xi) const;

  // Single elements, for estimates that look at one element at a time.  Element values are
  // [3][padded_functions()], 0 beyond the functions: kernels go over whole vectors.
  int padded_functions() const { return padded_; }
  void gather(int element, const NodalVectors& nodal, double* values) const;
  void element_force(int element, const double* u, double* f) const;
  /// Smallest current over reference volume det(I + H) [-] at the element's quadrature points: <= 0 if it is
  /// folded.
  double smallest_volume_ratio(int element, const double* u) const;
  /// Row-sum mass of one element's own volume [mass], [padded_functions()].
  const double* element_mass(int element) const { return &element_mass_[std::size_t(element) * padded_]; }

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
  int functions_, padded_, points_;   // per element
  std::vector<int> nodes_;            // [element][function]
  std::vector<double> dR_dX_;         // [element][point][direction][padded]
  std::vector<double> wJ_;            // [element][point]
  std::vector<double> element_mass_;  // [element][padded]
  std::size_t remembered_;            // numbers per element
  std::vector<double> memory_, next_memory_;
  Eigen::VectorXd row_sum_mass_;
  ForceKernel force_kernel_;
};

}  // namespace structure
