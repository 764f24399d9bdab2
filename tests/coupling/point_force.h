// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces of a force at one place of a solver's surface.
#pragma once

#include "coupling/force_distribution.h"
#include "coupling/structure_solver.h"

/// F [force] at parameters xi of the surface's first patch.
inline coupling::NodalForces point_force(const coupling::StructureSolver& solver,
                                         const nurbs::Parameter<2>& xi, const nurbs::Vector3& F) {
  using nurbs::NodalVectors;
  NodalVectors on_surface = NodalVectors::Zero(3, solver.surface().topology.control_point_count());
  coupling::FootBasis(solver.surface().topology, {0, xi}).distribute(F, on_surface);
  NodalVectors on_nodes = NodalVectors::Zero(3, solver.positions().cols());
  solver.surface().map.add_to_nodes(on_surface, on_nodes);
  return coupling::NodalForces(on_nodes);
}
