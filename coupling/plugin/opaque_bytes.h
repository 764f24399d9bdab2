// SPDX-License-Identifier: GPL-2.0-or-later
// Bytes that mean nothing to us as the numbers of which saved states consist.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace coupling {

/// How many bytes go into a double as a whole number, so that every one is finite and exact.
constexpr std::size_t kBytesPerNumber = 6;

/// Their count, then they.
inline std::vector<double> numbers_from(const std::vector<unsigned char>& bytes) {
  std::vector<double> numbers{static_cast<double>(bytes.size())};
  for (std::size_t i = 0; i < bytes.size(); i += kBytesPerNumber) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < kBytesPerNumber && i + k < bytes.size(); ++k)
      word |= std::uint64_t(bytes[i + k]) << (8 * k);
    numbers.push_back(static_cast<double>(word));
  }
  return numbers;
}

/// Throws std::invalid_argument unless these are numbers of that kind.
inline std::vector<unsigned char> bytes_from(const std::vector<double>& numbers) {
  constexpr double kEnd = static_cast<double>(std::uint64_t(1) << (8 * kBytesPerNumber));
  const std::size_t words = numbers.empty() ? 0 : numbers.size() - 1;
  if (numbers.empty() || !(numbers[0] >= 0.0) || numbers[0] > static_cast<double>(kBytesPerNumber * words) ||
      numbers[0] <= static_cast<double>(kBytesPerNumber * words) - kBytesPerNumber)
    throw std::invalid_argument("a state of other numbers than a plug-in's, expected bytes");
  std::vector<unsigned char> bytes(static_cast<std::size_t>(numbers[0]));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double number = numbers[1 + i / kBytesPerNumber];
    if (!(number >= 0.0 && number < kEnd))
      throw std::invalid_argument("a state of other numbers than a plug-in's, expected bytes");
    bytes[i] = static_cast<unsigned char>(static_cast<std::uint64_t>(number) >> (8 * (i % kBytesPerNumber)));
  }
  return bytes;
}

}  // namespace coupling
