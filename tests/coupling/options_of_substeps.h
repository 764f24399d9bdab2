// SPDX-License-Identifier: GPL-2.0-or-later
// How a solid takes its sub-steps, in one line of a test.
#pragma once

#include <optional>

#include "coupling/substeps.h"

namespace test {

/// No count: as many as it takes.  `heaviest`: mass of the heaviest particle; 0: there is none.
inline coupling::SubstepOptions options(coupling::SubstepOptions::Fast fast, std::optional<int> count,
                                        double heaviest = 0.0) {
  return {fast, count, [=] { return heaviest; }};
}

}  // namespace test
