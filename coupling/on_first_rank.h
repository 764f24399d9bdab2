// SPDX-License-Identifier: GPL-2.0-or-later
// What rank 0 does for all of them, and may fail at.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>

namespace coupling {

/// Collective.  Rank 0 acts; if it throws every rank throws std::runtime_error with its words.
template <class Action>
void on_first_rank(MPI_Comm comm, Action action) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string problem;
  if (rank == 0) try {
      action();
    } catch (const std::exception& caught) {
      problem = caught.what();
    }
  int length = static_cast<int>(problem.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm);
  if (length == 0) return;
  problem.resize(length);
  MPI_Bcast(problem.data(), length, MPI_CHAR, 0, comm);
  throw std::runtime_error(problem);
}

}  // namespace coupling
