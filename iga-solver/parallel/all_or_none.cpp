// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/all_or_none.h"

#include <new>

#include "geometry_io/input_error.h"

namespace parallel {

void agree_on_problem(MPI_Comm comm, std::string problem) {
  int rank, size, first;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int mine = problem.empty() ? size : rank;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size) return;
  int length = static_cast<int>(problem.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm);
  problem.resize(length);
  MPI_Bcast(problem.data(), length, MPI_CHAR, first, comm);
  throw geometry_io::InputError(problem);
}

std::string in_words(const std::exception& error, const std::string& file) {
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return file.empty() ? "out of memory: this process may have " + nurbs::size_text(nurbs::memory_limit())
                        : out_of_memory(file);
  const std::string words = error.what();
  return words.empty() ? file + (file.empty() ? "" : ": ") + "an error without a message" : words;
}

}  // namespace parallel
