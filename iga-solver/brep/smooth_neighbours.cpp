// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/smooth_neighbours.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace brep {
namespace {

constexpr int kSteps = 128;  // looked at: feet that are joined have few faces between them

bool has(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

// By how much the wedge from this use to the next is less than pi.
double bend_of(const EdgeUse& use, const EdgeUse& next) {
  const double *m = use.conormal, *n = next.conormal;
  return std::atan2(m[0] * n[1] - m[1] * n[0], -m[0] * n[0] - m[1] * n[1]);
}

}  // namespace

SmoothNeighbours::SmoothNeighbours(const Surface& surface) {
  std::vector<std::tuple<int, int, double>> pairs;
  bool any_concave = false;
  for (const Edge& edge : surface.edges)
    for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const EdgeUse &use = surface.uses[u], &next = surface.next_use(edge, u);
      if (use.wedge != Wedge::smooth && use.wedge != Wedge::smooth_concave) continue;
      const bool concave = use.wedge == Wedge::smooth_concave;
      const double bend = concave ? bend_of(use, next) : 0.0;
      any_concave = any_concave || concave;
      pairs.emplace_back(use.face, next.face, bend);
      pairs.emplace_back(next.face, use.face, bend);
    }
  if (!any_concave) return;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_.assign(surface.faces.size() + 1, 0);
  beyond_.reserve(pairs.size());
  for (const auto& [from, to, bend] : pairs) {
    ++first_[from + 1];
    beyond_.push_back({to, bend});
  }
  for (size_t f = 0; f < surface.faces.size(); ++f) first_[f + 1] += first_[f];
}

bool SmoothNeighbours::joined(const std::vector<int>& from, const std::vector<int>& to, double bend) const {
  int seen[kSteps], count = 0;  // 2 * face + whether such a concave edge lies behind
  for (const int face : from) {
    if (has(to, face)) return false;  // one face, no edge between them
    if (count < kSteps) seen[count++] = 2 * face;
  }
  for (int k = 0; k < count; ++k)
    for (int i = first_[seen[k] / 2]; i < first_[seen[k] / 2 + 1]; ++i) {
      const bool concave = seen[k] % 2 == 1 || (beyond_[i].bend > 0.0 && beyond_[i].bend >= bend);
      if (concave && has(to, beyond_[i].face)) return true;
      const int step = 2 * beyond_[i].face + (concave ? 1 : 0);
      if (count < kSteps && std::find(seen, seen + count, step) == seen + count) seen[count++] = step;
    }
  return false;
}

}  // namespace brep
