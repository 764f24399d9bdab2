// SPDX-License-Identifier: GPL-2.0-or-later
// Surface fields of a wall as a time series for ParaView: when to sample, when to write.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <vector>

#include "coupling/contact_fields.h"
#include "output_words.h"
#include "vtk/vtu_file.h"

namespace liggghts_pkg {

class WallOutput {
 public:
  WallOutput(MPI_Comm comm, OutputOptions options, std::unique_ptr<coupling::ContactFields> fields);

  int every() const { return options_.every; }
  bool tracks_wear() const { return options_.fields.wear; }
  /// Before the contacts of a step.  The forces of setup belong to a step that has been counted, unless it is
  /// the very first one: its contacts are the first state of the series, and wear nothing.  `time` is
  /// LIGGGHTS', which begins again at 0 with the first run after a restart file is read.
  void begin_step(bool setup, double time);
  void add(const coupling::SurfaceContact& contact);
  /// The first state is still to be written, at the end of setup.
  bool at_beginning() const { return !written_; }
  /// Throws std::runtime_error if a run that begins at `step` would write over states of the series.
  void begin_run(long step) const { expect_no_way_back("output", options_.file, written_, step); }

  /// Collective, as all that follows.  Writes the state and begins the next interval; arguments as in
  /// ContactFields::state.  Throws std::runtime_error on every rank if rank 0 cannot write.
  void write(long step, double time, const coupling::NodalVectors& control_points,
             const coupling::RigidFrame& frame);

  /// Restart: fields since the last state, the wear, and the series' time.  After load the series goes on
  /// after `step`.
  std::vector<double> save(double time) const;
  void load(std::vector<double> state, long step);

 private:
  MPI_Comm comm_;
  OutputOptions options_;
  std::unique_ptr<coupling::ContactFields> fields_;
  vtk::Series series_;
  double earlier_ = 0.0;              // time of the runs before the restart file
  std::optional<double> saved_time_;  // of that file, until the next run begins
  std::optional<long> written_;       // the last step
  bool sampling_ = false, setup_ = false;
};

/// Of patches or of triangles.  Every rank, from the undeformed surface (3 x n control points of patches).
std::unique_ptr<coupling::ContactFields> fields_on(MPI_Comm comm, const coupling::ContactSurface& surface,
                                                   const coupling::NodalVectors& control_points);

}  // namespace liggghts_pkg
