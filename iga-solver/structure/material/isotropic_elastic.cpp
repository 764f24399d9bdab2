// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/isotropic_elastic.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace structure {

namespace {

// Written so that NaN and infinity are refused too.
void require(const char* law, bool valid, const char* what, double given, const char* expected) {
  if (!valid || !std::isfinite(given))
    throw std::invalid_argument(fmt::format("{}: {} is {}, expected {}", law, what, given, expected));
}

}  // namespace

IsotropicElastic::IsotropicElastic(const char* law, double youngs_modulus, double poissons_ratio,
                                   double density)
    : E_(youngs_modulus), nu_(poissons_ratio), density_(density) {
  require(law, E_ > 0.0, "Young's modulus", E_, "a number > 0");
  require(law, nu_ > -1.0 && nu_ < 0.5, "Poisson's ratio", nu_, "a number between -1 and 0.5, both excluded");
  require(law, density_ > 0.0, "density", density_, "a number > 0");
  lambda_ = E_ * nu_ / ((1.0 + nu_) * (1.0 - 2.0 * nu_));
  mu_ = E_ / (2.0 * (1.0 + nu_));
}

}  // namespace structure
