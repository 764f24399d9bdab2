// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/yaml_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/parse_number.h"

namespace nurbs {
namespace {

std::string described(const YAML::Node& node) {
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsMap()) return "a mapping";
  if (node.IsNull() || node.Scalar().empty()) return "empty";
  return shown(node.Scalar());
}

std::string described(Range range) {
  const bool below = std::isfinite(range.low), above = std::isfinite(range.high);
  const char* low_sign = range.low_included ? ">=" : ">";
  const char* high_sign = range.high_included ? "<=" : "<";
  if (below && above)
    return fmt::format("a number {} {} and {} {}", low_sign, range.low, high_sign, range.high);
  if (below) return fmt::format("a number {} {}", low_sign, range.low);
  if (above) return fmt::format("a number {} {}", high_sign, range.high);
  return "a finite number";
}

// False for infinite numbers and nan, too: an open end of a range is excluded.
bool contains(Range range, double x) {
  return (range.low_included ? x >= range.low : x > range.low) &&
         (range.high_included ? x <= range.high : x < range.high);
}

[[noreturn]] void fail_in(const std::string& file, int line, const std::string& message) {
  throw InputError(fmt::format("{}:{}: {}", file, line, one_line(message)));
}

int line_of_mark(const YAML::Mark& mark) { return std::max(mark.line, 0) + 1; }

std::string one_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  // Levenshtein distance, one row of the table at a time.
  const auto distance = [&word](const std::string& other) {
    std::vector<size_t> row(other.size() + 1);
    for (size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (size_t i = 0; i < word.size(); ++i) {
      size_t diagonal = row[0];
      row[0] = i + 1;
      for (size_t j = 0; j < other.size(); ++j) {
        const size_t replaced = diagonal + (word[i] != other[j]);
        diagonal = row[j + 1];
        row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
      }
    }
    return row.back();
  };
  std::string nearest;
  size_t least = std::numeric_limits<size_t>::max();
  for (const std::string& candidate : candidates) {
    const size_t longer = std::max(word.size(), candidate.size());
    const size_t d = distance(candidate);
    if (d < least && 3 * d <= longer + 2 && d < longer) least = d, nearest = candidate;
  }
  return nearest;
}

YamlMap YamlMap::parse(const std::string& text, const std::string& file) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.empty()) fail_in(file, 1, "file is empty, expected a mapping (key: value)");
    if (documents.size() > 1)
      fail_in(file, line_of_mark(documents[1].Mark()),
              fmt::format("{} documents given, expected one", documents.size()));
    return YamlMap(documents.front(), file, "");
  } catch (const YAML::Exception& error) {
    fail_in(file, line_of_mark(error.mark), "broken YAML: " + shown(error.msg));
  }
}

YamlMap::YamlMap(YAML::Node node, std::string file, std::string where)
    : node_(std::move(node)), file_(std::move(file)), where_(std::move(where)) {
  if (!node_.IsMap())
    fail_at(node_, fmt::format("{} is {}, expected a mapping (key: value)", where_.empty() ? "file" : where_,
                               described(node_)));
}

void YamlMap::allow_only(std::initializer_list<const char*> keys) const {
  const std::vector<std::string> allowed(keys.begin(), keys.end());
  std::vector<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = read_word(entry.first, "key");
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      fail_at(entry.first, fmt::format("{} is given twice, expected once", name_of(key)));
    seen.push_back(key);
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    const std::string nearest = nearest_word(key, allowed);
    const std::string hint = nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest);
    fail_at(entry.first, fmt::format("unknown key '{}'{}, {}expected one of: {}", shown(key),
                                     where_.empty() ? "" : " in " + where_, hint, one_of(allowed)));
  }
}

bool YamlMap::has(const std::string& key) const { return node_[key].IsDefined(); }
bool YamlMap::is_list(const std::string& key) const { return value(key).IsSequence(); }

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> keys;
  for (const auto& entry : node_) keys.push_back(read_word(entry.first, "key"));
  return keys;
}

int YamlMap::line() const { return line_of_mark(node_.Mark()); }

int YamlMap::line_of(const std::string& key) const {
  for (const auto& entry : node_)
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return line_of_mark(entry.first.Mark());
  return line();
}

YamlMap YamlMap::map(const std::string& key) const { return YamlMap(value(key), file_, name_of(key)); }

std::vector<YamlMap> YamlMap::list_of_maps(const std::string& key) const {
  std::vector<YamlMap> maps;
  for (const YAML::Node& item : list(key, "mappings"))
    maps.emplace_back(item, file_, fmt::format("{}[{}]", name_of(key), maps.size()));
  return maps;
}

std::string YamlMap::word(const std::string& key) const { return read_word(value(key), name_of(key)); }

std::string YamlMap::word_of(const std::string& key, std::initializer_list<const char*> allowed) const {
  const std::vector<std::string> words(allowed.begin(), allowed.end());
  const std::string given = word(key);
  if (std::find(words.begin(), words.end(), given) == words.end())
    fail_at(value(key),
            fmt::format("{} is {}, expected one of: {}", name_of(key), shown(given), one_of(words)));
  return given;
}

std::vector<std::string> YamlMap::words(const std::string& key) const {
  std::vector<std::string> words;
  for (const YAML::Node& item : list(key, "words")) words.push_back(read_word(item, name_of(key)));
  return words;
}

double YamlMap::number(const std::string& key, Range range) const {
  return read_number(value(key), name_of(key), range);
}

int YamlMap::integer(const std::string& key, int low, int high) const {
  return read_integer(value(key), name_of(key), low, high);
}

Vector3 YamlMap::vector3(const std::string& key) const {
  const std::vector<double> xyz = numbers(key);
  if (xyz.size() != 3)
    fail(key, fmt::format("{} is a list of {}, expected 3 numbers", name_of(key), xyz.size()));
  return {xyz[0], xyz[1], xyz[2]};
}

std::vector<double> YamlMap::numbers(const std::string& key) const {
  return read_numbers(list(key, "numbers"), name_of(key));
}

std::vector<int> YamlMap::integers(const std::string& key, int low, int high) const {
  std::vector<int> integers;
  for (const YAML::Node& item : list(key, "whole numbers"))
    integers.push_back(read_integer(item, name_of(key), low, high));
  return integers;
}

std::vector<std::vector<double>> YamlMap::table(const std::string& key) const {
  std::vector<std::vector<double>> rows;
  for (const YAML::Node& row : list(key, "lists of numbers")) {
    const std::string name = fmt::format("{}[{}]", name_of(key), rows.size());
    if (!row.IsSequence())
      fail_at(row, fmt::format("{} is {}, expected a list of numbers", name, described(row)));
    rows.push_back(read_numbers(row, name));
  }
  return rows;
}

void YamlMap::fail(const std::string& key, const std::string& message) const {
  fail_in(file_, line_of(key), message);
}

YAML::Node YamlMap::value(const std::string& key) const {
  const YAML::Node found = node_[key];
  if (!found.IsDefined()) fail_at(node_, fmt::format("{} is missing", name_of(key)));
  // An empty node stands where the parser noticed, often a line late: complain here, at the key.
  if (found.IsNull()) fail(key, fmt::format("{} is empty, expected a value", name_of(key)));
  return found;
}

YAML::Node YamlMap::list(const std::string& key, const std::string& of) const {
  const YAML::Node found = value(key);
  if (!found.IsSequence())
    fail(key, fmt::format("{} is {}, expected a list of {}", name_of(key), described(found), of));
  return found;
}

double YamlMap::read_number(const YAML::Node& node, const std::string& name, Range range) const {
  double x = 0.0;
  if (!node.IsScalar() || !parse_number(node.Scalar(), x) || !contains(range, x))
    fail_at(node, fmt::format("{} is {}, expected {}", name, described(node), described(range)));
  return x;
}

int YamlMap::read_integer(const YAML::Node& node, const std::string& name, int low, int high) const {
  int i = 0;
  if (!node.IsScalar() || !parse_number(node.Scalar(), i) || i < low || i > high)
    fail_at(node,
            fmt::format("{} is {}, expected a whole number from {} to {}", name, described(node), low, high));
  return i;
}

std::string YamlMap::read_word(const YAML::Node& node, const std::string& name) const {
  if (!node.IsScalar() || node.Scalar().empty())
    fail_at(node, fmt::format("{} is {}, expected a word", name, described(node)));
  return node.Scalar();
}

std::vector<double> YamlMap::read_numbers(const YAML::Node& list, const std::string& name) const {
  std::vector<double> numbers;
  for (const YAML::Node& item : list) numbers.push_back(read_number(item, name, {}));
  return numbers;
}

std::string YamlMap::name_of(const std::string& key) const {
  return where_.empty() ? key : where_ + "." + key;
}

void YamlMap::fail_at(const YAML::Node& node, const std::string& message) const {
  fail_in(file_, line_of_mark(node.Mark()), message);
}

}  // namespace nurbs
