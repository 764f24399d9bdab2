// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/changing_load.h"

#include <utility>

namespace structure {

FactoredLoad::FactoredLoad(const NodalVectors& forces, TimeFunction factor) : factor_(std::move(factor)) {
  for (Eigen::Index A = 0; A < forces.cols(); ++A)
    if (!forces.col(A).isZero(0.0)) columns_.push_back(A);
  forces_ = forces(Eigen::all, columns_);
}

void FactoredLoad::add(double t, const NodalVectors& /*x*/, const Halo& /*halo*/, NodalVectors& f) const {
  const double factor = value_at(factor_, t);
  for (std::size_t i = 0; i < columns_.size(); ++i) f.col(columns_[i]) += factor * forces_.col(i);
}

FieldTraction::FieldTraction(SkinQuadrature skin, Field traction, TimeFunction factor)
    : skin_(std::move(skin)), traction_(std::move(traction)), factor_(std::move(factor)) {}

void FieldTraction::add(double t, const NodalVectors& /*x*/, const Halo& /*halo*/, NodalVectors& f) const {
  const double factor = value_at(factor_, t);
  skin_.integrate([&](const nurbs::Vector3& X) -> nurbs::Vector3 { return factor * traction_(X, t); }, f);
}

}  // namespace structure
