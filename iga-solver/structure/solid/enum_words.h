// SPDX-License-Identifier: GPL-2.0-or-later
// Words of model files for the values of an enumeration, which count from 0.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace structure {

/// The value that `word` names; throws std::invalid_argument, naming key and words, for another one.
template <class Enum, std::size_t count>
Enum enum_from_name(const char* key, const char* const (&names)[count], const std::string& word) {
  for (std::size_t i = 0; i < count; ++i)
    if (word == names[i]) return static_cast<Enum>(i);
  throw std::invalid_argument(
      fmt::format("{} is '{}', expected one of: {}", key, word, fmt::join(names, ", ")));
}

}  // namespace structure
