// SPDX-License-Identifier: GPL-2.0-or-later
// A deformable solid: NURBS volume patches, welded or not, each of a material.
// Source: Hughes, Cottrell & Bazilevs (2005); Gao & Feng (2019), eqs. 16-19.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "structure/body.h"
#include "structure/solid/solid_patch.h"

namespace structure {

/// A patch and what it is made of.
struct MaterialPatch {
  const nurbs::Volume& volume;  ///< the reference configuration X
  std::shared_ptr<const Material> material;
};

/// Matrix-free: no stiffness is assembled.  The same sums in the same order in every run.  Elements are
/// counted patch after patch, box after box (box_grid.h), those of a box with the first direction fastest.
class Solid final : public Body {
 public:
  /// One patch, whose control points are the nodes.  Throws std::invalid_argument if it is not valid, if the
  /// Jacobian determinant of some element is not positive (a left-handed or folded patch), or if the
  /// integration is not for it.
  Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material,
        const Integration& integration = {});
  /// A part of it, cut at box_cuts: keeps the knots and weights of the patch, and its own control points.
  Solid(const nurbs::Volume& patch, std::shared_ptr<const Material> material, const Integration& integration,
        const Part& part);
  /// A part, or all, of a body of several patches with these nodes.  Throws as above; also if laws remember
  /// and the patches' elements do not remember equally much.
  Solid(const std::vector<MaterialPatch>& patches, const NodeNumbering& nodes, const Integration& integration,
        const Part& part);

  const SolidPatch& patch(int p) const { return *patches_[p]; }
  const nurbs::Space<3>& space(int patch = 0) const { return patches_[patch]->space(); }
  /// The method that was chosen.
  const Integration& integration(int patch = 0) const { return patches_[patch]->integration(); }
  double table_bytes() const;
  /// H = du/dX [-] at a parameter point of a patch.
  Matrix3 displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi, int patch = 0) const {
    return patches_[patch]->displacement_gradient(u, xi);
  }
  /// First Piola-Kirchhoff stress [stress] at a parameter point; the Cauchy stress while strains are small.
  /// A law with memory takes that of the nearest quadrature point.
  Matrix3 stress(const NodalVectors& u, const nurbs::Parameter<3>& xi, int patch = 0) const;

  int node_count() const override { return static_cast<int>(reference_.cols()); }
  const NodalVectors& reference() const override { return reference_; }
  PatchSpaces patches() const override;
  /// Throws std::invalid_argument unless there is the patch.
  nurbs::BoundarySurface skin(const SkinPiece& piece) const override;
  std::vector<SkinBox> skin_boxes(const SkinPiece& piece) const override {
    return patches_[piece.patch]->skin_boxes(piece.face);
  }
  ExactSum volume_sum() const override { return volume_; }
  std::vector<const Material*> materials() const override;
  std::string discretisation() const override;
  const Eigen::VectorXd& row_sum_mass() const override { return row_sum_mass_; }
  bool corrects_mass() const override { return integration().mass == TimeMass::corrected; }
  void mass_product(
      const NodalVectors& a, NodalVectors& f,
      const std::function<void()>& shares_ready = [] {}) const override;

  void internal_force(const NodalVectors& u, NodalVectors& f) const override;
  void internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const override;
  void evolve(
      const NodalVectors& u, double dt, NodalVectors& f,
      const std::function<void()>& shares_ready = [] {}) override;
  void commit() override { memory_.swap(next_memory_); }
  const std::vector<double>& memory() const override { return memory_; }
  void set_memory(std::vector<double> memory) override;
  ExactSum strain_energy_sum(const NodalVectors& u) const override;
  ExactSum dissipated_sum() const override;

  int element_count() const override { return first_element_.back(); }
  int padded_functions(int element) const override { return of(element).patch.padded_functions(); }
  void gather(int element, const NodalVectors& nodal, double* values) const override;
  std::vector<int> element_nodes(int element) const override;
  void element_force(int element, const double* u, double* f) const override;
  const double* element_mass(int element) const override;
  Eigen::MatrixXd element_mass_matrix(int element) const override;
  double smallest_volume_ratio(int element, const double* u) const override;
  const Material& element_material(int element) const override { return of(element).patch.material(); }
  std::string describe_element(int element) const override;
  std::vector<std::array<int, 2>> net_edges() const override;

 private:
  struct PatchElement {
    const SolidPatch& patch;
    int element;  // of the patch
  };
  PatchElement of(int element) const;
  void take_reference(const std::vector<MaterialPatch>& patches, const Part& part);
  void expect_equal_memories();
  void expect_memory() const;
  /// Of the patch's elements.
  PointMemory held(std::size_t patch) const;
  PointMemory evolving(std::size_t patch, double dt);

  NodeNumbering nodes_;
  NodalVectors reference_;
  std::vector<std::unique_ptr<SolidPatch>> patches_;
  std::vector<int> first_element_;            // of each patch, and of one beyond
  std::size_t remembered_ = 0;                // numbers per element
  std::vector<double> memory_, next_memory_;  // as PointMemory
  Eigen::VectorXd row_sum_mass_;
  ExactSum volume_;
};

}  // namespace structure
