// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/choose_preconditioner.h"

#include <stdexcept>

#include "structure/analysis/fast_diagonal.h"
#include "structure/analysis/nodal_jacobi.h"
#include "structure/analysis/sparse_factor.h"

namespace structure {

std::unique_ptr<Preconditioner> make_preconditioner(const Tangent& tangent, PreconditionerKind kind) {
  const Body& body = tangent.body();
  if (kind == PreconditionerKind::automatic) {
    const std::size_t fixed = tangent.supports().fixed_dofs().size();
    const bool is_small = 3 * std::size_t(body.node_count()) <= kMostFactored + fixed;
    kind = is_small                     ? PreconditionerKind::sparse
           : FastDiagonal::is_for(body) ? PreconditionerKind::tensor
                                        : PreconditionerKind::nodes;
  }
  if (kind == PreconditionerKind::sparse) return std::make_unique<SparseFactor>(tangent);
  if (kind == PreconditionerKind::nodes) return std::make_unique<NodalJacobi>(tangent);
  if (!FastDiagonal::is_for(body))
    throw std::invalid_argument("preconditioner is 'tensor', expected 'nodes': the solid is not one patch");
  return std::make_unique<FastDiagonal>(tangent);
}

}  // namespace structure
