// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/mass.h"

#include <stdexcept>
#include <utility>

namespace structure {

namespace {

bool are_masses(const Eigen::VectorXd& m) {
  return m.allFinite() && (m.array() > 0.0).all() && m.cwiseInverse().allFinite();
}

}  // namespace

LumpedMass::LumpedMass(Eigen::VectorXd nodal_mass, const Supports& supports)
    : mass_(std::move(nodal_mass)), inverse_(Vector3::Ones() * mass_.cwiseInverse().transpose()) {
  if (!are_masses(mass_))
    throw std::invalid_argument("LumpedMass: every nodal mass must be > 0 and finite, and one over it");
  supports.apply(inverse_);
}

CorrectedMass::CorrectedMass(const Body& body, Eigen::VectorXd nodal_mass, const Supports& supports,
                             const Halo& halo)
    : body_(body),
      halo_(halo),
      lumped_(std::move(nodal_mass), supports),
      bound_(2.0 * lumped_.inverse_mass()),
      supports_move_(halo.any(!supports.motions().empty())),
      predicted_(NodalVectors::Zero(3, bound_.cols())),
      product_(predicted_) {}

/// product = M z, whole at own nodes.
void CorrectedMass::multiply_predicted() const {
  halo_.owners_to_ghosts(predicted_);
  // Columns that are no nodes stay where they are.
  predicted_.rightCols(predicted_.cols() - halo_.held(predicted_.cols())).setZero();
  body_.mass_product(predicted_, product_, [this] { halo_.begin_sum(product_); });
  halo_.finish_sum(product_);
}

void CorrectedMass::apply_inverse_mass(const NodalVectors& f, NodalVectors& a,
                                       const NodalVectors* of_supports) const {
  lumped_.apply_inverse_mass(f, predicted_);
  a = 2.0 * predicted_;
  if (of_supports) predicted_ += *of_supports;
  multiply_predicted();
  a -= product_.cwiseProduct(lumped_.inverse_mass());
}

/// v where a dof is fixed, 0 elsewhere.
NodalVectors CorrectedMass::of_fixed(const NodalVectors& v) const {
  return (lumped_.inverse_mass().array() > 0.0).select(NodalVectors::Zero(3, v.cols()), v);
}

// Of free dofs from inverse mass p = v + (M_fs/m) v_s = r.  Of the inverse mass times row sums all
// eigenvalues are 1 to 2, so a pass with 2/3 of what is left over leaves a third of the error.
void CorrectedMass::apply_mass(const NodalVectors& v, NodalVectors& p) const {
  constexpr int kPasses = 34;  // to round-off
  const NodalVectors v_s = of_fixed(v);
  NodalVectors r = v - v_s, product(3, v.cols());
  if (supports_move_) {
    predicted_ = v_s;
    multiply_predicted();
    r += product_.cwiseProduct(lumped_.inverse_mass());
  }
  lumped_.apply_mass(r, p);
  for (int pass = 0; pass < kPasses; ++pass) {
    apply_inverse_mass(p, product);
    p += 2.0 / 3.0 * (r - product) * lumped_.nodal_mass().asDiagonal();
  }
  apply_inverse_mass(p, product, &v_s);
  p += of_fixed(product_);
}

std::unique_ptr<MassOperator> mass_of(const Body& body, const Supports& supports, const Halo& halo) {
  Eigen::VectorXd row_sums = whole(halo, body.row_sum_mass());
  if (halo.any(!are_masses(row_sums)))
    throw std::invalid_argument(
        "a control node's mass, density times volume, is not a number that can be divided by; expected "
        "above 0 and finite: check the density and the units of lengths");
  if (body.corrects_mass()) return std::make_unique<CorrectedMass>(body, std::move(row_sums), supports, halo);
  return std::make_unique<LumpedMass>(std::move(row_sums), supports);
}

}  // namespace structure
