// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/search_counts.h"

#include <fmt/format.h>

namespace contact {

SearchCounts sum(const SearchCounts& counts, MPI_Comm world) {
  constexpr int kNumbers = 8;
  static_assert(sizeof(SearchCounts) == kNumbers * sizeof(long), "Counts is a row of numbers");
  SearchCounts all;
  MPI_Allreduce(&counts, &all, kNumbers, MPI_LONG, MPI_SUM, world);
  return all;
}

std::string report(const SearchCounts& counts) {
  const long* n = counts.by_status;
  const long projections = n[0] + n[1] + n[2] + n[3];
  const double iterations =
      projections > 0 ? static_cast<double>(counts.iterations) / static_cast<double>(projections) : 0.0;
  return fmt::format(
      "{} projections: {} interior, {} edge, {} corner, {} not converged; {} cold, {} fallbacks, {:.2f} "
      "iterations on average; {} near particles in all steps",
      projections, n[0], n[1], n[2], n[3], counts.cold, counts.fallbacks, iterations, counts.near);
}

}  // namespace contact
