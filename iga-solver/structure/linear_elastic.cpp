// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/linear_elastic.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace structure {

namespace {

// Written so that NaN and infinity are refused too.
void require(bool valid, const char* what, double given, const char* expected) {
  if (!valid || !std::isfinite(given))
    throw std::invalid_argument(fmt::format("LinearElastic: {} is {}, expected {}", what, given, expected));
}

}  // namespace

LinearElastic::LinearElastic(double youngs_modulus, double poissons_ratio, double density)
    : E_(youngs_modulus), nu_(poissons_ratio), density_(density) {
  require(E_ > 0.0, "Young's modulus", E_, "a number > 0");
  require(nu_ > -1.0 && nu_ < 0.5, "Poisson's ratio", nu_, "a number between -1 and 0.5, both excluded");
  require(density_ > 0.0, "density", density_, "a number > 0");
  lambda_ = E_ * nu_ / ((1.0 + nu_) * (1.0 - 2.0 * nu_));
  mu_ = E_ / (2.0 * (1.0 + nu_));
}

Matrix3 LinearElastic::stress(const Matrix3& H) const {
  Matrix3 sigma = mu_ * (H + H.transpose());
  sigma.diagonal().array() += lambda_ * H.trace();
  return sigma;
}

double LinearElastic::energy_density(const Matrix3& H) const { return 0.5 * stress(H).cwiseProduct(H).sum(); }

}  // namespace structure
