// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/gradient_products.h"

#include <cmath>

namespace structure {

namespace {

constexpr std::size_t kMostBytes = 64u << 20;  // 1,200 quadratic elements, 200 cubic ones

std::size_t bytes_of(const Eigen::MatrixXd& products) {
  return sizeof(double) * static_cast<std::size_t>(products.size());
}

}  // namespace

GradientProducts::GradientProducts(const ReferenceBody& body) : body_(body) {
  for (const nurbs::Volume& patch : body.patches) tabulators_.emplace_back(patch.space, body.quadrature);
}

void GradientProducts::begin_patch() {
  for (auto next = remembered_.begin(); next != remembered_.end();)
    if (next->second.patch != patch_) {
      bytes_ -= bytes_of(next->second.products);
      next = remembered_.erase(next);
    } else {
      ++next;
    }
  ++patch_;
}

const Eigen::MatrixXd& GradientProducts::of(const BodyElement& element) {
  const auto found = remembered_.find(element);
  if (found != remembered_.end()) {
    found->second.patch = patch_;
    return found->second.products;
  }
  integrate(element, scratch_);
  if (bytes_ + bytes_of(scratch_) <= kMostBytes) {
    bytes_ += bytes_of(scratch_);
    remembered_[element] = {scratch_, patch_};
  }
  return scratch_;
}

void GradientProducts::integrate(const BodyElement& element, Eigen::MatrixXd& products) {
  ++integrated_;
  const nurbs::Volume& volume = body_.patches[element.patch];
  const int n = volume.space.functions_per_element();
  control_points_.resize(n);
  volume.space.element_control_points(element.element, control_points_.data());
  tabulators_[element.patch](element.element, {volume.control_points, control_points_}, tables_);
  weighted_.resize(3 * n, tables_.points);
  for (int q = 0; q < tables_.points; ++q)
    for (int i = 0; i < 3; ++i)
      weighted_.col(q).segment(i * n, n) =
          std::sqrt(tables_.wJ[q]) * Eigen::VectorXd::Map(&tables_.dR_dX[(3 * q + i) * tables_.padded], n);
  products.setZero(3 * n, 3 * n);
  products.selfadjointView<Eigen::Lower>().rankUpdate(weighted_);
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
}

}  // namespace structure
