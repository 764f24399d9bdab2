// SPDX-License-Identifier: GPL-2.0-or-later
#include "volumes.h"

#include <random>
#include <stdexcept>

#include "nurbs/primitives.h"

namespace benchmarks {

using nurbs::KnotVector;
using nurbs::NodalVectors;
using nurbs::Vector3;
using nurbs::Volume;

namespace {

/// Part of an element's edge by which control points move; further, elements would fold.
constexpr double kDistortion = 0.1;

Volume distorted(Volume plate, const Vector3& element_size) {
  plate.control_points +=
      element_size.asDiagonal() * random_displacements(plate.space.control_point_count(), kDistortion);
  return plate;
}

Volume with_weights(const Volume& plate) {
  const NodalVectors spread = random_displacements(plate.space.control_point_count(), 0.1);
  std::vector<double> weights;
  for (const auto& w : spread.colwise()) weights.push_back(1.0 + w.x());
  return {nurbs::Space<3>(plate.space.knots(), weights), plate.control_points};
}

}  // namespace

Volume make_volume(const std::string& name, const std::array<int, 3>& elements, int degree) {
  const Vector3 size(0.61, 0.61, kThickness);
  const auto along = [&](int d) { return KnotVector::uniform(degree, elements[d]); };
  const Volume plate = nurbs::box({-0.305, -0.305, -kThickness}, size, {along(0), along(1), along(2)});
  if (name == "plate") return plate;
  if (name == "distorted")
    return distorted(plate, size.cwiseQuotient(Vector3(elements[0], elements[1], elements[2])));
  if (name == "rational") return with_weights(plate);
  throw std::invalid_argument("body is \"" + name + "\", expected plate, distorted or rational");
}

NodalVectors random_displacements(int nodes, double amount) {
  std::mt19937 random(2019);
  std::uniform_real_distribution<double> anywhere(-amount, amount);
  return NodalVectors::NullaryExpr(3, nodes, [&] { return anywhere(random); });
}

}  // namespace benchmarks
