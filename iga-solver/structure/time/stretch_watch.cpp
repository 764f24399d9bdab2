// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/stretch_watch.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "structure/time/stable_time_step.h"

namespace structure {

namespace {

constexpr std::size_t kTurns = 8;

/// Of Q_ij = dP_ix/dH_jx at H.
double acoustic_stiffness(const Material& material, const Matrix3& H) {
  constexpr double kSmall = 1e-6;
  const std::vector<double> no_memory(material.state_size(), 0.0);
  Matrix3 Q;
  for (int j = 0; j < 3; ++j) {
    Matrix3 step = Matrix3::Zero();
    step(j, 0) = kSmall;
    Q.col(j) =
        (material.stress(H + step, no_memory.data()) - material.stress(H - step, no_memory.data())).col(0) /
        (2.0 * kSmall);
  }
  const Matrix3 symmetric = 0.5 * (Q + Q.transpose());
  if (!symmetric.allFinite()) return std::numeric_limits<double>::infinity();
  return Eigen::SelfAdjointEigenSolver<Matrix3>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

double stretched_stiffness(const Material& material, double stretch) {
  Matrix3 along_x = Matrix3::Zero();
  along_x(0, 0) = stretch - 1.0;
  const Matrix3 along_all = (stretch - 1.0) * Matrix3::Identity();
  return std::max(acoustic_stiffness(material, along_x), acoustic_stiffness(material, along_all));
}

namespace {

/// How far the stretch may go from 1 by factors of `step` and no further; `end` if that is as far as it may.
template <class IsAllowed>
double farthest(double step, double end, const IsAllowed& is_allowed) {
  double good = 1.0;
  while ((step > 1.0) == (good < end) && is_allowed(good * step)) good *= step;
  if ((step > 1.0) != (good < end)) return end;
  double bad = good * step;
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (good + bad);
    (is_allowed(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

// Stiffness may grow both ways, as that of a law with ln J does.
StretchLimits stretch_limits(const Material& material, double allowed) {
  constexpr double kStep = 1.01, kMostSquashed = 0.1, kMostStretched = 10.0;
  constexpr double kRounding = 1e-6;  // of a law whose stiffness stays the same
  const double limit = std::max(allowed, 1.0 + kRounding) * stretched_stiffness(material, 1.0);
  const auto is_allowed = [&](double s) { return stretched_stiffness(material, s) <= limit; };
  const double low = farthest(1.0 / kStep, kMostSquashed, is_allowed),
               high = farthest(kStep, kMostStretched, is_allowed);
  return {low > kMostSquashed ? low : 0.0,
          high < kMostStretched ? high : std::numeric_limits<double>::infinity()};
}

bool is_stiffened_by_strain(const Body& body) {
  const std::vector<const Material*> materials = body.materials();
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material* material) { return stretch_limits(*material, 1.0).matter(); });
}

StretchWatch::StretchWatch(const Body& body, double allowed)
    : materials_(body.materials()), allowed_(allowed) {
  if (!set_limits()) return;
  const NodalVectors& X = body.reference();
  for (const auto& [a, b] : body.net_edges())
    if (const double square = (X.col(a) - X.col(b)).squaredNorm(); square > 0.0)
      edges_.push_back({{a, b}, 1.0 / square});
}

bool StretchWatch::set_limits() {
  StretchLimits limits{0.0, std::numeric_limits<double>::infinity()};
  for (const Material* material : materials_) {
    const StretchLimits own = stretch_limits(*material, allowed_);
    limits = {std::max(limits.lowest, own.lowest), std::min(limits.highest, own.highest)};
  }
  lowest_ = limits.lowest * limits.lowest;
  highest_ = limits.highest * limits.highest;
  return limits.matter();
}

bool StretchWatch::look(const NodalVectors& positions) {
  const double* const x = positions.data();
  rung_.reset();
  const std::size_t end = (turn_ + 1) * edges_.size() / kTurns;
  for (std::size_t e = turn_ * edges_.size() / kTurns; e < end; ++e) {
    const double* const a = x + 3 * edges_[e].nodes[0];
    const double* const b = x + 3 * edges_[e].nodes[1];
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    const double square = (dx * dx + dy * dy + dz * dz) * edges_[e].per_square;
    if (!(square > highest_ || square < lowest_)) continue;
    if (!rung_ || std::abs(std::log(square)) > 2.0 * std::abs(std::log(rung_->stretch)))
      rung_ = {edges_[e].nodes[0], std::sqrt(square)};
  }
  turn_ = (turn_ + 1) % kTurns;
  return rung_.has_value();
}

void StretchWatch::allow_more(double factor) {
  allowed_ *= factor;
  set_limits();
}

std::string describe_too_strained(const Body& body, const Halo& halo, const StretchWatch& watch,
                                  const WatchedStep& step) {
  const std::optional<StretchWatch::Edge>& edge = watch.rung();
  const Id id = edge ? halo.node_id(edge->node) : -1;
  const std::string where =
      halo.words_of_largest(edge ? std::abs(std::log(edge->stretch)) : kNowhere, id, [&] {
        return fmt::format(", {:.3g} times as long at control node {}, undeformed at {}", edge->stretch, id,
                           text(body.reference().col(edge->node)));
      });
  return fmt::format(
      "at time {:.6g} the solid is strained so much that its stable step, {} at the start, is {} and "
      "below the time step {:.6g}{}; use a time step with room for that, or smaller loads",
      step.time, step_text(step.stable_at_start), step_text(step.stable_now), step.time_step, where);
}

}  // namespace structure
