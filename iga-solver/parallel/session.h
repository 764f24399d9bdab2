// SPDX-License-Identifier: GPL-2.0-or-later
// A program on several ranks: from its beginning to its end, which rank it is, and how a solid is cut among
// them.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <utility>

#include "io/model_file.h"
#include "parallel/all_or_none.h"
#include "parallel/mpi_halo.h"

namespace parallel {

/// Of a program's main.
struct Session {
  Session(int* argc, char*** argv) { MPI_Init(argc, argv); }
  ~Session() { MPI_Finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

struct Ranks {
  int me = 0, count = 1;
  explicit Ranks(MPI_Comm comm) {
    MPI_Comm_rank(comm, &me);
    MPI_Comm_size(comm, &count);
  }
};

/// This rank's part of a solid that all ranks read.
inline io::Cut cut_among(MPI_Comm comm) {
  const Ranks ranks(comm);
  return {ranks.me, ranks.count,
          [comm](structure::Part part) { return std::make_unique<MpiHalo>(comm, std::move(part)); },
          [comm](const std::string& problem) { agree_on_problem(comm, problem); }};
}

}  // namespace parallel
