// SPDX-License-Identifier: GPL-2.0-or-later
// Model files on many ranks: rank 0 reads, everyone gets the same text, so everyone reaches the same verdict.
#pragma once

#include <mpi.h>

#include <string>

namespace coupling {

/// Collective.  Throws nurbs::InputError on every rank if rank 0 cannot read the file.
std::string read_text_on_all_ranks(MPI_Comm comm, const std::string& path);

}  // namespace coupling
