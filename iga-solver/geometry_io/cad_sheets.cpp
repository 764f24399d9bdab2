// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_sheets.h"

namespace geometry_io {

SheetEdges::SheetEdges(const brep::CadModel& model, const std::vector<int>& solids)
    : solids_(solids), uses_(uses_of_edges(model)) {
  const auto of_sheets = [&](const TrimPlace& use) { return has(model.faces[use.face]); };
  for (size_t e = 0; e < uses_.size(); ++e)
    if (std::any_of(uses_[e].begin(), uses_[e].end(), of_sheets)) {
      numbers_.push_back(static_cast<int>(e));
      curves_.emplace_back(model.edges[e]);
    }
}

bool SheetEdges::is_any_free() const {
  for (int i = 0; i < count(); ++i)
    if (is_free(i)) return true;
  return false;
}

}  // namespace geometry_io
