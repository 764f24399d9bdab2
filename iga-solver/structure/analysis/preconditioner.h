// SPDX-License-Identifier: GPL-2.0-or-later
// The seam of preconditioners: what makes conjugate gradients on a Tangent converge in few products.
#pragma once

#include "structure/analysis/tangent.h"

namespace structure {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// z = P^-1 r of a symmetric positive P near the tangent, 0 at fixed degrees of freedom.
  virtual void apply(const NodalVectors& r, NodalVectors& z) const = 0;
  /// The displacements have moved on since it was made, or since the last update.
  virtual void update() {}
  virtual const char* name() const = 0;  ///< as in model files
};

}  // namespace structure
