// SPDX-License-Identifier: GPL-2.0-or-later
// The mass of free vibrations: row sums, as in time, or the consistent matrix M_AB = integral of rho R_A R_B,
// whose frequencies converge from above, and of order 2 p in the mesh (Hughes 2000, sec. 7.3).
#pragma once

#include <Eigen/SparseCore>

#include "structure/body.h"

namespace structure {

enum class MassKind { lumped, consistent };

class MassMatrix {
 public:
  MassMatrix(const Body& body, MassKind kind);
  /// M q of nodal vectors, 3 x node_count.
  NodalVectors operator*(const NodalVectors& q) const { return q * matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;  // node by node, symmetric
};

}  // namespace structure
