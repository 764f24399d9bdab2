// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers in users' files.
#pragma once

#include <charconv>
#include <string_view>

namespace geometry_io {

/// The whole text as a number, in every locale the same way and correctly rounded; false if it is anything
/// else.
template <class Number>
bool parse_number(std::string_view text, Number& number) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (last - first > 1 && *first == '+' && first[1] != '-')
    ++first;  // files may have a plus, from_chars does not
  const auto [end, error] = std::from_chars(first, last, number);
  return error == std::errc() && end == last;
}

}  // namespace geometry_io
