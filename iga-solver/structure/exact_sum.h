// SPDX-License-Identifier: GPL-2.0-or-later
// A sum of doubles without round-off: it depends neither on the order of its terms nor on who added them, so
// ranks may add their shares as they come and still agree with one rank to the last bit.
// Method: fixed point over the whole range of doubles, 32 bits to a word of 64 with room for carries
// (Neal 2015, arXiv:1505.05571, small superaccumulator).
#pragma once

#include <array>
#include <cstdint>

namespace structure {

class ExactSum {
 public:
  void add(double term);
  void add(ExactSum other);
  /// Rounded once; not finite if a term was not (inf - inf is not a number).
  double value() const;

  /// Words of two sums that are added word by word are those of the sum of both, for up to 2^29 sums.
  static constexpr int kPlaces = 67, kWords = kPlaces + 3;
  std::array<std::int64_t, kWords>& words() {
    carry();
    return words_;
  }

 private:
  void carry();

  /// Word k < kPlaces counts units of 2^(32 k - 1074); then how many terms were +inf, -inf, not a number.
  std::array<std::int64_t, kWords> words_{};
  int since_carry_ = 0;
};

inline void ExactSum::add(double term) {
  constexpr std::uint64_t kLow = 0xffffffff, kImplicit = std::uint64_t(1) << 52;
  constexpr int kMost = 1 << 28;  // a term adds less than 2^33 to a word
  std::uint64_t bits;
  static_assert(sizeof(bits) == sizeof(term));
  __builtin_memcpy(&bits, &term, sizeof(bits));
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  const bool negative = bits >> 63;
  std::uint64_t mantissa = bits & (kImplicit - 1);
  if (exponent == 0x7ff) {
    ++words_[kPlaces + (mantissa != 0 ? 2 : negative)];
    return;
  }
  if (exponent != 0) mantissa |= kImplicit;
  const int place = exponent == 0 ? 0 : exponent - 1, word = place / 32, shift = place % 32;
  const std::uint64_t low = (mantissa & kLow) << shift, high = (mantissa >> 32) << shift;
  const std::int64_t sign = negative ? -1 : 1;
  words_[word] += sign * static_cast<std::int64_t>(low & kLow);
  words_[word + 1] += sign * static_cast<std::int64_t>((low >> 32) + (high & kLow));
  words_[word + 2] += sign * static_cast<std::int64_t>(high >> 32);
  if (++since_carry_ == kMost) carry();
}

}  // namespace structure
