// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/foot_search.h"

#include <algorithm>

#include "brep/minima.h"
#include "brep/piece_distance.h"

namespace brep {

constexpr int kFew = 3;  // pieces, which are looked at without a filter

FootSearch::FootSearch(const Surface& surface)
    : surface_(surface), tree_(surface), neighbours_(surface), same_point_(10.0 * surface.slack) {}

void FootSearch::near(const Vector3& d, double reach, std::vector<int>& pieces) const {
  const size_t begin = pieces.size();
  tree_.near(tree_.query(d, reach), pieces);
  const auto far = [&](int p) { return distance_of_piece(surface_, p, d) > reach; };
  pieces.erase(std::remove_if(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end(), far),
               pieces.end());
  std::sort(pieces.begin() + static_cast<std::ptrdiff_t>(begin), pieces.end());
}

int FootSearch::activate(const Vector3& d, double reach, const int* pieces, int count, int* active) const {
  const PieceTree::Query query = tree_.query(d, reach);
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (tree_.may_be_near(query, pieces[k]) && distance_of_piece(surface_, pieces[k], d) <= reach)
      active[kept++] = pieces[k];
  return kept;
}

double FootSearch::nearest(const Vector3& d, double reach, const int* pieces, int count) const {
  PieceTree::Query query = tree_.query(d, reach);
  for (int k = 0; k < count; ++k) {
    if (!tree_.may_be_near(query, pieces[k])) continue;
    const double distance = distance_of_piece(surface_, pieces[k], d);
    if (distance >= reach) continue;
    reach = distance;
    query = tree_.query(d, reach);
  }
  return reach;
}

void FootSearch::feet(const Vector3& d, double reach, const int* pieces, int count,
                      std::vector<Foot>& out) const {
  Minima minima(surface_, same_point_, d, reach, out);
  if (count <= kFew) {
    for (int k = 0; k < count; ++k) minima.add_of_piece(pieces[k]);
  } else {
    const PieceTree::Query query = tree_.query(d, reach);
    for (int k = 0; k < count; ++k)
      if (tree_.may_be_near(query, pieces[k])) minima.add_of_piece(pieces[k]);
  }
  minima.finish(neighbours_);
}

}  // namespace brep
