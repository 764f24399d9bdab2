// SPDX-License-Identifier: GPL-2.0-or-later
// Logarithms of volume ratios J, of any kind of number: doubles, or words of them.
//   J = 2^k m, m from sqrt(1/2) to sqrt(2);  ln J = k ln 2 + ln(1 + f),  f = m - 1, or J - 1 itself if k = 0;
//   ln(1 + f) = 2 artanh(s) = s (2 + z R(z)),  s = f / (2 + f),  z = s^2,
// R being the polynomial whose largest error is least: 1.3e-18 of the logarithm (found by Remez' exchange).
// Source: Abramowitz & Stegun (1964), eq. 4.1.27.
#pragma once

#include <limits>
#include <type_traits>

namespace structure {

/// Whole numbers as wide as the doubles of Number.
template <class Number>
struct Bits {
  typedef unsigned long long Type __attribute__((vector_size(sizeof(Number))));
};
template <>
struct Bits<double> {
  using Type = unsigned long long;
};

template <class To, class From>
[[gnu::always_inline]] inline To same_bits(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  __builtin_memcpy(&to, &from, sizeof to);
  return to;
}

/// Of a comparison of numbers, or of words of them.
template <class Mask>
[[gnu::always_inline]] inline bool all_true(const Mask& mask) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask;
  } else {
    typedef signed char Bytes __attribute__((vector_size(sizeof(Mask) / 8)));
    const Bytes bytes = __builtin_convertvector(mask, Bytes);
    long long all = -1;
    __builtin_memcpy(&all, &bytes, sizeof bytes);
    return all == -1;
  }
}

template <class Number>
struct Logarithm {
  Number value;    ///< ln J
  Number excess;   ///< J - 1 - ln J
  Number inverse;  ///< 1 / J
};

/// To a few units in the last place of max(1, |ln J|), and where J is near 1 of ln J and of the excess
/// themselves.  `x` is J - 1, and has digits that J has lost.  Not a number where J is not > 0; no denormal
/// J.
template <class Number>
[[gnu::always_inline]] inline Logarithm<Number> logarithm(const Number& J, const Number& x) {
  using Whole = typename Bits<Number>::Type;
  constexpr unsigned long long kOne = 0x3ff0000000000000, kRootHalf = 0x3fe6a09e667f3bcd,
                               kExponent = 0x7ff0000000000000, kTwo52 = 0x4330000000000000;
  constexpr double kLn2 = 0.6931471805599453, kNone = std::numeric_limits<double>::quiet_NaN();
  const Whole exponent = (same_bits<Whole>(J) + (kOne - kRootHalf)) & kExponent;  // of 2^k
  const Number k = same_bits<Number>((exponent >> 52) | kTwo52) - (0x1p52 + 1023.0),
               per_2_k = same_bits<Number>(2 * kOne - exponent);
  const Number f = k == 0.0 ? x : J * per_2_k - 1.0;
  const Number sum = J > 0.0 ? 2.0 + f : Number{} + kNone;
  const Number both = 1.0 / (J * sum);  // one division for two quotients
  const Number s = f * J * both, z = s * s;
  const Number R =
      0.6666666666666735 +
      z * (0.3999999999941312 +
           z * (0.28571428742766847 +
                z * (0.2222219853106592 +
                     z * (0.18183566672068083 + z * (0.1531398671302577 + z * 0.14796625007149644)))));
  const Number ln_J = k * kLn2 + s * (2.0 + z * R);
  return {ln_J, k == 0.0 ? s * (x - z * R) : x - ln_J, sum * both};  // x - 2 s = x s
}

}  // namespace structure
