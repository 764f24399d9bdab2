// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/static_equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "structure/analysis/conjugate_gradients.h"

namespace structure {

StaticEquilibrium::StaticEquilibrium(const Body& body, const Supports& supports, Loads loads,
                                     const StaticOptions& options, const Springs& springs)
    : body_(body),
      supports_(supports),
      springs_(springs),
      loads_(std::move(loads)),
      options_(options),
      u_(NodalVectors::Zero(3, body.node_count())),
      residual_(u_),
      force_(u_),
      load_(u_),
      tangent_(body, supports, u_, 0.0, springs) {
  expect_held("static", body, supports, springs);
  stiffness_ = mean_stiffness();
  preconditioner_ = make_preconditioner(tangent_, options.preconditioner);
}

double StaticEquilibrium::mean_stiffness() const {
  NodalVectors x(3, u_.cols()), y(x);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = std::sin(1.7 * static_cast<double>(i * i % 1009));
  supports_.apply(x);
  tangent_.multiply(x, y);
  const double size = x.norm();
  return size > 0.0 ? y.norm() / size : 0.0;
}

void StaticEquilibrium::find_residual(double load_factor) {
  body_.internal_force(u_, force_);
  springs_.add_forces(u_, force_);
  loads_(u_, load_);
  reference_ = std::max({load_factor * load_.norm(), force_.norm(), std::numeric_limits<double>::min()});
  residual_ = load_factor * load_ - force_;
  supports_.apply(residual_);
}

/// As far as asked for, or as far as round-off of the internal force lets it be.
bool StaticEquilibrium::is_balanced() const {
  constexpr double kRoundOff = 4.0 * std::numeric_limits<double>::epsilon();
  const double size = residual_.norm();
  return std::isfinite(size) &&
         size <= std::max(options_.tolerance * reference_, kRoundOff * stiffness_ * u_.norm());
}

/// Where a part moves freely it goes so far that round-off balances any load; supports may take it far, too.
bool StaticEquilibrium::is_adrift() const {
  constexpr double kSmall = 1e-3, kFollows = 10.0;
  double led = 0.0;
  for (const Eigen::Index dof : supports_.fixed_dofs()) led = std::max(led, std::abs(u_.data()[dof]));
  return relative_residual() > std::max(kSmall, options_.tolerance) &&
         u_.lpNorm<Eigen::Infinity>() > kFollows * led;
}

// A full step, or half of it where a law does not know what it is asked for.  A search shortens it until
// du . residual is small enough, too: by the secant through the last two.
double StaticEquilibrium::step_along(const NodalVectors& du, double load_factor, bool searches) {
  constexpr double kEnough = 0.8, kLeast = 0.1, kMost = 0.5;
  constexpr int kMostTrials = 10;
  const double start = dot(du, residual_);
  const NodalVectors u_before = u_;
  double step = 1.0;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    u_ = u_before + step * du;
    find_residual(load_factor);
    const double now = dot(du, residual_);
    if (std::isfinite(now) && (!searches || std::abs(now) <= kEnough * std::abs(start) || is_balanced()))
      break;
    const double secant = start / (start - now);
    step *= std::isfinite(secant) && now < 0.0 ? std::clamp(secant, kLeast, kMost) : kMost;
  }
  return step;
}

std::optional<StaticEquilibrium::Failure> StaticEquilibrium::move_supports(double load_factor) {
  constexpr double kEnough = 1e-4;  // Newton's method does the rest
  NodalVectors moved = NodalVectors::Zero(3, u_.cols()), du, force(moved);
  for (const Motion& motion : supports_.motions())
    for (std::size_t k = 0; k < motion.dofs.size(); ++k) {
      const Eigen::Index dof = motion.dofs[k];
      moved.data()[dof] = motion.size[k] * value_at(motion.time, load_factor) - u_.data()[dof];
    }
  if (moved.isZero(0.0)) return {};
  body_.internal_force_change(u_, moved, force);
  supports_.apply(force);
  preconditioner_->update();
  const CgResult cg = conjugate_gradients(tangent_.product(), *preconditioner_, -force, du, {kEnough});
  if (!cg.converged) return Failure{1.0, "the supports' motion is not followed"};
  u_ += moved + du;
  return {};
}

std::optional<StaticEquilibrium::Failure> StaticEquilibrium::newton(double load_factor, bool searches,
                                                                    const OnIteration& on_iteration) {
  constexpr double kLoosest = 0.1, kLinear = 0.1;
  if (auto failure = move_supports(load_factor)) return failure;
  NodalVectors du;
  find_residual(load_factor);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 1; !is_balanced(); ++i) {
    const double now = relative_residual();
    if (i > options_.most_iterations || !std::isfinite(now))
      return Failure{now, "Newton's method does not end"};
    const double least = kLinear * options_.tolerance / now,
                 quadratic = 0.9 * (now / before) * (now / before);
    const double tolerance =
        is_linear(body_) ? least : std::clamp(quadratic, std::min(least, kLoosest), kLoosest);
    preconditioner_->update();
    const CgResult cg =
        conjugate_gradients(tangent_.product(), *preconditioner_, residual_, du, {std::min(tolerance, 0.5)});
    if (cg.is_positive && !cg.converged)
      return Failure{
          now,
          fmt::format("conjugate gradients do not end in {} products: can a part of the body move freely?",
                      cg.products)};
    before = now;
    const double step = step_along(du, load_factor, searches);
    if (on_iteration) on_iteration({load_factor, i, relative_residual(), cg.products, step});
  }
  if (is_adrift())
    return Failure{
        relative_residual(),
        fmt::format("displacements of {:.3g} are round-off: can a part of the body move freely, as "
                    "about an edge that alone holds it?",
                    u_.lpNorm<Eigen::Infinity>())};
  return {};
}

bool StaticEquilibrium::is_folded() const {
  if (is_linear(body_)) return false;
  std::vector<double> u;
  for (int e = 0; e < body_.element_count(); ++e) {
    u.resize(3 * std::size_t(body_.padded_functions(e)));
    body_.gather(e, u_, u.data());
    if (!(body_.smallest_volume_ratio(e, u.data()) > 0.0)) return true;
  }
  return false;
}

// Full steps come first: a slender body that bends is stretched by the first of them, and gets rid of that in
// the next, which a search would be in the way of.
std::optional<StaticEquilibrium::Failure> StaticEquilibrium::load_step(double load_factor,
                                                                       const OnIteration& on_iteration) {
  const NodalVectors u_before = u_;
  std::optional<Failure> failure;
  for (const bool searches : {false, true}) {
    failure = newton(load_factor, searches, on_iteration);
    if (!failure && is_folded()) failure = Failure{relative_residual(), "a volume is folded there"};
    if (!failure) return {};
    u_ = u_before;
    if (is_linear(body_)) break;
  }
  return failure;
}

void StaticEquilibrium::solve(const OnIteration& on_iteration, const OnLoadStep& on_load_step) {
  constexpr double kLeast = 1.0 / 64.0, kRounding = 1e-9;
  const double longest = 1.0 / options_.load_steps;
  u_.setZero();
  double reached = 0.0, increment = longest;
  while (reached < 1.0) {
    const double next = reached + increment > 1.0 - kRounding ? 1.0 : reached + increment;
    if (const std::optional<Failure> failure = load_step(next, on_iteration)) {
      increment *= 0.5;
      if (increment < kLeast * longest || is_linear(body_))
        throw NoEquilibrium(fmt::format(
            "static: no equilibrium beyond load factor {:.6g}: at {:.6g} forces out of balance are {:.3g} of "
            "loads and reactions, expected {:.1g}: {}; try more 'load_steps' than {}, a smaller load (has it "
            "buckled?), or 'analysis: relax'",
            reached, next, failure->residual, options_.tolerance, failure->what, options_.load_steps));
      continue;
    }
    reached = next;
    increment = std::min(longest, 2.0 * increment);
    if (on_load_step) on_load_step(reached);
  }
}

}  // namespace structure
