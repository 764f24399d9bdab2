// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/held.h"

#include <fmt/format.h>

#include "structure/analysis/rigid_motions.h"

namespace structure {

void expect_held(const std::string& analysis, const Body& body, const Supports& supports,
                 const Springs& springs) {
  const std::size_t free = free_rigid_motions(body.reference(), supports, springs).size();
  if (free > 0)
    throw NoEquilibrium(
        fmt::format("{}: the supports{} leave the body free in {} of its 6 rigid motions, expected none: fix "
                    "more faces or directions in 'boundary'",
                    analysis, springs.empty() ? "" : " and springs", free));
}

}  // namespace structure
