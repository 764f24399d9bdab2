// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/model_text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "nurbs/yaml_map.h"

namespace coupling {

std::string read_text_on_all_ranks(MPI_Comm comm, const std::string& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string text;
  long length_or_error = 0;  // >= 0: length of the text; < 0: minus errno
  if (rank == 0) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    if (file) content << file.rdbuf();
    text = content.str();
    bool failed = !file || (text.empty() && errno != 0);
    if (text.size() > std::numeric_limits<int>::max()) failed = true, errno = EFBIG;  // MPI counts in int
    length_or_error = failed ? -(errno != 0 ? errno : EIO) : static_cast<long>(text.size());
  }
  MPI_Bcast(&length_or_error, 1, MPI_LONG, 0, comm);
  if (length_or_error < 0)
    throw nurbs::InputError("cannot read '" + path +
                            "': " + std::strerror(static_cast<int>(-length_or_error)));
  text.resize(length_or_error);
  MPI_Bcast(text.data(), static_cast<int>(length_or_error), MPI_CHAR, 0, comm);
  return text;
}

bool is_same_file(MPI_Comm comm, const std::string& path, const std::string& other) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::error_code missing;  // a file that has gone since it was read is no other's
  int same = rank == 0 && std::filesystem::equivalent(path, other, missing) && !missing;
  MPI_Bcast(&same, 1, MPI_INT, 0, comm);
  return same != 0;
}

}  // namespace coupling
