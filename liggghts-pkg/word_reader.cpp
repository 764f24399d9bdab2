// SPDX-License-Identifier: GPL-2.0-or-later
#include "word_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "nurbs/types.h"
#include "nurbs/usable_number.h"

namespace liggghts_pkg {

namespace {

/// The whole of the word as a number, if it is one.
template <typename Number>
std::optional<Number> parsed(const std::string& word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  const char* const first = word.data() + (has_plus ? 1 : 0);
  const char* const last = word.data() + word.size();
  Number number;
  const auto [end, problem] = std::from_chars(first, last, number);
  if (problem != std::errc() || end != last) return std::nullopt;
  return number;
}

}  // namespace

void fail(const std::string& message) { throw std::invalid_argument(message); }

bool WordReader::next_is_one_of(const std::vector<std::string>& choices) const {
  return !at_end() && std::find(choices.begin(), choices.end(), words_[next_]) != choices.end();
}

std::string WordReader::value(const std::string& expected) {
  if (at_end()) fail(fmt::format("'{}' is the last word, expected {} after it", words_.back(), expected));
  return words_[next_++];
}

std::string WordReader::value_of(const std::string& keyword, const std::vector<std::string>& allowed) {
  const std::string expected = fmt::format("'{}'", fmt::join(allowed, "' or '"));
  const std::string given = value(expected);
  if (std::find(allowed.begin(), allowed.end(), given) == allowed.end())
    fail(fmt::format("{} is '{}', expected {}", keyword, given, expected));
  return given;
}

int WordReader::count(const std::string& keyword, const std::string& expected, std::optional<int> most) {
  const std::string word = value(expected);
  const std::optional<int> number = parsed<int>(word);
  if (!number || *number < 1 || (most && *number > *most))
    fail(fmt::format("{} is '{}', expected {}, {}", keyword, word, expected,
                     most ? fmt::format("1 to {}", *most) : "1 or more"));
  return *number;
}

double WordReader::number(const std::string& keyword) {
  const std::string word = value(fmt::format("a number for '{}'", keyword));
  const std::optional<double> number = parsed<double>(word);
  if (!number || !std::isfinite(*number)) fail(fmt::format("{} is '{}', expected a number", keyword, word));
  if (!nurbs::is_usable(*number))
    fail(fmt::format("{} is '{}', expected a number of at most {} in size", keyword, word,
                     nurbs::kLargestNumber));
  return *number;
}

double WordReader::number_at_least_zero(const std::string& keyword) {
  const double given = number(keyword);
  if (given < 0.0) fail(fmt::format("{} is '{}', expected a number, 0 or more", keyword, words_[next_ - 1]));
  return given;
}

// Pi may be rounded up.
double WordReader::angle(const std::string& keyword) {
  constexpr double kRounded = 3.15;
  const double given = number(keyword);
  if (given < 0.0 || given > kRounded)
    fail(fmt::format("{} is '{}', expected 0 to pi (3.14159), in rad", keyword, words_[next_ - 1]));
  return std::min(given, nurbs::kPi);
}

double WordReader::number_above_zero(const std::string& keyword) {
  const double given = number(keyword);
  if (given <= 0.0) fail(fmt::format("{} is '{}', expected a number above 0", keyword, words_[next_ - 1]));
  return given;
}

nurbs::Vector3 WordReader::vector(const std::string& keyword) {
  nurbs::Vector3 v;
  for (int d = 0; d < 3; ++d) v[d] = number(keyword);
  return v;
}

std::vector<double> WordReader::numbers(const std::string& keyword, int count) {
  std::vector<double> all(count);
  for (double& one : all) one = number(keyword);
  return all;
}

coupling::Value WordReader::number_or_variable(const std::string& keyword, const VariableLookup& variable) {
  if (!at_end() && words_[next_].compare(0, 2, "v_") == 0) return variable(words_[next_++].substr(2));
  return number(keyword);
}

void WordReader::expect(const std::string& word) {
  const std::string given = value(fmt::format("'{}'", word));
  if (given != word) fail(fmt::format("'{}' stands where '{}' is expected", given, word));
}

}  // namespace liggghts_pkg
