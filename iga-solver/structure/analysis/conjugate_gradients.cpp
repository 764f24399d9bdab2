// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/conjugate_gradients.h"

namespace structure {

CgResult conjugate_gradients(const Product& A, const Preconditioner& P, const NodalVectors& b,
                             NodalVectors& x, const CgLimits& limits) {
  CgResult result;
  const double size = b.norm();
  x.setZero(3, b.cols());
  result.converged = size == 0.0;
  if (result.converged) return result;
  NodalVectors r = b, z(3, b.cols()), Ap(3, b.cols());
  P.apply(r, z);
  NodalVectors p = z;
  double r_z = dot(r, z);
  result.residual = 1.0;
  while (!result.converged && result.products < limits.most_products) {
    A(p, Ap);
    ++result.products;
    const double p_Ap = dot(p, Ap);
    if (!(p_Ap > 0.0)) {
      result.is_positive = false;
      if (result.products == 1) x = p;
      break;
    }
    const double step = r_z / p_Ap;
    x += step * p;
    r -= step * Ap;
    result.residual = r.norm() / size;
    result.converged = result.residual <= limits.tolerance;
    P.apply(r, z);
    const double r_z_before = r_z;
    r_z = dot(r, z);
    p = z + (r_z / r_z_before) * p;
  }
  return result;
}

}  // namespace structure
