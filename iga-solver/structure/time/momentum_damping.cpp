// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/momentum_damping.h"

namespace structure {

MomentumDamping::MomentumDamping(double rate, const MassOperator& mass, Eigen::Index owned)
    : rate_(NodalVectors::Zero(3, mass.inverse_mass().cols())), p_(rate_), f_(rate_), damping_(rate_) {
  rate_.leftCols(owned) = (mass.inverse_mass().leftCols(owned).array() > 0.0).cast<double>() * rate;
}

void MomentumDamping::start(const MassOperator& mass, const NodalVectors& v) {
  if (is_known_) return;
  NodalVectors p(3, v.cols());
  mass.apply_mass(v, p);
  set_momenta(p);
}

void MomentumDamping::set_momenta(const NodalVectors& p) {
  p_ = (rate_.array() > 0.0).select(p, 0.0);
  is_known_ = true;
}

void MomentumDamping::kick(double h, NodalVectors& f) {
  p_ = (rate_.array() > 0.0).select((p_ + h * f).array() / (1.0 + h * rate_.array()), 0.0);
  damping_ = -rate_.cwiseProduct(p_);
  f += damping_;
  f_ = f;
}

}  // namespace structure
