// SPDX-License-Identifier: GPL-2.0-or-later
// The edges of sheets of a CAD model, for what joins them.
#pragma once

#include <algorithm>
#include <vector>

#include "brep/cad_model.h"
#include "geometry_io/cad_curves.h"
#include "geometry_io/cad_cuts.h"
#include "search/box.h"

namespace geometry_io {

/// Along which borders of faces were joined.
struct Sewn {
  int edges = 0;
  double widest = 0.0;  ///< how far what was joined is apart [length]
};

/// The edges of the faces of some solids, as they are before any is cut: what follows has numbers of these.
class SheetEdges {
 public:
  SheetEdges(const brep::CadModel& model, const std::vector<int>& solids);
  int count() const { return static_cast<int>(curves_.size()); }
  int in_model(int i) const { return numbers_[i]; }
  const EdgeCurve& curve(int i) const { return curves_[i]; }
  const std::vector<TrimPlace>& uses(int i) const { return uses_[numbers_[i]]; }
  bool is_free(int i) const { return uses(i).size() == 1; }
  bool is_any_free() const;
  bool has(const brep::CadFace& face) const {
    return std::find(solids_.begin(), solids_.end(), face.solid) != solids_.end();
  }

 private:
  std::vector<int> solids_, numbers_;
  std::vector<std::vector<TrimPlace>> uses_;  // of all edges of the model
  std::vector<EdgeCurve> curves_;
};

/// A box that holds what is no farther than `by` from a curve; its points, the ends among them.
template <class Points>
search::Box box_along(const Points& points, double by) {
  search::Box box{points[0], points[0]};
  double step = 0.0;
  for (size_t k = 1; k < points.size(); ++k) {
    box.low = box.low.cwiseMin(points[k]);
    box.high = box.high.cwiseMax(points[k]);
    step = std::max(step, (points[k] - points[k - 1]).norm());
  }
  box.inflate(by + 0.5 * step);  // between the points
  return box;
}

}  // namespace geometry_io
