// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/compliance_tables.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structure/compliance/alike_elements.h"
#include "structure/material/isotropic_elastic.h"

namespace structure {

namespace {

constexpr int kLowestDegree = 2, kHighestDegree = 3;

void expect_law(const Material& law) {
  if (dynamic_cast<const IsotropicElastic*>(&law) == nullptr || law.state_size() > 0)
    throw std::invalid_argument(fmt::format(
        "local compliances are known of isotropic elastic materials without memory, given '{}'", law.law()));
}

void expect_degrees(const nurbs::Space<3>& space) {
  for (int d = 0; d < 3; ++d)
    if (const int p = space.degree(d); p < kLowestDegree || p > kHighestDegree)
      throw std::invalid_argument(
          fmt::format("local compliances are known for degrees {} and {}, given {}, {}, {}", kLowestDegree,
                      kHighestDegree, space.degree(0), space.degree(1), space.degree(2)));
}

// Under so few points the mesh's answer is not local: on cubes it still changes by 1 % from 5 to 6 layers.
void expect_quadrature(Quadrature quadrature) {
  if (quadrature == Quadrature::zou)
    throw std::invalid_argument(
        "local compliances are known for quadratures 'full' and 'reduced', given 'zou'");
}

/// p + 1 layers of elements around the one that is hit.
LocalExtent extent_for(const nurbs::Space<3>& space) {
  return {std::max({space.degree(0), space.degree(1), space.degree(2)}) + 1};
}

/// Row k of the result: coefficient of s^k of the polynomials that are 1 at one of the points and 0 at the
/// others.
Eigen::MatrixXd to_powers(int count) {
  const std::vector<double> points = lobatto_points(count);
  Eigen::MatrixXd powers(count, count);
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) powers(i, k) = std::pow(points[i], k);
  return powers.inverse();
}

}  // namespace

std::vector<double> lobatto_points(int count) {
  std::vector<double> points(count);
  for (int i = 0; i < count; ++i) points[i] = -std::cos(nurbs::kPi * i / (count - 1));
  return points;
}

ComplianceTable::ComplianceTable(const std::array<int, 2>& counts,
                                 const std::vector<std::vector<double>>& values)
    : kernel_(table_kernel(nurbs::simd_level())),
      counts_(counts),
      largest_normal_(*std::max_element(values[normal].begin(), values[normal].end())) {
  const Eigen::MatrixXd of_s = to_powers(counts[0]), of_t = to_powers(counts[1]);
  double* next = powers_.data();
  for (const std::vector<double>& component : values) {
    const Eigen::MatrixXd powers =
        of_s * Eigen::MatrixXd::Map(component.data(), counts[0], counts[1]) * of_t.transpose();
    next = std::copy_n(powers.data(), powers.size(), next);
  }
  const int count = counts[0] * counts[1];
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < kTogether; ++c) together_[k * kTogether + c] = powers_[c * count + k];
}

namespace {

/// A polynomial in s and t, and its derivatives.
struct Polynomial {
  Polynomial(const double* first, const std::array<int, 2>& counts, double s, double t) {
    const double* next = first + static_cast<std::ptrdiff_t>(counts[0]) * counts[1];
    for (int j = counts[1]; j > 0; --j) {
      double row = *--next, change = 0.0;
      for (int i = counts[0] - 1; i > 0; --i) {
        change = change * s + row;
        row = row * s + *--next;
      }
      by_t = by_t * t + value;
      value = value * t + row;
      by_s = by_s * t + change;
    }
  }
  double value = 0.0, by_s = 0.0, by_t = 0.0;
};

/// An element's own parameter, from -1 to 1, and its change with that of the patch.
struct OwnParameter {
  OwnParameter(double low, double high, double xi)
      : change(2.0 / (high - low)), value(change * (xi - low) - 1.0) {}
  double change, value;
};

}  // namespace

ComplianceTable::Value ComplianceTable::at(Component component, const nurbs::Parameter<2>& low,
                                           const nurbs::Parameter<2>& high,
                                           const nurbs::Parameter<2>& xi) const {
  const double* const first = powers_.data() + static_cast<std::size_t>(component) * counts_[0] * counts_[1];
  const OwnParameter s(low[0], high[0], xi[0]), t(low[1], high[1], xi[1]);
  const Polynomial at(first, counts_, s.value, t.value);
  return {at.value, {at.by_s * s.change, at.by_t * t.change}};
}

std::array<ComplianceTable::Value, ComplianceTable::kTogether> ComplianceTable::together(
    const nurbs::Parameter<2>& low, const nurbs::Parameter<2>& high, const nurbs::Parameter<2>& xi) const {
  const OwnParameter s(low[0], high[0], xi[0]), t(low[1], high[1], xi[1]);
  static_assert(kTogether == FourPolynomials::kCount);
  FourPolynomials at;
  kernel_(together_.data(), counts_[0], counts_[1], s.value, t.value, at);
  std::array<Value, kTogether> values;
  for (int k = 0; k < kTogether; ++k)
    values[k] = {at.value[k], {at.by_s[k] * s.change, at.by_t[k] * t.change}};
  return values;
}

ComplianceTables::ComplianceTables(ReferenceBody body, std::vector<SkinPiece> skin)
    : body_(std::move(body)), near_(body_), gradients_(body_), skin_(std::move(skin)) {
  expect_quadrature(body_.quadrature);
  for (const SkinPiece& piece : skin_) {
    const nurbs::Volume& patch = body_.patches[piece.patch];
    expect_law(*body_.materials[piece.patch]);
    expect_degrees(patch.space);
    surfaces_.emplace_back(body_, piece);
    tables_.emplace_back(surfaces_.back().space().element_count());
    known_.emplace_back(tables_.back().size(), nullptr);
    const int d = static_cast<int>(piece.face) / 2;
    const LocalExtent extent = extent_for(patch.space);
    alike_.push_back(
        {alike_elements(patch, d == 0 ? 1 : 0, extent), alike_elements(patch, d == 2 ? 1 : 2, extent)});
  }
}

LocalPatch ComplianceTables::patch_of(const HitElement& hit) const {
  return {body_, near_, hit.volume(), extent_for(body_.patches[hit.volume().patch].space)};
}

std::unique_ptr<ComplianceTable> ComplianceTables::solve(int piece, const HitElement& hit) const {
  std::vector<double> points[2];
  std::array<int, 2> counts;
  for (int d = 0; d < 2; ++d) {
    counts[d] = 2 * surfaces_[piece].space().degree(d) + 1;
    for (const double s : lobatto_points(counts[d]))
      points[d].push_back(0.5 * ((1.0 - s) * hit.low()[d] + (1.0 + s) * hit.high()[d]));
  }
  std::vector<SkinPoint> feet;
  std::vector<Matrix3> frames;
  for (const double eta : points[1])
    for (const double xi : points[0]) {
      feet.push_back(hit.foot({xi, eta}));
      frames.push_back(hit.frame({xi, eta}));
    }
  const LocalPatch patch = patch_of(hit);
  const std::vector<Matrix3> tensors = LocalProblem(patch, gradients_).compliances(feet);
  std::vector<std::vector<double>> values(ComplianceTable::kComponents);
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const Matrix3 c = frames[f].transpose() * tensors[f] * frames[f];
    const double components[] = {c(2, 2),
                                 c(0, 0),
                                 c(1, 1),
                                 0.5 * (c(0, 1) + c(1, 0)),
                                 0.5 * (c(0, 2) + c(2, 0)),
                                 0.5 * (c(1, 2) + c(2, 1))};
    for (int k = 0; k < ComplianceTable::kComponents; ++k) values[k].push_back(components[k]);
  }
  return std::make_unique<ComplianceTable>(counts, values);
}

const ComplianceTable& ComplianceTables::find(int piece, int element) {
  const nurbs::Space<2>& space = surfaces_[piece].space();
  nurbs::Indices<2> span = space.element_indices(element);
  for (int d = 0; d < 2; ++d) span[d] = alike_[piece][d][span[d]];
  const int first = space.element_index(span);
  std::unique_ptr<ComplianceTable>& table = tables_[piece][first];
  if (table) return *(known_[piece][element] = table.get());
  try {
    table = solve(piece, {body_, near_, skin_[piece], surfaces_[piece], first});
  } catch (const std::invalid_argument& problem) {
    const Vector3 X = surfaces_[piece].at_centre(element);
    throw std::invalid_argument(
        fmt::format("no local compliance of the element about ({:.6g}, {:.6g}, {:.6g}): {}", X[0], X[1], X[2],
                    problem.what()));
  }
  ++made_;
  return *(known_[piece][element] = table.get());
}

Matrix3 ComplianceTables::direct(int piece, int element, const nurbs::Parameter<2>& xi) const {
  const HitElement hit(body_, near_, skin_[piece], surfaces_[piece], element);
  const LocalPatch patch = patch_of(hit);
  return LocalProblem(patch, gradients_).compliances({hit.foot(xi)}).front();
}

}  // namespace structure
