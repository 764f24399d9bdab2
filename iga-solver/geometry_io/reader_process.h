// SPDX-License-Identifier: GPL-2.0-or-later
// Files that may crash the library that reads them (HDF5 of other programs, STEP, IGES) are read by a program
// in a process of its own: a crash there is an error here.  It is started by posix_spawn, which MPI allows,
// and found beside the running program or this library, in the folders bin and iga-solver/app of one of the
// folders above them, or by PATH.
#pragma once

#include <string>
#include <vector>

namespace geometry_io {

struct ReaderProgram {
  const char* name;
  const char* parser;   ///< the library that may crash
  const char* without;  ///< why the program is needed, and what to do without it
};

/// nurbs-read-hdf5: encoded(unpack_hdf5(bytes)).
extern const ReaderProgram kHdf5Reader;
/// nurbs-read-step [TOLERANCE]: encoded contents of version 2 of the schema, lengths in mm.
extern const ReaderProgram kStepReader;

/// What the program makes of the bytes (hdf5_contents.h).  Throws std::runtime_error: what it finds wrong,
/// that it crashed or came to no end on these bytes, or that it cannot be started.
std::string read_in_own_process(const ReaderProgram& program, const std::string& bytes,
                                const std::vector<std::string>& arguments = {});

}  // namespace geometry_io
