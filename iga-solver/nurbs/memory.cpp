// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace nurbs {

double memory_limit() {
  double limit = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit address_space;
  if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY)
    limit = std::min(limit, static_cast<double>(address_space.rlim_cur));
  double container;  // the file holds "max" where there is no limit
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> container) limit = std::min(limit, container);
  return limit;
}

std::string out_of_memory(const std::string& file) {
  return fmt::format("{}: out of memory: what it describes takes more than this process may have, {}", file,
                     size_text(memory_limit()));
}

std::string size_text(double bytes) {
  constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 4; ++unit) bytes /= 1000.0;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

void expect_memory(double bytes, const std::string& what) {
  const double limit = memory_limit();
  if (bytes > limit)
    throw std::invalid_argument(fmt::format("{} would take {} of memory, this process may have {}", what,
                                            size_text(bytes), size_text(limit)));
}

}  // namespace nurbs
