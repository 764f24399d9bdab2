// SPDX-License-Identifier: GPL-2.0-or-later
// What time integration, conditions and coupling need to know of a deformable body.  A body knows its forces
// and its masses, not its motion: displacements come in as arguments.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "nurbs/boundary.h"
#include "structure/exact_sum.h"
#include "structure/material/material.h"

namespace structure {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// A piece of a body's skin: a face of one of its patches.
struct SkinPiece {
  int patch;
  nurbs::Face face;
};

/// Elements of a piece of the skin that one box of a part has (partition.h).
struct SkinBox {
  std::vector<int> elements;        ///< of the piece's space
  std::vector<int> control_points;  ///< of the piece's space that they have, rising
  /// Columns of nodal arrays that these are read from, and where the box adds its forces.
  std::vector<int> read, write;
};

/// The patches that a body is made of: volumes, or surfaces with a thickness.
using PatchSpaces = std::variant<std::vector<nurbs::Space<3>>, std::vector<nurbs::Space<2>>>;

/// Nodal arrays are 3 x node_count, sized by the caller.  Displacements u [length] are those from
/// `reference`.  A part of a body has the nodes of its own elements, and columns for shares of forces behind
/// them (halo.h); skins speak of nodes of the whole.
class Body {
 public:
  virtual ~Body() = default;

  virtual int node_count() const = 0;
  virtual const NodalVectors& reference() const = 0;  ///< undeformed positions of the nodes [length]
  virtual PatchSpaces patches() const = 0;
  virtual nurbs::BoundarySurface skin(const SkinPiece& piece) const = 0;
  /// The same box by box, as far as the part has it: forces that follow the skin are added as internal ones.
  virtual std::vector<SkinBox> skin_boxes(const SkinPiece& piece) const = 0;
  virtual ExactSum volume_sum() const = 0;  ///< [length^3]; of a part, to be summed over all
  virtual std::vector<const Material*> materials() const = 0;  ///< of each patch
  /// Choices that a saved state depends on, beside patches and material, in words; empty for the usual ones.
  virtual std::string discretisation() const { return {}; }
  /// Row sums of the consistent mass matrix, integral of density R_A [mass], one per node, all > 0.
  virtual const Eigen::VectorXd& row_sum_mass() const = 0;
  /// Whether accelerations are to come of row sums that the consistent matrix corrects (time/mass.h).
  virtual bool corrects_mass() const { return false; }
  /// f = M a [force]: the consistent mass matrix, integral of density R_A R_B, times accelerations a.
  /// `shares_ready` as of evolve().  No allocation but in the first call.  Unless a body knows better,
  /// element by element.
  virtual void mass_product(
      const NodalVectors& a, NodalVectors& f, const std::function<void()>& shares_ready = [] {}) const;

  /// f = internal forces [force] of the displacements u: equilibrium is f = external forces.  What points
  /// remember is held.  No allocation.
  virtual void internal_force(const NodalVectors& u, NodalVectors& f) const = 0;
  /// The same at the end of a time step dt [time], over which the memory evolves from what it was at the last
  /// commit(): the step may be worked out again, and nothing else sees it before commit().  Velocities are
  /// not asked for: the mean one of the step is what u has moved since, over dt; if that is 0 the body was
  /// put there and rests.
  /// `shares_ready` is called as soon as f holds what other parts wait for (Halo::begin_sum).
  virtual void evolve(
      const NodalVectors& u, double dt, NodalVectors& f,
      const std::function<void()>& shares_ready = [] {}) = 0;
  /// f = K(u) w [force]: the change of the internal forces along a change w of u, what points remember held.
  /// Unless a body knows better, by central differences.
  virtual void internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const;
  /// The end of a step: what points remember is now what evolve() found.
  virtual void commit() = 0;
  /// What points remember, element after element, equally much of each; empty for a law without memory.
  virtual const std::vector<double>& memory() const = 0;
  /// Throws std::invalid_argument if the size does not fit.
  virtual void set_memory(std::vector<double> memory) = 0;
  /// Stored energy of the displacements [energy]; of a part, to be summed over all.
  virtual ExactSum strain_energy_sum(const NodalVectors& u) const = 0;

  /// Energy that points have lost for good, as far as they remember it [energy]; of a part, likewise.
  virtual ExactSum dissipated_sum() const { return {}; }

  double volume() const { return volume_sum().value(); }
  double strain_energy(const NodalVectors& u) const { return strain_energy_sum(u).value(); }

  // Single elements, for estimates that look at one element at a time.  Element values are
  // [3][padded_functions(element)], 0 beyond the functions: kernels go over whole vectors.
  virtual int element_count() const = 0;
  virtual int padded_functions(int element) const = 0;
  virtual void gather(int element, const NodalVectors& nodal, double* values) const = 0;
  /// Nodes whose functions are not zero on it.
  virtual std::vector<int> element_nodes(int element) const;
  virtual void element_force(int element, const double* u, double* f) const = 0;
  /// Row-sum mass of one element's own volume [mass], [padded_functions(element)].
  virtual const double* element_mass(int element) const = 0;
  /// Its consistent mass matrix [mass], in the order of element_nodes; unless a body knows better, lumped.
  virtual Eigen::MatrixXd element_mass_matrix(int element) const {
    return Eigen::VectorXd::Map(element_mass(element), Eigen::Index(element_nodes(element).size()))
        .asDiagonal();
  }
  /// Smallest current over reference volume det(I + H) [-] at the element's quadrature points: <= 0 if it is
  /// folded.
  virtual double smallest_volume_ratio(int element, const double* u) const = 0;
  /// Of its patch.
  virtual const Material& element_material(int /*element*/) const { return *materials().front(); }
  /// For messages: "spans 1, 0, 2 of xi, eta, zeta, undeformed about (1, 2, 3)".
  virtual std::string describe_element(int element) const = 0;

  /// Neighbours in the net of control nodes: pairs of columns of nodal arrays, some twice; none: strains are
  /// not watched (time/stretch_watch.h).
  virtual std::vector<std::array<int, 2>> net_edges() const { return {}; }
};

/// Whether the laws of all patches are.
bool is_linear(const Body& body);

/// "(1, 2.5, 3)", for messages.
std::string text(const Vector3& x);

}  // namespace structure
