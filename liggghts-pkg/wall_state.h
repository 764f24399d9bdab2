// SPDX-License-Identifier: GPL-2.0-or-later
// What a wall leaves in a restart file, as numbers: minus the version of this format, then parts, each its
// length and its numbers.  Files of older versions begin with the first part and hold two of them.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "coupling/fingerprint.h"

namespace liggghts_pkg {

/// LIGGGHTS does not tell how many numbers it read, but counts their bytes by an int (state_blocks.h).
constexpr std::size_t kMostInOneBlock = 0x7fffffff / sizeof(double);

struct WallState {
  std::vector<double> structure;  ///< StructureSolver::save
  std::vector<double> fields;     ///< WallOutput::save; empty without output
  std::vector<double> contacts;   ///< SurfaceExchange::save; empty in files of older versions
  /// Nothing in files of older versions.
  struct Origin {
    coupling::Fingerprint fingerprint;  ///< of the structure, with its units
    int contacts;                       ///< slots of each particle's contact memory
    int history;                        ///< values that the contact models keep in a slot
  };
  std::optional<Origin> origin;
};

std::vector<double> pack(const WallState& state);
/// Of the bytes that LIGGGHTS read, `numbers` at most.  Throws std::invalid_argument if a newer version wrote
/// them, or if they are damaged.
WallState unpack_wall_state(const char* bytes, std::size_t numbers = kMostInOneBlock);

/// Throws std::invalid_argument unless the state was saved by a wall like this one: what differs, and the way
/// out.  `file`: of this wall, for the message.
void check_origin(const WallState::Origin& saved, const WallState::Origin& now, const std::string& file);

/// Writes what LIGGGHTS gives back to one fix: its bytes as an int, then the numbers.  Collective; throws
/// std::runtime_error on every rank if rank 0 cannot.
void write_block(MPI_Comm world, std::FILE* file, const std::vector<double>& numbers);

}  // namespace liggghts_pkg
