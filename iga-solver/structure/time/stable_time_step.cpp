// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/stable_time_step.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "structure/time/lanczos.h"

namespace structure {

namespace {

/// Uniform in [-1, 1], from 53 mixed bits of n (splitmix64: Steele, Lea & Flood 2014, OOPSLA).
double random_entry(std::uint64_t n) {
  n = (n + 1) * 0x9e3779b97f4a7c15;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9;
  n = (n ^ (n >> 27)) * 0x94d049bb133111eb;
  return std::ldexp(double((n ^ (n >> 31)) >> 11), -52) - 1.0;
}

/// Random forces sqrt(m) v, so that M^-1/2 times them is v, or hides less of any mode where M is less than
/// its row sums.  By ids, so they are the same however a body is cut.
NodalVectors start_forces(const Eigen::VectorXd& nodal_mass, const Halo& halo) {
  NodalVectors q = NodalVectors::Zero(3, nodal_mass.size());
  for (Eigen::Index A = 0; A < halo.held(q.cols()); ++A)
    for (int i = 0; i < 3; ++i)
      q(i, A) = std::sqrt(nodal_mass[A]) * random_entry(3 * std::uint64_t(halo.node_id(A)) + i);
  return q;
}

double mean_element_size(const Body& body, const Halo& halo) {
  return std::cbrt(halo.total(body.volume_sum()) / halo.sum(double(body.element_count())));
}

/// Of trial displacements for the derivative of the internal force [-]: any law is linear there, and rounding
/// still leaves ten digits.
constexpr double kSmallStrain = 1e-6;

/// Of the eigenvalue bound: trial displacements are small, but not infinitely so.
constexpr double kTrialError = 2e-5;

/// Evaluations of the internal force.
constexpr int kEvaluations = 20;

/// That the bound is wrong, over all random starts, for the worst of all bodies.
constexpr double kChance = 1e-3;

/// The bound means nothing if they are not.
void expect_finite(double value, const Body& body, const NodalVectors& u, double element_size) {
  if (std::isfinite(value)) return;
  const Material& material = *body.materials().front();
  throw std::runtime_error(fmt::format(
      "stable_time_step: stiffness over mass is no finite number > 0 in the solid; likely cause: {}",
      u.allFinite()
          ? fmt::format(
                "sizes that overflow: Young's modulus {:.3g}, density {:.3g}, elements of about {:.3g}",
                material.youngs_modulus(), material.density(), element_size)
          : "displacements that are not finite, of a solid that has blown up"));
}

/// Of the derivative of a gradient, K q(j) . q(j-1) is what the recurrence takes it for.
void expect_symmetric(double product, double expected, double size) {
  constexpr double kTolerance = 1e-3;
  if (std::abs(product - expected) > kTolerance * size)
    throw std::logic_error(fmt::format(
        "stable_time_step: the stiffness is not symmetric, {} in place of {} 1/time^2: the internal force is "
        "not the gradient of an energy",
        product, expected));
}

void expect_masses_of(const Body& body, const MassOperator& mass, const Halo& halo) {
  constexpr double kTolerance = 1e-6;
  const double given = halo.sum(mass.nodal_mass().head(halo.owned(body.node_count())).sum()),
               expected = halo.sum(body.row_sum_mass().sum());
  if (std::abs(given - expected) > kTolerance * expected)
    throw std::logic_error(
        fmt::format("stable_time_step: masses of {} in all do not belong to the body, whose mass is {}",
                    given, expected));
}

/// K z [force] about the displacements u.
class Stiffness {
 public:
  Stiffness(const Body& body, const Supports& supports, const Springs& springs, const NodalVectors& u,
            const Halo& halo)
      : body_(body),
        supports_(supports),
        springs_(springs),
        u_(u),
        halo_(halo),
        trial_size_(kSmallStrain * mean_element_size(body, halo)),
        is_strained_(halo.any(!u.isZero(0.0) || !body.memory().empty())),
        f_0_(NodalVectors::Zero(3, u.cols())),
        trial_(u) {
    if (is_strained_) internal_force(u, f_0_);
  }
  /// How often it may be multiplied with.
  int products() const { return is_strained_ ? kEvaluations - 1 : kEvaluations; }
  void multiply(const NodalVectors& z, NodalVectors& f) {
    const double scale = trial_size_ / halo_.largest(halo_.own(z).lpNorm<Eigen::Infinity>());
    trial_ = u_ + scale * z;
    internal_force(trial_, f);
    f = (f - f_0_) / scale;
    supports_.apply(f);
  }

 private:
  void internal_force(const NodalVectors& u, NodalVectors& f) const {
    body_.internal_force(u, f);
    halo_.sum_to_owners(f);
    springs_.add_forces(u, f);
  }

  const Body& body_;
  const Supports& supports_;
  const Springs& springs_;
  const NodalVectors& u_;
  const Halo& halo_;
  double trial_size_;
  bool is_strained_;
  NodalVectors f_0_, trial_;
};

/// Bound of the largest eigenvalue of M^-1 K [1/time^2]; 0 if no dof is free.  The recurrence of lanczos.h
/// for forces q with the inner product q . M^-1 q.
double largest_eigenvalue(const Body& body, const MassOperator& mass, const Supports& supports,
                          const Springs& springs, const NodalVectors& u, const Halo& halo) {
  const double element_size = mean_element_size(body, halo);
  NodalVectors q = start_forces(mass.nodal_mass(), halo), z(q), w(q),
               z_previous(NodalVectors::Zero(3, q.cols())), q_previous(z_previous);
  const auto accelerations = [&](const NodalVectors& f, NodalVectors& a) {
    mass.apply_inverse_mass(f, a);
    halo.owners_to_ghosts(a);
    a.rightCols(a.cols() - halo.held(a.cols())).setZero();  // columns that are no nodes stay where they are
  };
  supports.apply(q);
  accelerations(q, z);
  double norm = std::sqrt(halo.dot(q, z));
  if (norm == 0.0) return 0.0;
  expect_finite(norm, body, u, element_size);
  const double hidden = hidden_share(norm, kChance);
  Stiffness K(body, supports, springs, u, halo);
  Tridiagonal T;
  for (int k = 0; k < K.products(); ++k) {
    q /= norm;
    z /= norm;
    K.multiply(z, w);
    T.a.push_back(halo.dot(w, z));
    expect_finite(T.a.back(), body, u, element_size);
    if (k > 0) {
      if (k == 1) expect_symmetric(halo.dot(w, z_previous), norm, std::abs(T.a[0]) + norm);
      w -= norm * q_previous;
    }
    w -= T.a.back() * q;
    q_previous.swap(q);
    z_previous.swap(z);
    q.swap(w);
    accelerations(q, z);
    norm = std::sqrt(halo.dot(q, z));
    expect_finite(norm, body, u, element_size);
    T.b.push_back(norm);
    if (norm <= 1e-9 * T.a.front()) break;  // the iterates span an invariant space
  }
  const double bound = (1.0 + kTrialError) * eigenvalue_bound(T, hidden);
  if (!(bound > 0.0)) expect_finite(std::numeric_limits<double>::quiet_NaN(), body, u, element_size);
  return bound;
}

}  // namespace

double stable_time_step(const Body& body, const MassOperator& mass, const Supports& supports,
                        const NodalVectors& u, const Halo& halo, const Springs& springs) {
  expect_masses_of(body, mass, halo);
  const double eigenvalue = largest_eigenvalue(body, mass, supports, springs, u, halo);
  return 2.0 / std::sqrt(eigenvalue);  // infinity if nothing can move
}

double damped_stable_step(double stable, double lead) {
  return lead == 0.0 || std::isinf(stable) ? stable : std::hypot(stable, lead) - lead;
}

double undamped_step(double dt, double lead) { return lead == 0.0 ? dt : std::sqrt(dt * (dt + 2.0 * lead)); }

std::string step_text(double stable) {
  std::string text = fmt::format("{:.6g}", stable);
  if (!std::isfinite(stable) || std::stod(text) <= stable) return text;
  const double last_digit = std::pow(10.0, std::floor(std::log10(stable)) - 5.0);
  return fmt::format("{:.6g}", stable - last_digit);
}

}  // namespace structure
