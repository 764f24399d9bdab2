// SPDX-License-Identifier: GPL-2.0-or-later
// Work of one rank for all, or of each alike, that may fail on some of them only (a disk, a machine with less
// memory): all or none go on, or those that do would wait for the others for ever.
#pragma once

#include <mpi.h>

#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "nurbs/memory.h"

namespace parallel {

/// Collective.  Throws geometry_io::InputError on every rank if `problem` is not empty on one of them: the
/// problem of the lowest such rank.
void agree_on_problem(MPI_Comm comm, std::string problem);

using nurbs::out_of_memory;

/// What an error says, which is never nothing; `file`: what was read, if anything.
std::string in_words(const std::exception& error, const std::string& file = {});

/// Collective.  The result of action(), which reads `file`; throws as agree_on_problem if it threw anywhere.
template <class Action>
auto on_every_rank(MPI_Comm comm, const std::string& file, Action action) {
  std::optional<decltype(action())> result;
  std::string problem;
  try {
    result = action();
  } catch (const std::exception& error) {
    problem = in_words(error, file);
  }
  agree_on_problem(comm, std::move(problem));
  return std::move(*result);
}

/// Collective.  Rank 0 acts; throws as agree_on_problem if it threw.
template <class Action>
void on_first_rank(MPI_Comm comm, Action action) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  std::string problem;
  if (rank == 0) try {
      action();
    } catch (const std::exception& error) {
      problem = in_words(error);
    }
  agree_on_problem(comm, std::move(problem));
}

}  // namespace parallel
