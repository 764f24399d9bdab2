// SPDX-License-Identifier: GPL-2.0-or-later
// HDF5 files that this program has not written are read by the program nurbs-read-hdf5, in a process of its
// own: a crash there is an error here.  It is started by posix_spawn, which MPI allows, and found beside the
// running program or this library, in the folders bin and iga-solver/app of one of the folders above them, or
// by PATH.
#pragma once

#include <string>

namespace geometry_io {

/// encoded(unpack_hdf5(bytes)).  Throws std::runtime_error: what HDF5 finds wrong, that it crashed or came to
/// no end on these bytes, or that nurbs-read-hdf5 cannot be started.
std::string unpack_in_own_process(const std::string& bytes);

}  // namespace geometry_io
