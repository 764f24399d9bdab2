// SPDX-License-Identifier: GPL-2.0-or-later
// A bar as a whole solid and as one that keeps its lowest modes.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "coupling/modal_structure.h"
#include "nurbs/primitives.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"

namespace test {

using coupling::IgaStructure;
using coupling::ModalStructure;
using structure::ExplicitSolver;

inline constexpr double kLength = 4.0, kDensity = 2.0;  // of the bar
inline constexpr nurbs::Face kTop = nurbs::Face::zeta_plus;

inline nurbs::Volume unit_block() {
  const auto knots = [](int n) { return nurbs::KnotVector::uniform(2, n); };
  return nurbs::box({0, 0, 0}, {kLength, 1, 1}, {knots(4), knots(1), knots(1)});
}

inline structure::NodeSet held_end() {
  return structure::nodes_on(unit_block().space, {nurbs::Face::xi_minus});
}

inline structure::Supports clamped() {
  structure::Supports clamp;
  clamp.fix(held_end(), {true, true, true});
  return clamp;
}

/// A bar along x of a soft solid, clamped at xi- unless it is free or somebody moves it there.
inline ExplicitSolver bar(const structure::Supports& supports = clamped()) {
  auto material = std::make_shared<structure::LinearElastic>(100.0, 0.3, kDensity);
  return {std::make_unique<structure::Solid>(unit_block(), material), supports};
}

inline std::unique_ptr<IgaStructure> whole(ExplicitSolver solver) {
  structure::Probe end;
  for (int A = 0; A < solver.body().node_count(); ++A)
    if (solver.body().reference()(0, A) == kLength) end.nodes.push_back(A);
  end.name = "end";
  end.weights.assign(end.nodes.size(), 1.0 / static_cast<double>(end.nodes.size()));
  return std::make_unique<IgaStructure>(std::move(solver), std::vector<structure::SkinPiece>{{0, kTop}},
                                        std::vector<structure::Probe>{end});
}

/// All modes that there are but one, or `count`.
inline std::unique_ptr<ModalStructure> modal(std::unique_ptr<IgaStructure> body, int count,
                                             const coupling::ModalDamping& damping = {}) {
  const structure::ModalBasis basis = structure::modal_basis(body->solver(), count);
  return std::make_unique<ModalStructure>(std::move(body), basis, damping);
}

}  // namespace test
