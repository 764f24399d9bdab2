// SPDX-License-Identifier: GPL-2.0-or-later
// All transfer between the ranks of the particles and the ranks of the structure.
// Today's plan is "every rank integrates the whole structure and needs the whole surface": import is a local
// copy, export gathers the contacts of all ranks.  Nothing outside this class may rely on that.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "coupling/structure_solver.h"

namespace coupling {

/// One contact as the rank of its particle reports it.  Plain data: it travels as one piece of bytes.
struct ContactForce {
  long tag;      ///< particle's global id
  int branch;    ///< which of the particle's contacts with this wall
  int patch;     ///< of the foot
  double xi[2];  ///< foot on the patch
  double F[3];   ///< force on the surface [force]
};

class SurfaceExchange {
 public:
  /// The solver must outlive the exchange.
  SurfaceExchange(MPI_Comm comm, StructureSolver& solver);

  /// Brings positions and velocities of the surface's control points to this rank; call after every change of
  /// the solver's state.
  void import_surface();
  const NodalVectors& positions() const { return positions_; }    ///< 3 x n_control_points [length]
  const NodalVectors& velocities() const { return velocities_; }  ///< 3 x n_control_points [length/time]

  /// Collective.  Returns the forces on the nodes that this rank holds, of the contacts of all ranks: each is
  /// spread to its control points (eq. 34) in the order of (tag, branch), so the sums do not depend on how
  /// many ranks there are.  Throws std::runtime_error on every rank if there are more contacts than MPI
  /// counts.
  const NodalVectors& export_add(const std::vector<ContactForce>& local);

 private:
  void gather(const std::vector<ContactForce>& local);

  MPI_Comm comm_;
  StructureSolver& solver_;
  SurfaceMap map_;  ///< from the nodes that this rank holds
  NodalVectors positions_, velocities_;
  NodalVectors surface_forces_, nodal_forces_;
  std::vector<ContactForce> contacts_;    ///< of all ranks
  std::vector<std::int64_t> all_counts_;  ///< of contacts per rank
  std::vector<int> counts_, offset_;      ///< the same as MPI takes them
};

}  // namespace coupling
