// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "structure/id.h"

namespace structure {

/// Where nodes stand in the nodal arrays of a part.
class Columns {
 public:
  /// `nodes`: ids of the columns, -1 for columns of no node.
  explicit Columns(const std::vector<Id>& nodes) {
    for (std::size_t column = 0; column < nodes.size(); ++column)
      if (nodes[column] >= 0) sorted_.emplace_back(nodes[column], column);
    std::sort(sorted_.begin(), sorted_.end());
  }
  /// -1 for a node that the part does not hold.
  std::ptrdiff_t of(Id node) const {
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<Id, std::size_t>(node, 0));
    return found == sorted_.end() || found->first != node ? -1 : static_cast<std::ptrdiff_t>(found->second);
  }

 private:
  std::vector<std::pair<Id, std::size_t>> sorted_;
};

}  // namespace structure
