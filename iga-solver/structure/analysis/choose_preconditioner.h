// SPDX-License-Identifier: GPL-2.0-or-later
// Which preconditioner is for a body.
#pragma once

#include <memory>

#include "structure/analysis/preconditioner.h"

namespace structure {

/// The words of model files; `automatic` takes the first of the others that is for the body:
/// `sparse` up to kMostFactored free degrees of freedom, `tensor` for a body that is one patch, else `nodes`.
enum class PreconditionerKind { automatic, sparse, tensor, nodes };
constexpr int kMostFactored = 9000;

/// The tangent must live on.  Throws std::invalid_argument if the kind is not for the body.
std::unique_ptr<Preconditioner> make_preconditioner(const Tangent& tangent, PreconditionerKind kind);

}  // namespace structure
