// SPDX-License-Identifier: GPL-2.0-or-later
// What the command line of iga-solve says, and what is printed: by rank 0 alone.
#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>

#include "parallel/session.h"

namespace app {

enum class Talk { errors_only, usual, more };

struct SolveOptions {
  std::string model;                ///< file
  std::optional<double> end, step;  ///< [time], in place of the model's
  bool check = false;               ///< prints what a run would be, and runs nothing
  bool continues = false;           ///< from the state that an earlier run has saved
  Talk talk = Talk::usual;
};

inline bool is_first_rank() { return parallel::Ranks(MPI_COMM_WORLD).me == 0; }

/// The values, which may be collective to work out, are asked for on all ranks.
template <class... Values>
void print_on_first(const char* format, const Values&... values) {
  if (is_first_rank()) fmt::print(fmt::runtime(format), values...);
}

}  // namespace app
