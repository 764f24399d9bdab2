// SPDX-License-Identifier: GPL-2.0-or-later
// Sizes that messages advise, beside one that is given with three digits: rounded away from it, or both might
// read alike.
#ifndef LMP_ADVISED_SIZE_H
#define LMP_ADVISED_SIZE_H

#include <cmath>

namespace liggghts_pkg {

inline double third_digit(double size) {
  return std::pow(10.0, std::floor(std::log10(size * (1.0 + 1e-9))) - 2.0);
}
inline double of_three_digits(double size) {
  return std::round(size / third_digit(size)) * third_digit(size);
}

/// The number of three digits after that as which `size` > 0 reads.
inline double rounded_up(double size) {
  const double read = of_three_digits(size);
  return read + third_digit(read);
}
/// And the one before it.
inline double rounded_down(double size) {
  const double read = of_three_digits(size);
  return read - third_digit(read);
}

}  // namespace liggghts_pkg

#endif
