// SPDX-License-Identifier: GPL-2.0-or-later
// Tables of the words that a deck may hold: a row is a word, how the manual shows it with its values, and how
// these are read.  A table is what the parser goes through, gives the words that an error expects and the one
// that was probably meant, and a test holds the manual against it: a new word is a new row.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"

namespace liggghts_pkg {

/// `Read` is the type of the functions that read what stands after the word.
template <class Read>
struct Keyword {
  const char* word;
  const char* syntax;  ///< "contacts N"
  Read* read;
};

/// The row of `word`, or null.  Rows of any kind have a member `word`.
template <class Row, std::size_t n>
const Row* find_row(const Row (&table)[n], const std::string& word) {
  for (const Row& row : table)
    if (word == row.word) return &row;
  return nullptr;
}

template <class Row, std::size_t n>
std::vector<std::string> words_of(const Row (&table)[n]) {
  std::vector<std::string> words;
  for (const Row& row : table) words.push_back(row.word);
  return words;
}

template <class Row, std::size_t n>
std::vector<std::string> syntax_of(const Row (&table)[n]) {
  std::vector<std::string> lines;
  for (const Row& row : table) lines.push_back(row.syntax);
  return lines;
}

/// "unknown motion 'rotat' (did you mean 'rotate'?), expected one of linear, rotate"
inline std::string unknown_word(const std::string& kind, const std::string& given,
                                const std::vector<std::string>& known) {
  const std::string near = geometry_io::nearest_word(given, known);
  return fmt::format("unknown {} '{}'{}, expected one of {}", kind, given,
                     near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near), fmt::join(known, ", "));
}

}  // namespace liggghts_pkg
