// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/side_matching.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "brep/sides.h"

namespace brep {
namespace {

using Triangle = std::array<int, 3>;

// Items in buckets, one bucket for each of `keys` keys.
struct Buckets {
  std::vector<int> first;
  template <class Key>
  Buckets(long keys, int items, Key key) : first(keys + 1, 0) {
    for (int i = 0; i < items; ++i)
      if (key(i) >= 0) ++first[key(i) + 1];
    for (long k = 0; k < keys; ++k) first[k + 1] += first[k];
  }
};

}  // namespace

MatchedSides match(long points, const std::vector<Triangle>& triangles) {
  struct Item {
    int high, side;
    bool operator<(const Item& o) const { return std::tie(high, side) < std::tie(o.high, o.side); }
  };
  const int count = 3 * static_cast<int>(triangles.size());
  const auto end = [&](int i, int k) { return triangles[i / 3][(i + k) % 3]; };
  const auto low = [&](int i) { return std::min(end(i, 0), end(i, 1)); };
  Buckets buckets(points, count, low);
  std::vector<Item> items(count);
  std::vector<int> next(buckets.first.begin(), buckets.first.end() - 1);
  for (int i = 0; i < count; ++i)
    items[next[low(i)]++] = {std::max(end(i, 0), end(i, 1)), side_number(i / 3, i % 3)};

  MatchedSides result;
  result.mate.assign(4 * triangles.size(), -1);
  result.sides.reserve(count);
  for (long p = 0; p < points; ++p) {
    const auto begin = items.begin() + buckets.first[p], stop = items.begin() + buckets.first[p + 1];
    std::sort(begin, stop);
    for (auto item = begin; item != stop; ++item) {
      if (item == begin || item->high != (item - 1)->high)
        result.first.push_back(static_cast<int>(result.sides.size()));
      result.sides.push_back(item->side);
    }
  }
  result.first.push_back(static_cast<int>(result.sides.size()));
  for (size_t e = 0; e + 1 < result.first.size(); ++e)
    if (const int a = result.first[e]; result.first[e + 1] - a == 2) {
      result.mate[result.sides[a]] = result.sides[a + 1];
      result.mate[result.sides[a + 1]] = result.sides[a];
    }
  return result;
}

int leave_out_duplicates(long points, std::vector<Triangle>& triangles, std::vector<int>& number) {
  const int count = static_cast<int>(triangles.size());
  const auto sorted = [&](int t) {
    Triangle s = triangles[t];
    std::sort(s.begin(), s.end());
    return s;
  };
  const auto low = [&](int t) { return sorted(t)[0]; };
  Buckets buckets(points, count, low);
  std::vector<int> items(count), next(buckets.first.begin(), buckets.first.end() - 1);
  for (int t = 0; t < count; ++t) items[next[low(t)]++] = t;
  std::vector<bool> again(count, false);
  for (long p = 0; p < points; ++p) {
    const auto begin = items.begin() + buckets.first[p], end = items.begin() + buckets.first[p + 1];
    std::sort(begin, end,
              [&](int a, int b) { return std::make_pair(sorted(a), a) < std::make_pair(sorted(b), b); });
    for (auto t = begin; t != end; ++t)
      if (t != begin && sorted(*t) == sorted(*(t - 1))) again[*t] = true;
  }
  int kept = 0;
  for (int t = 0; t < count; ++t)
    if (!again[t]) {
      triangles[kept] = triangles[t];
      number[kept++] = number[t];
    }
  triangles.resize(kept);
  number.resize(kept);
  return count - kept;
}

}  // namespace brep
