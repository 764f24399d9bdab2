// SPDX-License-Identifier: GPL-2.0-or-later
// The body of the smallest coupled problem.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "nurbs/primitives.h"
#include "structure/body.h"
#include "structure/material/laws.h"

/// A bilinear plate of unit mass on an elastic ground: all its nodes have one frequency.
class OneMode final : public structure::Body {
 public:
  explicit OneMode(double omega) : omega_(omega) {}

  int node_count() const override { return 4; }
  const nurbs::NodalVectors& reference() const override { return plane_.control_points; }
  structure::PatchSpaces patches() const override { return std::vector<nurbs::Space<2>>{plane_.space}; }
  nurbs::BoundarySurface skin(const structure::SkinPiece&) const override {
    return {plane_.space, {0, 1, 2, 3}, 1};
  }
  std::vector<structure::SkinBox> skin_boxes(const structure::SkinPiece&) const override { return {}; }
  structure::ExactSum volume_sum() const override { return sum_of(1.0); }
  std::vector<const structure::Material*> materials() const override { return {&material_}; }
  const Eigen::VectorXd& row_sum_mass() const override { return mass_; }
  void internal_force(const nurbs::NodalVectors& u, nurbs::NodalVectors& f) const override {
    f = 0.25 * omega_ * omega_ * u;
  }
  void evolve(const nurbs::NodalVectors& u, double, nurbs::NodalVectors& f,
              const std::function<void()>& shares_ready) override {
    internal_force(u, f);
    shares_ready();
  }
  void commit() override {}
  const std::vector<double>& memory() const override { return memory_; }
  void set_memory(std::vector<double>) override {}
  structure::ExactSum strain_energy_sum(const nurbs::NodalVectors& u) const override {
    return sum_of(0.125 * omega_ * omega_ * u.squaredNorm());
  }
  int element_count() const override { return 1; }
  int padded_functions(int) const override { return 4; }
  void gather(int, const nurbs::NodalVectors& nodal, double* values) const override {
    const Eigen::Matrix<double, 4, 3> rows = nodal.transpose();
    std::copy_n(rows.data(), rows.size(), values);
  }
  void element_force(int, const double* u, double* f) const override {
    for (int i = 0; i < 12; ++i) f[i] = 0.25 * omega_ * omega_ * u[i];
  }
  const double* element_mass(int) const override { return mass_.data(); }
  double smallest_volume_ratio(int, const double*) const override { return 1.0; }
  std::string describe_element(int) const override { return "the element"; }

 private:
  static structure::ExactSum sum_of(double energy) {
    structure::ExactSum sum;
    sum.add(energy);
    return sum;
  }

  double omega_;
  nurbs::Surface plane_ = nurbs::plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                       {nurbs::KnotVector::uniform(1, 1), nurbs::KnotVector::uniform(1, 1)});
  structure::LinearElastic material_{1.0, 0.0, 1.0};
  Eigen::VectorXd mass_ = Eigen::VectorXd::Constant(4, 0.25);
  std::vector<double> memory_;
};
