// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/exact_sum.h"

#include <cmath>
#include <limits>

namespace structure {

// Leaves every place but the last from 0 to 2^32 - 1; the last has the sign.
void ExactSum::carry() {
  constexpr std::int64_t kBase = std::int64_t(1) << 32;
  for (int k = 0; k + 1 < kPlaces; ++k) {
    const std::int64_t over = words_[k] >> 32;  // rounds down
    words_[k] -= over * kBase;
    words_[k + 1] += over;
  }
  since_carry_ = 0;
}

void ExactSum::add(ExactSum other) {
  const std::array<std::int64_t, kWords>& words = other.words();
  carry();
  for (int k = 0; k < kWords; ++k) words_[k] += words[k];
  ++since_carry_;
}

double ExactSum::value() const {
  const std::int64_t plus = words_[kPlaces], minus = words_[kPlaces + 1], none = words_[kPlaces + 2];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (none > 0 || (plus > 0 && minus > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (plus > 0 || minus > 0) return plus > 0 ? kInfinity : -kInfinity;

  ExactSum magnitude = *this;
  magnitude.carry();
  const bool negative = magnitude.words_[kPlaces - 1] < 0;
  if (negative) {
    for (std::int64_t& word : magnitude.words_) word = -word;
    magnitude.carry();
  }
  const auto& word = magnitude.words_;
  int top = kPlaces - 1;
  while (top > 0 && word[top] == 0) --top;
  // The first 64 bits, the last of which tells whether there are more: enough to round once.
  const auto place = [&](int k) { return k < 0 ? std::uint64_t(0) : static_cast<std::uint64_t>(word[k]); };
  int shift = 0;
  while (shift < 32 && place(top) >> (32 - 1 - shift) == 0) ++shift;
  std::uint64_t first = place(top) << 32 | place(top - 1);
  std::uint64_t rest = place(top - 2);
  if (shift > 0) {
    first = first << shift | rest >> (32 - shift);
    rest = rest << shift & 0xffffffff;
  }
  for (int k = top - 3; k >= 0; --k) rest |= place(k);
  if (rest != 0) first |= 1;
  const double value = std::ldexp(static_cast<double>(first), 32 * (top - 1) - shift - 1074);
  return negative ? -value : value;
}

}  // namespace structure
