// SPDX-License-Identifier: GPL-2.0-or-later
// A support whose reaction is recorded: fixed degrees of freedom of any body, under a name.
#pragma once

#include <string>
#include <vector>

#include "structure/id.h"

namespace structure {

struct NamedSupport {
  std::string name;
  std::vector<Id> dofs;  ///< 3 node + direction of the whole body, rising
};

}  // namespace structure
