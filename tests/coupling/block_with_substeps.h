// SPDX-License-Identifier: GPL-2.0-or-later
// A block that takes sub-steps, and what pushes it.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "coupling/force_distribution.h"
#include "coupling/substeps.h"
#include "nurbs/primitives.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"

namespace test {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::Vector3;

enum class Ground { none, fixed, moves };

/// A block of 3 x 3 x 2 elements, held at nodes of its surface, too.
inline std::unique_ptr<coupling::IgaStructure> small_block(
    Ground ground = Ground::none, std::shared_ptr<const structure::Material> material = {},
    structure::TimeMass mass = structure::TimeMass::lumped,
    std::unique_ptr<const structure::Halo> halo = std::make_unique<const structure::Halo>()) {
  const auto knots = [](int n) { return nurbs::KnotVector::uniform(2, n); };
  nurbs::Volume patch = nurbs::box({0, 0, -2}, {3, 3, 2}, {knots(3), knots(3), knots(2)});
  structure::Supports supports;
  const auto hold = [&](nurbs::Face face, const std::array<bool, 3>& directions) {
    const structure::NodeSet nodes = structure::nodes_on(patch.space, {face});
    if (ground == Ground::fixed) supports.fix(nodes, directions);
    if (ground == Ground::moves)
      supports.move(nodes, directions, {0.01, 0, -0.02}, [](double t) { return t + 0.1 * t * t; });
  };
  hold(nurbs::Face::zeta_minus, {true, true, true});
  hold(nurbs::Face::xi_minus, {false, false, true});
  if (!material) material = std::make_shared<structure::LinearElastic>(1.0, 0.3, 1.0);
  structure::ExplicitSolver solver(
      std::make_unique<structure::Solid>(std::move(patch), material, structure::Integration{{}, {}, mass}),
      supports, std::move(halo));
  solver.set_load(structure::gravity_load(solver.body(), {1e-4, 0, -2e-4}));
  return std::make_unique<coupling::IgaStructure>(
      std::move(solver), std::vector<structure::SkinPiece>{{0, nurbs::Face::zeta_plus}});
}

inline NodalVectors on_surface(const coupling::StructureSolver& body, const NodalVectors& nodal) {
  NodalVectors values;
  body.surface().map.to_surface(nodal, values);
  return values;
}

/// A force that follows the surface and drags at it, so that it depends on places and velocities.
inline NodalForces forces_on(const coupling::StructureSolver& body) {
  const auto& topology = body.surface().topology;
  const NodalVectors x = on_surface(body, body.positions()), v = on_surface(body, body.velocities());
  NodalVectors spread = NodalVectors::Zero(3, topology.control_point_count());
  const coupling::FootBasis foot(topology, {0, {0.3, 0.7}});
  Vector3 at = Vector3::Zero(), speed = Vector3::Zero();
  for (int k = 0; k < spread.cols(); ++k) {
    NodalVectors unit = NodalVectors::Zero(3, spread.cols());
    foot.distribute(Vector3(1, 0, 0), unit);
    at += unit(0, k) * x.col(k), speed += unit(0, k) * v.col(k);
  }
  foot.distribute(Vector3(1e-3, 0, -5e-3) - 0.05 * (at - Vector3(0.9, 2.1, 0)) - 0.01 * speed, spread);
  NodalVectors forces = NodalVectors::Zero(3, body.positions().cols());
  body.surface().map.add_to_nodes(spread, forces);
  return NodalForces(forces);
}

inline void run(coupling::Substeps& body, int steps) {
  for (int n = 0; n < steps; ++n) {
    body.begin_step();
    body.end_step(forces_on(body));
  }
}

}  // namespace test
