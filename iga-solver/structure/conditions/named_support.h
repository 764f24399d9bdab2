// SPDX-License-Identifier: GPL-2.0-or-later
// A support whose reaction is recorded: fixed degrees of freedom of any body, under a name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "structure/id.h"

namespace structure {

struct NamedSupport {
  std::string name;
  std::vector<Id> dofs;                          ///< 3 node + direction of the whole body, rising
  std::optional<std::size_t> spring_group = {};  ///< of the solver's Springs, if it is of these
};

}  // namespace structure
