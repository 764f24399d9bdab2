// SPDX-License-Identifier: GPL-2.0-or-later
// What any search for an equilibrium asks of a body.
#pragma once

#include <stdexcept>
#include <string>

#include "structure/body.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"

namespace structure {

/// No equilibrium was found, or there is none; what() says where, how far off, and what to try.
struct NoEquilibrium : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws NoEquilibrium, as `analysis`, if supports and springs leave the body a rigid motion.
void expect_held(const std::string& analysis, const Body& body, const Supports& supports,
                 const Springs& springs);

}  // namespace structure
