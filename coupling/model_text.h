// SPDX-License-Identifier: GPL-2.0-or-later
// Model and geometry files on many ranks: rank 0 reads, everyone gets the same bytes, so everyone reaches the
// same verdict.
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace coupling {

/// Collective.  Throws geometry_io::InputError on every rank if rank 0 cannot read the file.
std::string read_text_on_all_ranks(MPI_Comm comm, const std::string& path);

/// The same as a function of the path, for readers of files that name others.
inline std::function<std::string(const std::string& path)> reader_on_all_ranks(MPI_Comm comm) {
  return [comm](const std::string& path) { return read_text_on_all_ranks(comm, path); };
}

/// Collective.  Whether two paths lead to one file, by links too, as rank 0 sees it.
bool is_same_file(MPI_Comm comm, const std::string& path, const std::string& other);

}  // namespace coupling
