// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/element_watch.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace structure {

/// Of an element's nodes.
struct ElementWatch::Fit {
  Matrix3 H;               // F - I
  double spacing;          // of the nodes, the least of three directions [length]
  double residual;         // largest |u - c - H X| [length]
  double slope_of_spline;  // bound of |du/dX| where control points are 1 from 0, times the spacing
};

namespace {

/// Columns of a nodal array about their mean.
Eigen::Matrix3Xd centred(const NodalVectors& values, const std::vector<int>& nodes) {
  Eigen::Matrix3Xd own = values(Eigen::all, nodes);
  own.colwise() -= Vector3(own.rowwise().mean());
  return own;
}

double degrees_of_rotation(const Matrix3& F) {
  const Eigen::JacobiSVD<Matrix3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3 R = svd.matrixU() * svd.matrixV().transpose();
  return std::acos(std::clamp(0.5 * (R.trace() - 1.0), -1.0, 1.0)) * 180.0 / std::acos(-1.0);
}

}  // namespace

// n nodes per direction a spacing h apart have the variance (n^2 - 1) h^2 / 12; derivatives of B-splines of
// degree p = n - 1 add up to at most 2 p / h.
ElementWatch::Fit ElementWatch::fit(const Body& body, const NodalVectors& u, int element) {
  const std::vector<int> nodes = body.element_nodes(element);
  const double n = std::cbrt(static_cast<double>(nodes.size()));
  const Eigen::Matrix3Xd X = centred(body.reference(), nodes), v = centred(u, nodes);
  const Matrix3 spread = X * X.transpose();
  const double least =
      Eigen::SelfAdjointEigenSolver<Matrix3>().computeDirect(spread, Eigen::EigenvaluesOnly).eigenvalues()[0];
  Fit fit{Matrix3::Zero(), 0.0, 0.0, 2.0 * (n - 1.0)};
  if (!(least > 1e-12 * spread.trace())) return fit;  // no volume: a body that is none
  fit.spacing = std::sqrt(12.0 * least / (static_cast<double>(nodes.size()) * (n * n - 1.0)));
  fit.H = v * X.transpose() * spread.inverse();
  fit.residual = (v - fit.H * X).colwise().norm().maxCoeff();
  return fit;
}

void ElementWatch::look_at(const Body& body, const NodalVectors& u, int element) {
  const Fit seen = fit(body, u, element);
  if (seen.spacing == 0.0) return;
  smallest_so_far_ = std::min(smallest_so_far_, seen.spacing);
  constexpr double kSmall = 0.05;  // less than the sine of kLargestTurn
  const double strain_beside = seen.slope_of_spline * seen.residual / seen.spacing;
  if (seen.H.norm() + strain_beside < kSmall || !seen.H.allFinite()) return;
  const Matrix3 F = Matrix3::Identity() + seen.H;
  const double det_F = F.determinant();
  if (body.element_material(element).is_small_strain()) {
    // What is inside out is no rotation and a stretch: it counts as half a turn.
    const double turn = det_F > 0.0 ? degrees_of_rotation(F) : 180.0;
    if (!turned_ && turn > kLargestTurn) turned_ = {element, turn, det_F <= 0.0};
  } else if (!folded_ && (det_F <= 0.0 || F.jacobiSvd().singularValues()[2] < strain_beside)) {
    values_.resize(3 * static_cast<std::size_t>(body.padded_functions(element)));
    body.gather(element, u, values_.data());
    const double ratio = body.smallest_volume_ratio(element, values_.data());
    if (ratio <= 0.0) folded_ = {element, ratio, true};
  }
}

// No element of nodes h apart turns by 3 degrees, or folds, while no component of u is above h/100.
void ElementWatch::look(const Body& body, const NodalVectors& u, double largest_u) {
  constexpr double kFarTooSmall = 0.01;
  if (largest_u < kFarTooSmall * smallest_) return;
  constexpr double kLeast = 1.0 / 64.0;  // of a small body, which is cheap to look at
  const int count = body.element_count();
  if (count == 0) return;  // a part with none
  for (due_ += std::max(kLeast, static_cast<double>(count) / kTurns); due_ >= 1.0; due_ -= 1.0) {
    look_at(body, u, next_);
    next_ = (next_ + 1) % count;
    if (next_ == 0) smallest_ = smallest_so_far_;
  }
}

void ElementWatch::look_at_all(const Body& body, const NodalVectors& u) {
  for (int e = 0; e < body.element_count(); ++e) look_at(body, u, e);
}

std::string describe_turned(const Body& body, const Halo& halo, const ElementWatch& watch, double time) {
  const std::optional<ElementWatch::Seen>& seen = watch.turned();
  const Id id = seen ? halo.element_id(seen->element) : -1;
  return halo.words_of_largest(seen ? seen->value : kNowhere, id, [&] {
    if (seen->is_folded)
      return fmt::format(
          "at time {:.6g} element {} ({}) is inside out, which its law {}, of small strain, does not know: "
          "loads, contact forces or initial velocities are too large for it, or the mesh is too coarse there",
          time, id, body.describe_element(seen->element), body.element_material(seen->element).law());
    return fmt::format(
        "at time {:.6g} element {} ({}) is turned by {:.3g} degrees, and its law {}, of small strain, takes "
        "turning for strain: use saint_venant_kirchhoff or neo_hooke beyond {:g} degrees",
        time, id, body.describe_element(seen->element), seen->value,
        body.element_material(seen->element).law(), ElementWatch::kLargestTurn);
  });
}

std::string describe_folded(const Body& body, const Halo& halo, const ElementWatch& watch, double time) {
  const std::optional<ElementWatch::Seen>& seen = watch.folded();
  const Id id = seen ? halo.element_id(seen->element) : -1;
  return halo.words_of_largest(seen ? -seen->value : kNowhere, id, [&] {
    return fmt::format(
        "at time {:.6g} element {} ({}) is folded, det F = {:.3g}: loads, contact forces or initial "
        "velocities are too large for the law {}, or the mesh is too coarse there",
        time, id, body.describe_element(seen->element), seen->value,
        body.element_material(seen->element).law());
  });
}

}  // namespace structure
