// SPDX-License-Identifier: GPL-2.0-or-later
// What belongs together, joined pair by pair.  Source: Cormen, Leiserson, Rivest, Stein (2009), chapter 21.
#pragma once

#include <numeric>
#include <vector>

namespace brep {

class DisjointSets {
 public:
  explicit DisjointSets(int count) { reset(count); }
  void reset(int count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The lower number stands for both.
  void join(int i, int j) {
    i = find(i), j = find(j);
    if (i < j) parent_[j] = i;
    if (j < i) parent_[i] = j;
  }
  /// Numbers of the sets in the order of their lowest members; returns how many there are.
  int number(std::vector<int>& set) {
    const int count = static_cast<int>(parent_.size());
    set.assign(count, -1);
    int sets = 0;
    for (int i = 0; i < count; ++i) {
      const int root = find(i);
      set[i] = root == i ? sets++ : set[root];
    }
    return sets;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace brep
