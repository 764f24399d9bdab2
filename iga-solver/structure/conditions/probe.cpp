// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/probe.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace structure {

nurbs::Vector3 Probe::value(const nurbs::NodalVectors& q) const {
  nurbs::Vector3 sum = nurbs::Vector3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) sum += weights[a] * q.col(nodes[a]);
  return sum;
}

Probe probe_at(std::string name, const nurbs::Space<3>& volume, const nurbs::Parameter<3>& xi) {
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(volume, xi, 0, basis);
  Probe probe{std::move(name), {}, {}};
  for (int a = 0; a < basis.count; ++a) {
    probe.nodes.push_back(basis.control_point[a]);
    probe.weights.push_back(basis.R[a]);
  }
  return probe;
}

nurbs::Parameter<3> face_point(const nurbs::Space<3>& volume, nurbs::Face face,
                               const std::array<double, 2>& at) {
  for (double value : at)
    if (!(value >= 0.0 && value <= 1.0))
      throw std::invalid_argument(fmt::format(
          "face_point: relative parameters are [{}, {}], expected two numbers from 0 to 1", at[0], at[1]));
  const int normal_direction = static_cast<int>(face) / 2;
  const bool plus_side = static_cast<int>(face) % 2 == 1;
  nurbs::Parameter<3> xi;
  int next = 0;
  for (int d = 0; d < 3; ++d) {
    const nurbs::KnotVector& knots = volume.knots(d);
    const double relative = d == normal_direction ? (plus_side ? 1.0 : 0.0) : at[next++];
    xi[d] = (1.0 - relative) * knots.front() + relative * knots.back();
  }
  return xi;
}

}  // namespace structure
