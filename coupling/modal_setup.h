// SPDX-License-Identifier: GPL-2.0-or-later
// From a model to a modal body: what can be one, and its modes, which rank 0 finds for all.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>

#include "coupling/modal_structure.h"

namespace coupling {

/// What a model file says that a modal body takes: its damping leaves the material and comes back.  Throws
/// geometry_io::InputError, naming what a modal body cannot do.
ModalDamping take_damping(io::ModelFile& model);

/// `whole`: the model with its control points, if `body` is a part of several.  Collective; throws on every
/// rank if it fails on rank 0.
std::unique_ptr<StructureSolver> make_modal(MPI_Comm comm, std::unique_ptr<IgaStructure> body,
                                            std::optional<io::ModelFile> whole, int modes,
                                            const ModalDamping& damping);

}  // namespace coupling
