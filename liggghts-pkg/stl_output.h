// SPDX-License-Identifier: GPL-2.0-or-later
// The wall in triangles, as it stands every so many steps: FILE_<step>.stl.
#ifndef LMP_STL_OUTPUT_H
#define LMP_STL_OUTPUT_H

#include <mpi.h>

#include <optional>
#include <string>

#include "output_words.h"
#include "wall_triangles.h"

namespace liggghts_pkg {

class StlOutput {
 public:
  /// Every rank: as many triangles as keep within the chord that `options` ask for now, else those given.
  /// Throws std::invalid_argument if these are too many.
  StlOutput(MPI_Comm comm, StlOptions options, const WallTriangles& triangles);

  bool is_due(long step) const { return step % options_.every == 0; }
  /// Nothing has been written yet.
  bool at_beginning() const { return !written_; }
  /// Throws std::runtime_error if a run that begins at `step` would write over files.
  void begin_run(long step) const { expect_no_way_back("stl", options_.file, written_, step); }
  /// Collective.  Throws std::runtime_error on every rank if rank 0 cannot write.
  void write(long step);

 private:
  MPI_Comm comm_;
  StlOptions options_;
  WallTriangles triangles_;
  std::optional<long> written_;  // the last step
};

}  // namespace liggghts_pkg

#endif
