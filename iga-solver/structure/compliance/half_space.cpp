// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/half_space.h"

#include <algorithm>

namespace structure {

// With R = |x|, the depth z = n . x and rho = x - z n both solutions together are
//   4 pi mu U = I/R + x x^T/R^3 + (1 - 2 nu) T
//   T = P/(R+z) - rho rho^T/(R (R+z)^2) + (n rho^T - rho n^T)/(R (R+z)) + n n^T/R
// (Johnson's eqs. 3.18 and 3.75, which give them component by component).

namespace {

/// 1/(R+z), which is without limit straight above the force.
double inverse_sum(double inverse_R, double z) {
  constexpr double kSteep = 0.1;
  return 1.0 / std::max(1.0 / inverse_R + z, kSteep / inverse_R);
}

}  // namespace

HalfSpace::HalfSpace(double youngs_modulus, double poissons_ratio, const Vector3& outward_normal)
    : mu_(0.5 * youngs_modulus / (1.0 + poissons_ratio)),
      mirror_(1.0 - 2.0 * poissons_ratio),
      n_(-outward_normal),
      nn_(n_ * n_.transpose()),
      P_(Matrix3::Identity() - nn_) {}

Matrix3 HalfSpace::displacement(const Vector3& x) const {
  const double r = 1.0 / x.norm(), z = n_.dot(x), s = inverse_sum(r, z), rs = r * s;
  const Vector3 rho = x - z * n_;
  const Matrix3 rho_terms = rho * (rs * (s * rho + n_)).transpose(),
                n_terms = n_ * (rs * rho + r * n_).transpose();
  Matrix3 sum = (r * r * r) * x * x.transpose() + mirror_ * (s * P_ - rho_terms + n_terms);
  sum.diagonal().array() += r;
  return sum / (4.0 * nurbs::kPi * mu_);
}

// T is -grad grad psi + 2 n (grad phi)^T of two harmonic functions, psi = z ln(R+z) - R and its derivative by
// depth phi = ln(R+z); all that is left of their third derivatives on a plane m, which is m_s along the
// surface and m - m_s along n, are in-plane terms:
//   2 pi t = (1 - 2 nu) (m_s x^T/R^3 - B - v n^T) - 3 (x . m) x x^T/R^5
//   B = (rho . m_s) (P/(R S^2) - (1/(R^3 S^2) + 2/(R^2 S^3)) rho rho^T) + (rho m_s^T + m_s rho^T)/(R S^2)
//   v = m_s/(R S) - (rho . m_s) (1/(R^3 S) + 1/(R^2 S^2)) rho,  S = R + z
Matrix3 HalfSpace::traction(const Vector3& x, const Vector3& m) const {
  const double r = 1.0 / x.norm(), z = n_.dot(x), s = inverse_sum(r, z), rs = r * s;
  const Vector3 rho = x - z * n_, m_s = m - n_.dot(m) * n_;
  const double along = rho.dot(m_s);
  const Vector3 by_m_s = r * r * r * x - rs * s * rho - rs * n_;
  const Vector3 by_rho =
      along * rs * s * (r * r + 2.0 * rs) * rho - rs * s * m_s + along * rs * (r * r + rs) * n_;
  const Matrix3 in_plane = m_s * by_m_s.transpose() + rho * by_rho.transpose() - along * rs * s * P_;
  return (mirror_ * in_plane - 3.0 * x.dot(m) * (r * r * r * r * r) * x * x.transpose()) / nurbs::kTwoPi;
}

}  // namespace structure
