// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/stable_time_step.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace structure {

namespace {

/// Entries in [-1, 1], the same on every machine (std::uniform_real_distribution would differ between
/// libraries).
NodalVectors start_vector(int nodes) {
  std::mt19937 generator(1);
  NodalVectors v(3, nodes);
  for (double& value : v.reshaped()) value = 2.0 * generator() / double(std::mt19937::max()) - 1.0;
  return v;
}

double mean_element_size(const Body& body, const Halo& halo) {
  return std::cbrt(halo.sum(body.volume()) / halo.sum(double(body.element_count())));
}

/// Of trial displacements for the derivative of the internal force [-]: any law is linear there, and rounding
/// still leaves ten digits.
constexpr double kSmallStrain = 1e-6;

/// Numbers that are not finite make no eigenvalues: iterations on them never end.
void expect_finite(double value, const Body& body, const NodalVectors& u, double element_size,
                   const std::string& where) {
  if (std::isfinite(value)) return;
  const Material& material = body.material();
  throw std::runtime_error(fmt::format(
      "stable_time_step: stiffness over mass is no finite number {}; likely cause: {}", where,
      u.allFinite()
          ? fmt::format(
                "sizes that overflow: Young's modulus {:.3g}, density {:.3g}, elements of about {:.3g}",
                material.youngs_modulus(), material.density(), element_size)
          : "displacements that are not finite, of a solid that has blown up"));
}

/// Largest eigenvalue of the symmetric tridiagonal matrix with these diagonals.
double largest_ritz_value(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const Eigen::Map<const Eigen::VectorXd> diagonal(alpha.data(), alpha.size());
  const Eigen::Map<const Eigen::VectorXd> subdiagonal(beta.data(), alpha.size() - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, subdiagonal, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

/// Largest eigenvalue of M^-1 K [1/time^2]: power iteration that takes the best of the space of all its
/// iterates, by the three-term recurrence of Lanczos (1950) for forces q with the inner product q . M^-1 q.
double largest_eigenvalue(const Body& body, const MassOperator& mass, const Supports& supports,
                          const NodalVectors& u, const Halo& halo) {
  constexpr double kTolerance = 5e-4;  // gain of the eigenvalue over one check interval
  constexpr int kCheckInterval = 10, kMaxIterations = 1000;
  const double element_size = mean_element_size(body, halo), trial_size = kSmallStrain * element_size;
  const auto internal_force = [&](const NodalVectors& displacements, NodalVectors& f) {
    body.internal_force(displacements, f);
    halo.sum_to_owners(f);
  };
  const auto accelerations = [&](const NodalVectors& f, NodalVectors& a) {
    mass.apply_inverse_mass(f, a);
    halo.owners_to_ghosts(a);
  };
  NodalVectors q = start_vector(body.node_count()), z(q), q_previous(NodalVectors::Zero(3, q.cols()));
  NodalVectors trial(q), f_0(q), w(q);
  internal_force(u, f_0);
  supports.apply(q);
  accelerations(q, z);
  double norm = std::sqrt(halo.dot(q, z)), eigenvalue = 0.0;
  if (norm == 0.0) return 0.0;
  expect_finite(norm, body, u, element_size, "in the solid");
  std::vector<double> alpha, beta;
  for (int k = 1; k <= kMaxIterations; ++k) {
    q /= norm;
    z /= norm;
    const double scale = trial_size / halo.largest(halo.own(z).cwiseAbs().maxCoeff());
    trial = u + scale * z;
    internal_force(trial, w);
    w = (w - f_0) / scale - norm * q_previous;  // q_previous is 0 in the first iteration
    supports.apply(w);
    alpha.push_back(halo.dot(w, z));
    w -= alpha.back() * q;
    accelerations(w, z);
    norm = std::sqrt(halo.dot(w, z));
    beta.push_back(norm);
    expect_finite(alpha.back() + norm, body, u, element_size, "in the solid");
    const bool exhausted = norm <= 1e-9 * alpha.front();  // the iterates span an invariant space
    if (k % kCheckInterval == 0 || exhausted) {
      const double previous = std::exchange(eigenvalue, largest_ritz_value(alpha, beta));
      if (exhausted || eigenvalue - previous <= kTolerance * eigenvalue) return eigenvalue;
    }
    q_previous.swap(q);
    q.swap(w);
  }
  throw std::runtime_error(
      fmt::format("stable_time_step: the iteration did not converge in {} steps; last eigenvalue {} 1/time^2",
                  kMaxIterations, eigenvalue));
}

/// Values of one element as one vector, [direction][padded function].
Eigen::ArrayXd gathered(const Body& body, int element, const NodalVectors& nodal) {
  Eigen::ArrayXd values(3 * body.padded_functions());
  body.gather(element, nodal, values.data());
  return values;
}

/// The bounds of one element: those of its highest free mode, by power iteration from `start`; 0 if it has
/// none.
EigenvalueBounds element_bounds(const Body& body, int e, const NodalVectors& u, const NodalVectors& start,
                                const NodalVectors& whole_mass, double trial_size) {
  constexpr int kIterations = 30;
  const Eigen::ArrayXd u_e = gathered(body, e, u), m_whole = gathered(body, e, whole_mass);
  const Eigen::ArrayXd m =
      Eigen::Map<const Eigen::ArrayXd>(body.element_mass(e), u_e.size() / 3).replicate(3, 1);
  Eigen::ArrayXd v = gathered(body, e, start), f_0(u_e), f(u_e);
  const Eigen::ArrayXd free_e = (v != 0.0).cast<double>();
  if ((v == 0.0).all()) return {0.0, 0.0};
  body.element_force(e, u_e.data(), f_0.data());
  for (int k = 0;; ++k) {
    const Eigen::ArrayXd trial = u_e + trial_size * v;
    body.element_force(e, trial.data(), f.data());
    f = (f - f_0) / trial_size;
    if (k == kIterations) break;
    v = (m > 0.0).select(free_e * f / m, 0.0);
    v /= v.abs().maxCoeff();
  }
  return {(f * v).sum() / (m_whole * v * v).sum(), (f * v).sum() / (m * v * v).sum()};
}

}  // namespace

EigenvalueBounds element_eigenvalue_bounds(const Body& body, const Supports& supports, const NodalVectors& u,
                                           const Halo& halo) {
  const double element_size = mean_element_size(body, halo);
  const NodalVectors whole_mass = Eigen::Vector3d::Ones() * whole(halo, body.row_sum_mass()).transpose();
  NodalVectors start = start_vector(body.node_count());
  supports.apply(start);
  EigenvalueBounds bounds{0.0, 0.0};
  double sum = 0.0;  // not finite if one of them is not
  std::string where = "in an element of another part";
  for (int e = 0; e < body.element_count() && std::isfinite(sum); ++e) {
    const EigenvalueBounds own = element_bounds(body, e, u, start, whole_mass, kSmallStrain * element_size);
    sum = own.low + own.high;
    if (!std::isfinite(sum)) where = fmt::format("in element {}", e);
    bounds.low = std::max(bounds.low, own.low);
    bounds.high = std::max(bounds.high, own.high);
  }
  expect_finite(halo.largest(sum), body, u, element_size, where);
  return {halo.largest(bounds.low), halo.largest(bounds.high)};
}

double stable_time_step(const Body& body, const MassOperator& mass, const Supports& supports,
                        const NodalVectors& u, const Halo& halo) {
  const double eigenvalue = largest_eigenvalue(body, mass, supports, u, halo);
  if (eigenvalue == 0.0) {
    NodalVectors free = NodalVectors::Ones(3, body.node_count());
    supports.apply(free);
    if (halo.sum(halo.own(free).sum()) > 0.0)
      expect_finite(std::numeric_limits<double>::quiet_NaN(), body, u, mean_element_size(body, halo),
                    "> 0 in the solid");
    return std::numeric_limits<double>::infinity();
  }
  const EigenvalueBounds bounds = element_eigenvalue_bounds(body, supports, u, halo);
  if (!(eigenvalue > 0.99 * bounds.low && eigenvalue < 1.05 * bounds.high))
    throw std::logic_error(
        fmt::format("stable_time_step: largest eigenvalue {} 1/time^2 lies outside the element bounds {} to "
                    "{}: the internal "
                    "force is not the gradient of an energy, or the masses do not belong to it",
                    eigenvalue, bounds.low, bounds.high));
  return 2.0 / std::sqrt(eigenvalue);
}

}  // namespace structure
