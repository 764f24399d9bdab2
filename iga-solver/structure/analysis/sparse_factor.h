// SPDX-License-Identifier: GPL-2.0-or-later
// The tangent itself as a sparse matrix, factorised: for small models, however slender they are.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "structure/analysis/coloured_products.h"
#include "structure/analysis/preconditioner.h"

namespace structure {

class SparseFactor final : public Preconditioner {
 public:
  /// Throws std::runtime_error if the tangent is not positive: a body that can move freely, or has buckled.
  explicit SparseFactor(const Tangent& tangent);
  void apply(const NodalVectors& r, NodalVectors& z) const override;
  /// Keeps the factors that it has if the tangent is not positive now.
  void update() override;
  const char* name() const override { return "sparse"; }

 private:
  using Factors = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;
  std::unique_ptr<Factors> factorised() const;

  const Tangent& tangent_;
  NodeGraph graph_;
  std::vector<int> number_;  // of each degree of freedom, -1: fixed
  Eigen::Index size_;
  bool is_linear_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace structure
