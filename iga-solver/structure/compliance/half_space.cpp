// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/half_space.h"

namespace structure {

// With R = |x|, the depth z = n . x and rho = x - z n both solutions together are
//   4 pi mu U = I/R + x x^T/R^3 + (1 - 2 nu) T
//   T = P/(R+z) - rho rho^T/(R (R+z)^2) + (n rho^T - rho n^T)/(R (R+z)) + n n^T/R
// (Johnson's eqs. 3.18 and 3.75, which give them component by component).

HalfSpace::HalfSpace(double youngs_modulus, double poissons_ratio, const Vector3& outward_normal)
    : lambda_(youngs_modulus * poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio))),
      mu_(0.5 * youngs_modulus / (1.0 + poissons_ratio)),
      mirror_(1.0 - 2.0 * poissons_ratio),
      n_(-outward_normal),
      nn_(n_ * n_.transpose()),
      P_(Matrix3::Identity() - nn_) {}

Matrix3 HalfSpace::displacement(const Vector3& x) const {
  const double R = x.norm(), z = n_.dot(x), S = R + z;
  const Vector3 rho = x - z * n_;
  const Matrix3 n_rho = n_ * rho.transpose();
  const Matrix3 T =
      P_ / S - rho * rho.transpose() / (R * S * S) + (n_rho - n_rho.transpose()) / (R * S) + nn_ / R;
  const Matrix3 sum = Matrix3::Identity() / R + x * x.transpose() / (R * R * R) + mirror_ * T;
  return sum / (4.0 * nurbs::kPi * mu_);
}

/// dU/dx . a
Matrix3 HalfSpace::displacement_change(const Vector3& x, const Vector3& a) const {
  const double R = x.norm(), z = n_.dot(x), S = R + z;
  const double dR = x.dot(a) / R, dz = n_.dot(a), dS = dR + dz;
  const Vector3 rho = x - z * n_, d_rho = a - dz * n_;
  const Matrix3 a_x = a * x.transpose(), d_rho_rho = d_rho * rho.transpose(), n_rho = n_ * rho.transpose(),
                n_d_rho = n_ * d_rho.transpose();
  const Matrix3 dT = -P_ * (dS / (S * S)) - (d_rho_rho + d_rho_rho.transpose()) / (R * S * S) +
                     rho * rho.transpose() * (dR / (R * R * S * S) + 2.0 * dS / (R * S * S * S)) +
                     (n_d_rho - n_d_rho.transpose()) / (R * S) -
                     (n_rho - n_rho.transpose()) * (dR / (R * R * S) + dS / (R * S * S)) -
                     nn_ * (dR / (R * R));
  const Matrix3 sum = -Matrix3::Identity() * (dR / (R * R)) + (a_x + a_x.transpose()) / (R * R * R) -
                      x * x.transpose() * (3.0 * dR / (R * R * R * R)) + mirror_ * dT;
  return sum / (4.0 * nurbs::kPi * mu_);
}

Matrix3 HalfSpace::traction(const Vector3& x, const Vector3& m) const {
  Matrix3 along[3], traction;
  for (int k = 0; k < 3; ++k) along[k] = displacement_change(x, Vector3::Unit(k));
  for (int j = 0; j < 3; ++j) {
    Matrix3 H;
    for (int k = 0; k < 3; ++k) H.col(k) = along[k].col(j);
    traction.col(j) = lambda_ * H.trace() * m + mu_ * (H + H.transpose()) * m;
  }
  return traction;
}

}  // namespace structure
