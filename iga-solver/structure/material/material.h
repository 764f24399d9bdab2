// SPDX-License-Identifier: GPL-2.0-or-later
// The material seam: displacement gradient and memory -> first Piola-Kirchhoff stress.
// A law is a stored energy W(H, z) of the displacement gradient and of its memory z (internal variables), and
// a rule by which z evolves over a time step.  What is asked about a state, as energies and the stable step
// are, sees z held: P = dW/dH, so the stiffness is symmetric whatever the law.
// Source: generalised standard materials, Halphen & Nguyen (1975), J. Mecanique 14, 39-63.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace structure {

using Matrix3 = Eigen::Matrix3d;

class Material {
 public:
  virtual ~Material() = default;
  /// First Piola-Kirchhoff stress P [Pa] at the displacement gradient H = du/dX [-], memory held at `state`
  /// (state_size() numbers).
  virtual Matrix3 stress(const Matrix3& H, const double* state) const = 0;
  /// dP/dH : G [Pa], the change of that stress along a change G of H [-].  Unless a law knows better, by
  /// central differences: ten digits.
  virtual Matrix3 stress_change(const Matrix3& H, const Matrix3& G, const double* state) const;
  /// Stored energy per reference volume [J/m^3]; stress is its derivative with respect to H.
  virtual double energy_density(const Matrix3& H, const double* state) const = 0;

  /// Force per area as it now is [Pa], in space: P F^T / det F with F = I + H, which is symmetric if the law
  /// is objective.  Of a law for small strain areas and directions are those of the reference: P itself.
  virtual Matrix3 cauchy_stress(const Matrix3& H, const double* state) const {
    const Matrix3 F = Matrix3::Identity() + H;
    return stress(H, state) * F.transpose() / F.determinant();
  }

  /// Numbers that a point remembers, all 0 before the first step; none for an elastic law, which may ignore
  /// its state and is never asked to evolve it.
  virtual int state_size() const { return 0; }
  /// Memory after a time step dt [time] from `old` that ends at H: sets all of `next`.  If dt is 0 the point
  /// was put there and rests: nothing has a rate.
  virtual void evolve(const Matrix3& /*H*/, double /*dt*/, const double* /*old*/, double* /*next*/) const {}

  /// Energy per reference volume that a point has lost for good, if its memory tells [J/m^3].
  virtual double dissipated_density(const double* /*state*/) const { return 0.0; }

  /// Whether P is linear in H: its change is the same at all H.
  virtual bool is_linear() const { return false; }
  /// Whether rotations strain it: P is linear in H but for what it remembers.
  virtual bool is_small_strain() const { return is_linear(); }

  virtual const char* law() const = 0;        ///< its word in model files
  virtual double density() const = 0;         ///< reference mass density [kg/m^3]
  virtual double youngs_modulus() const = 0;  ///< small-strain value [Pa], compared with the deck's
  virtual double poissons_ratio() const = 0;  ///< small-strain value [-]
  /// All others, in any order: a saved state belongs to one set of them.
  virtual std::vector<double> further_constants() const { return {}; }
};

}  // namespace structure
