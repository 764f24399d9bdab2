// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/sparse_factor.h"

#include <stdexcept>

namespace structure {

SparseFactor::SparseFactor(const Tangent& tangent)
    : tangent_(tangent),
      graph_(tangent.body()),
      number_(numbers_of_free(tangent.supports(), tangent.body().node_count())),
      size_(static_cast<Eigen::Index>(number_.size() - tangent.supports().fixed_dofs().size())),
      is_linear_(is_linear(tangent.body())),
      factors_(factorised()) {
  if (!factors_) throw std::runtime_error("the stiffness is not positive: can the body move freely?");
}

std::unique_ptr<SparseFactor::Factors> SparseFactor::factorised() const {
  auto factors = std::make_unique<Factors>(lower_triangle(graph_, tangent_.product(), number_));
  return factors->info() == Eigen::Success ? std::move(factors) : nullptr;
}

void SparseFactor::update() {
  if (is_linear_) return;
  if (auto now = factorised()) factors_ = std::move(now);
}

void SparseFactor::apply(const NodalVectors& r, NodalVectors& z) const {
  Eigen::VectorXd values(size_);
  for (std::size_t dof = 0; dof < number_.size(); ++dof)
    if (number_[dof] >= 0) values[number_[dof]] = r.data()[dof];
  values = factors_->solve(values).eval();
  for (std::size_t dof = 0; dof < number_.size(); ++dof)
    z.data()[dof] = number_[dof] >= 0 ? values[number_[dof]] : 0.0;
}

}  // namespace structure
