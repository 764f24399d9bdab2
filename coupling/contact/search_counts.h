// SPDX-License-Identifier: GPL-2.0-or-later
// What the searches of one run came to.
#pragma once

#include <mpi.h>

#include <string>

#include "search/foot.h"

namespace contact {

/// Feet found since it was made, on this rank.
struct SearchCounts {
  long by_status[4] = {};  ///< in the order of search::FootStatus
  long cold = 0;           ///< found by a search of all candidates
  long fallbacks = 0;      ///< simplex_brent found no interior foot
  long iterations = 0;     ///< of the methods that found the feet, all together
  long near = 0;           ///< particles near the wall, summed over steps

  long not_converged() const { return by_status[static_cast<int>(search::FootStatus::not_converged)]; }
  void add(const search::Foot& foot) {
    add_direct(foot);
    iterations += foot.iterations;
  }
  void add_direct(const search::Foot& foot) { add_direct(foot.status); }  ///< no iteration
  void add_direct(search::FootStatus status) { ++by_status[static_cast<int>(status)]; }
};

/// Sum over all ranks (collective).
SearchCounts sum(const SearchCounts& counts, MPI_Comm world);
/// One line.
std::string report(const SearchCounts& counts);

}  // namespace contact
