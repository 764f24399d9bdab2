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

double mean_element_size(const Body& body) { return std::cbrt(body.volume() / body.element_count()); }

/// Trial displacement for the derivative of the internal force [length]: strains of about 1e-6, where any law
/// is linear and rounding still leaves ten digits.
double small_displacement(const Body& body) { return 1e-6 * mean_element_size(body); }

/// Numbers that are not finite make no eigenvalues: iterations on them never end.
void expect_finite(double value, const Body& body, const NodalVectors& u, const std::string& where) {
  if (std::isfinite(value)) return;
  const Material& material = body.material();
  throw std::runtime_error(fmt::format(
      "stable_time_step: stiffness over mass is no finite number {}; likely cause: {}", where,
      u.allFinite()
          ? fmt::format(
                "sizes that overflow: Young's modulus {:.3g}, density {:.3g}, elements of about {:.3g}",
                material.youngs_modulus(), material.density(), mean_element_size(body))
          : "displacements that are not finite, of a solid that has blown up"));
}

double dot(const NodalVectors& a, const NodalVectors& b) { return a.cwiseProduct(b).sum(); }

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
                          const NodalVectors& u) {
  constexpr double kTolerance = 5e-4;  // gain of the eigenvalue over one check interval
  constexpr int kCheckInterval = 10, kMaxIterations = 1000;
  const double trial_size = small_displacement(body);
  NodalVectors q = start_vector(body.node_count()), z(q), q_previous(NodalVectors::Zero(3, q.cols()));
  NodalVectors trial(q), f_0(q), w(q);
  body.internal_force(u, f_0);
  supports.apply(q);
  mass.apply_inverse_mass(q, z);
  double norm = std::sqrt(dot(q, z)), eigenvalue = 0.0;
  if (norm == 0.0) return 0.0;
  expect_finite(norm, body, u, "in the solid");
  std::vector<double> alpha, beta;
  for (int k = 1; k <= kMaxIterations; ++k) {
    q /= norm;
    z /= norm;
    const double scale = trial_size / z.cwiseAbs().maxCoeff();
    trial = u + scale * z;
    body.internal_force(trial, w);
    w = (w - f_0) / scale - norm * q_previous;  // q_previous is 0 in the first iteration
    supports.apply(w);
    alpha.push_back(dot(w, z));
    w -= alpha.back() * q;
    mass.apply_inverse_mass(w, z);
    norm = std::sqrt(dot(w, z));
    beta.push_back(norm);
    expect_finite(alpha.back() + norm, body, u, "in the solid");
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

}  // namespace

EigenvalueBounds element_eigenvalue_bounds(const Body& body, const Supports& supports,
                                           const NodalVectors& u) {
  constexpr int kIterations = 30;
  const double scale = small_displacement(body);
  const NodalVectors start = start_vector(body.node_count());
  const NodalVectors whole_mass = Eigen::Vector3d::Ones() * body.row_sum_mass().transpose();
  NodalVectors free = NodalVectors::Ones(3, body.node_count());
  supports.apply(free);
  EigenvalueBounds bounds{0.0, 0.0};
  for (int e = 0; e < body.element_count(); ++e) {
    const Eigen::ArrayXd u_e = gathered(body, e, u), free_e = gathered(body, e, free);
    const Eigen::ArrayXd m_whole = gathered(body, e, whole_mass);
    const Eigen::ArrayXd m =
        Eigen::Map<const Eigen::ArrayXd>(body.element_mass(e), u_e.size() / 3).replicate(3, 1);
    Eigen::ArrayXd v = gathered(body, e, start) * free_e, f_0(u_e), f(u_e);
    if ((v == 0.0).all()) continue;
    body.element_force(e, u_e.data(), f_0.data());
    for (int k = 0;; ++k) {
      const Eigen::ArrayXd trial = u_e + scale * v;
      body.element_force(e, trial.data(), f.data());
      f = (f - f_0) / scale;
      if (k == kIterations) break;
      v = (m > 0.0).select(free_e * f / m, 0.0);
      v /= v.abs().maxCoeff();
    }
    const double low = (f * v).sum() / (m_whole * v * v).sum(), high = (f * v).sum() / (m * v * v).sum();
    expect_finite(low + high, body, u, fmt::format("in element {}", e));
    bounds.low = std::max(bounds.low, low);
    bounds.high = std::max(bounds.high, high);
  }
  return bounds;
}

double stable_time_step(const Body& body, const MassOperator& mass, const Supports& supports,
                        const NodalVectors& u) {
  const double eigenvalue = largest_eigenvalue(body, mass, supports, u);
  if (eigenvalue == 0.0) {
    if (supports.fixed_dofs().size() < 3 * std::size_t(body.node_count()))
      expect_finite(std::numeric_limits<double>::quiet_NaN(), body, u, "> 0 in the solid");
    return std::numeric_limits<double>::infinity();
  }
  const EigenvalueBounds bounds = element_eigenvalue_bounds(body, supports, u);
  if (!(eigenvalue > 0.99 * bounds.low && eigenvalue < 1.05 * bounds.high))
    throw std::logic_error(
        fmt::format("stable_time_step: largest eigenvalue {} 1/time^2 lies outside the element bounds {} to "
                    "{}: the internal "
                    "force is not the gradient of an energy, or the masses do not belong to it",
                    eigenvalue, bounds.low, bounds.high));
  return 2.0 / std::sqrt(eigenvalue);
}

}  // namespace structure
