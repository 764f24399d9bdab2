// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/smooth_neighbours.h"

#include <algorithm>
#include <utility>

namespace brep {
namespace {

constexpr int kFaces = 64;  // looked at: feet that are joined have few between them

bool has(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

}  // namespace

SmoothNeighbours::SmoothNeighbours(const Surface& surface) {
  std::vector<std::pair<int, int>> pairs;
  bool concave = false;
  for (const Edge& edge : surface.edges)
    for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const EdgeUse &use = surface.uses[u], &next = surface.next_use(edge, u);
      if (use.wedge != Wedge::smooth && use.wedge != Wedge::smooth_concave) continue;
      concave = concave || use.wedge == Wedge::smooth_concave;
      pairs.emplace_back(use.face, next.face);
      pairs.emplace_back(next.face, use.face);
    }
  if (!concave) return;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_.assign(surface.faces.size() + 1, 0);
  beyond_.reserve(pairs.size());
  for (const auto& [from, to] : pairs) {
    ++first_[from + 1];
    beyond_.push_back(to);
  }
  for (size_t f = 0; f < surface.faces.size(); ++f) first_[f + 1] += first_[f];
}

bool SmoothNeighbours::joined(const std::vector<int>& from, const std::vector<int>& to) const {
  int seen[kFaces], count = 0;
  for (const int face : from) {
    if (has(to, face)) return false;  // one face, no edge between them
    if (count < kFaces) seen[count++] = face;
  }
  for (int k = 0; k < count; ++k)
    for (int i = first_[seen[k]]; i < first_[seen[k] + 1]; ++i) {
      const int face = beyond_[i];
      if (has(to, face)) return true;
      if (count < kFaces && std::find(seen, seen + count, face) == seen + count) seen[count++] = face;
    }
  return false;
}

}  // namespace brep
