// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/modal_basis.h"

#include <stdexcept>
#include <utility>

#include "structure/analysis/conjugate_gradients.h"
#include "structure/analysis/modes.h"
#include "structure/analysis/rigid_motions.h"

namespace structure {

namespace {

constexpr CgLimits kLimits{1e-12};

NodalVectors prescribed(const Motion& motion, Eigen::Index nodes) {
  NodalVectors u = NodalVectors::Zero(3, nodes);
  for (std::size_t i = 0; i < motion.dofs.size(); ++i) u.data()[motion.dofs[i]] = motion.size[i];
  return u;
}

/// K psi = 0 on free degrees of freedom.
std::vector<NodalVectors> follow_shapes(const ExplicitSolver& solver) {
  const Supports& supports = solver.supports();
  if (supports.motions().empty()) return {};
  const NodalVectors none = NodalVectors::Zero(3, solver.body().node_count());
  if (!free_rigid_motions(solver.body().reference(), supports, solver.springs()).empty())
    throw std::runtime_error("supports move, but do not hold the body: it would not follow");
  const Tangent tangent(solver.body(), supports, none, 0.0, solver.springs());
  const auto preconditioner = make_preconditioner(tangent, PreconditionerKind::automatic);
  std::vector<NodalVectors> shapes;
  NodalVectors f(3, none.cols()), u;
  for (const Motion& motion : supports.motions()) {
    NodalVectors psi = prescribed(motion, none.cols());
    solver.body().internal_force_change(none, psi, f);
    solver.springs().add_forces(psi, f);
    f = -f;
    supports.apply(f);
    if (!conjugate_gradients(tangent.product(), *preconditioner, f, u, kLimits).converged)
      throw std::runtime_error("where the supports' motion takes the body is not found");
    shapes.push_back(psi + u);
  }
  return shapes;
}

}  // namespace

ModalBasis modal_basis(const ExplicitSolver& solver, int count) {
  const NodalVectors undeformed = NodalVectors::Zero(3, solver.body().node_count());
  ModeOptions options;
  options.count = count;
  std::vector<Mode> modes =
      lowest_modes(solver.body(), solver.supports(), undeformed, options, solver.springs());
  ModalBasis basis{Eigen::VectorXd(count), {}, follow_shapes(solver)};
  for (int k = 0; k < count; ++k) {
    basis.eigenvalues[k] = std::max(0.0, modes[k].eigenvalue);
    basis.modes.push_back(std::move(modes[k].shape));
  }
  return basis;
}

}  // namespace structure
