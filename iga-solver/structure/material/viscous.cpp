// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/viscous.h"

#include <stdexcept>
#include <utility>

namespace structure {

Viscous::Viscous(std::shared_ptr<const Material> elastic, double viscosity)
    : elastic_(std::move(elastic)),
      viscosity_(viscosity),
      law_(std::string(elastic_->law()) + " with viscosity") {
  if (elastic_->state_size() > 0 || !(viscosity > 0.0))
    throw std::invalid_argument("Viscous: expected a law without memory and a viscosity > 0");
}

namespace {

Eigen::Map<const Matrix3> viscous_part(const double* state) { return Eigen::Map<const Matrix3>(state + 9); }

}  // namespace

Matrix3 Viscous::stress(const Matrix3& H, const double* state) const {
  const Matrix3 P = elastic_->stress(H, nullptr);
  if (elastic_->is_linear()) return P + viscous_part(state);
  return P + (Matrix3::Identity() + H) * viscous_part(state);
}

Matrix3 Viscous::cauchy_stress(const Matrix3& H, const double* state) const {
  return elastic_->is_linear() ? stress(H, state) : Material::cauchy_stress(H, state);
}

// dP = dH S + F C : sym(F^T dH).
void Viscous::evolve(const Matrix3& H, double dt, const double* old, double* next) const {
  if (dt == 0.0) {
    Matrix3::Map(next) = H;
    Matrix3::Map(next + 9).setZero();
    next[18] = old[18];
    return;
  }
  const Matrix3 before = Matrix3::Map(old), change = H - before, middle = 0.5 * (H + before);
  Matrix3 viscous = viscosity_ / dt * elastic_->stress_change(middle, change, nullptr);
  double work = viscous.cwiseProduct(change).sum();
  if (!elastic_->is_linear()) {
    const Matrix3 F = Matrix3::Identity() + middle, to_reference = F.inverse();
    const Matrix3 S = to_reference * elastic_->stress(middle, nullptr);
    viscous = to_reference * (viscous - viscosity_ / dt * change * S);
    work = (F * viscous).cwiseProduct(change).sum();
  }
  Matrix3::Map(next) = H;
  Matrix3::Map(next + 9) = viscous;
  next[18] = old[18] + work;
}

std::vector<double> Viscous::further_constants() const {
  std::vector<double> constants = elastic_->further_constants();
  constants.push_back(viscosity_);
  return constants;
}

}  // namespace structure
