// SPDX-License-Identifier: GPL-2.0-or-later
// Block Jacobi: the tangent's 3 x 3 blocks of single nodes.  For any body; products grow with its size in
// elements.
#pragma once

#include <vector>

#include "structure/analysis/preconditioner.h"

namespace structure {

class NodalJacobi final : public Preconditioner {
 public:
  explicit NodalJacobi(const Tangent& tangent);
  void apply(const NodalVectors& r, NodalVectors& z) const override;
  const char* name() const override { return "nodes"; }

 private:
  const Supports& supports_;
  std::vector<Matrix3> inverse_;
};

}  // namespace structure
