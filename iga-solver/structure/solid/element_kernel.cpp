// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/element_kernel.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace structure {

namespace {

/// Displacement gradient from u and dR/dX, both [3][n].  Two partial sums per entry: a plain sum of doubles
/// would be one long chain of additions, which the compiler may not break.
inline Matrix3 displacement_gradient(const double* u, const double* dR_dX, int n) {
  using Lanes = Eigen::Array2d;
  using Values = Eigen::Map<const Lanes>;
  Lanes sum[3][3];
  for (auto& row : sum)
    for (Lanes& entry : row) entry.setZero();
  for (int A = 0; A < n; A += 2)
    for (int j = 0; j < 3; ++j) {
      const Lanes dR_dX_j = Values(dR_dX + j * n + A);
      for (int i = 0; i < 3; ++i) sum[i][j] += Values(u + i * n + A) * dR_dX_j;
    }
  Matrix3 H;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) H(i, j) = sum[i][j].sum();
  return H;
}

/// f_A += P dR_A/dX
inline void add_force(const Matrix3& P, const double* __restrict dR_dX, int n, double* __restrict f) {
  for (int i = 0; i < 3; ++i)
    for (int A = 0; A < n; ++A)
      f[i * n + A] += P(i, 0) * dR_dX[A] + P(i, 1) * dR_dX[n + A] + P(i, 2) * dR_dX[2 * n + A];
}

/// Padded > 0 is known at compile time; 0 takes the element's own.
template <int Padded>
void element_force(const Material& material, const ElementGeometry& element, const ElementMemory& memory,
                   const double* u, double* f) {
  const int n = Padded > 0 ? Padded : element.padded;
  const int remembered = material.state_size();
  const double* const held = memory.next ? memory.next : memory.state;
  std::fill_n(f, 3 * n, 0.0);
  for (int q = 0; q < element.points; ++q) {
    const double* dR_dX = element.dR_dX + 3 * n * q;
    const Matrix3 H = displacement_gradient(u, dR_dX, n);
    const int slot = remembered * element.slot[q];
    if (memory.next) material.evolve(H, memory.dt, memory.state + slot, memory.next + slot);
    add_force(element.wJ[q] * material.stress(H, held + slot), dR_dX, n, f);
  }
}

}  // namespace

ForceKernel force_kernel(int padded) {
  switch (padded) {
    case 28:
      return element_force<28>;
    case 64:
      return element_force<64>;
    default:
      return element_force<0>;
  }
}

void element_force_change(const Material& material, const ElementGeometry& element, const double* state,
                          const double* u, const double* w, double* f) {
  const int n = element.padded, remembered = material.state_size();
  std::fill_n(f, 3 * n, 0.0);
  for (int q = 0; q < element.points; ++q) {
    const double* dR_dX = element.dR_dX + 3 * n * q;
    const Matrix3 H = displacement_gradient(u, dR_dX, n), G = displacement_gradient(w, dR_dX, n);
    add_force(element.wJ[q] * material.stress_change(H, G, state + remembered * element.slot[q]), dR_dX, n,
              f);
  }
}

double element_energy(const Material& material, const ElementGeometry& element, const double* state,
                      const double* u) {
  const int n = element.padded, remembered = material.state_size();
  double energy = 0.0;
  for (int q = 0; q < element.points; ++q)
    energy += element.wJ[q] * material.energy_density(displacement_gradient(u, element.dR_dX + 3 * n * q, n),
                                                      state + remembered * element.slot[q]);
  return energy;
}

double smallest_volume_ratio(const ElementGeometry& element, const double* u) {
  const int n = element.padded;
  double smallest = std::numeric_limits<double>::infinity();
  for (int q = 0; q < element.points; ++q) {
    const Matrix3 H = displacement_gradient(u, element.dR_dX + 3 * n * q, n);
    const double ratio = (Matrix3::Identity() + H).determinant();
    if (std::isnan(ratio)) return ratio;
    smallest = std::min(smallest, ratio);
  }
  return smallest;
}

}  // namespace structure
