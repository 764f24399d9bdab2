// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/model_text.h"

#include <limits>
#include <new>

#include "geometry_io/geometry_io.h"
#include "geometry_io/input_error.h"
#include "geometry_io/regular_file.h"
#include "parallel/all_or_none.h"

namespace coupling {
namespace {

// Returns the complaint, if there is one.
std::string read(const std::string& path, std::string& text) try {
  geometry_io::FileContent content = geometry_io::read_regular_file(path);
  if (!content.problem.empty()) return "cannot read '" + path + "': " + content.problem;
  try {
    text = geometry_io::readable(path, std::move(content.bytes));
  } catch (const geometry_io::InputError& error) {
    return error.what();
  }
  return text.size() > std::numeric_limits<int>::max() ? path + ": holds more than 2 GiB" : std::string();
} catch (const std::bad_alloc&) {
  return parallel::out_of_memory(path);
}

void broadcast(MPI_Comm comm, const std::string& path, std::string& text) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm);
  parallel::on_every_rank(comm, path, [&] { return text.resize(length), true; });
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm);
}

}  // namespace

std::string read_text_on_all_ranks(MPI_Comm comm, const std::string& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string text, problem;
  if (rank == 0) problem = read(path, text);
  broadcast(comm, path, problem);
  if (!problem.empty()) throw geometry_io::InputError(problem);
  broadcast(comm, path, text);
  return text;
}

bool is_same_file(MPI_Comm comm, const std::string& path, const std::string& other) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  int same = rank == 0 && geometry_io::same_file(path, other);
  MPI_Bcast(&same, 1, MPI_INT, 0, comm);
  return same != 0;
}

}  // namespace coupling
