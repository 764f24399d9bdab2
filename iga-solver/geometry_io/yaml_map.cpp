// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/yaml_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "geometry_io/file_kind.h"
#include "geometry_io/parse_number.h"
#include "nurbs/usable_number.h"

namespace geometry_io {
namespace {

using NodeKind = YamlNode::Kind;

std::string described(const YamlNode& node) {
  if (node.kind == NodeKind::list) return fmt::format("a list of {}", node.children.size());
  if (node.kind == NodeKind::map) return "a mapping";
  return node.scalar.empty() ? "empty" : shown(node.scalar);
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

void add_text(const YamlNode& node, std::string& text) {
  const auto add_all = [&](char begin, char end, bool pairs) {
    text += begin;
    for (size_t i = 0; i < node.children.size(); ++i) {
      if (i > 0) text += pairs && i % 2 == 1 ? ": " : ", ";
      add_text(*node.children[i], text);
    }
    text += end;
  };
  double number = 0.0;
  if (node.kind == NodeKind::list)
    add_all('[', ']', false);
  else if (node.kind == NodeKind::map)
    add_all('{', '}', true);
  else
    text += parse_number(node.scalar, number) ? fmt::format("{}", number) : one_line(node.scalar);
}

std::string one_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  // Levenshtein distance, one row of the table at a time.
  const auto distance = [&](const std::string& other) {
    std::vector<size_t> row(other.size() + 1);
    for (size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (size_t i = 0; i < word.size(); ++i) {
      size_t diagonal = row[0];
      row[0] = i + 1;
      for (size_t j = 0; j < other.size(); ++j) {
        const size_t replaced = diagonal + !same(word[i], other[j]);
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

std::string expected_one_of(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_word(word, candidates);
  return (nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest)) +
         "expected one of: " + one_of(candidates);
}

YamlMap YamlMap::parse(const std::string& text, const std::string& file) {
  expect_kind(FileKind::text, file, text);
  const auto tree = std::make_shared<const YamlTree>(text, file);
  return YamlMap(tree, tree->root(), file, "");
}

YamlMap::YamlMap(std::shared_ptr<const YamlTree> tree, const YamlNode& node, std::string file,
                 std::string where)
    : tree_(std::move(tree)), node_(&node), file_(std::move(file)), where_(std::move(where)) {
  if (node.kind != NodeKind::map)
    fail_at(node, fmt::format("{} is {}, expected a mapping (key: value)", where_.empty() ? "file" : where_,
                              described(node)));
  if (find("<<"))
    fail("<<",
         "'<<' merges mappings in YAML 1.1 alone, expected the keys themselves, or an alias of a whole "
         "mapping");
}

const YamlNode* YamlMap::find(const std::string& key) const {
  const std::vector<const YamlNode*>& entries = node_->children;
  for (size_t i = 0; i < entries.size(); i += 2)
    if (entries[i]->kind == NodeKind::scalar && entries[i]->scalar == key) return entries[i + 1];
  return nullptr;
}

void YamlMap::allow_only(const std::vector<std::string>& allowed) const {
  for (const std::string& key : this->keys()) {
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    fail(key, fmt::format("unknown key '{}'{}, {}", shown(key), where_.empty() ? "" : " in " + where_,
                          expected_one_of(key, allowed)));
  }
}

bool YamlMap::has(const std::string& key) const { return find(key) != nullptr; }
bool YamlMap::is_map(const std::string& key) const { return value(key).kind == NodeKind::map; }
bool YamlMap::is_list(const std::string& key) const { return value(key).kind == NodeKind::list; }

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> keys;
  std::set<std::string> seen;
  for (size_t i = 0; i < node_->children.size(); i += 2) {
    const YamlNode& entry = *node_->children[i];
    keys.push_back(read_word(entry, "key"));
    if (!seen.insert(keys.back()).second)
      fail_at(entry, fmt::format("{} is given twice, expected once", name_of(keys.back())));
  }
  return keys;
}

int YamlMap::line() const { return node_->line; }

int YamlMap::line_of(const std::string& key) const {
  for (size_t i = 0; i < node_->children.size(); i += 2)
    if (node_->children[i]->kind == NodeKind::scalar && node_->children[i]->scalar == key)
      return node_->children[i]->line;
  return line();
}

YamlMap YamlMap::map(const std::string& key, const char* example) const {
  const YamlNode& node = value(key);
  if (example && node.kind != NodeKind::map)
    fail(key, fmt::format("{} is {}, expected a mapping: {}", name_of(key), described(node), example));
  return YamlMap(tree_, node, file_, name_of(key));
}

std::vector<YamlMap> YamlMap::list_of_maps(const std::string& key) const {
  std::vector<YamlMap> maps;
  for (const YamlNode* item : list(key, "mappings"))
    maps.push_back(YamlMap(tree_, *item, file_, fmt::format("{}[{}]", name_of(key), maps.size())));
  return maps;
}

std::string YamlMap::word(const std::string& key) const { return read_word(value(key), name_of(key)); }

std::string YamlMap::word_of(const std::string& key, std::initializer_list<const char*> allowed) const {
  const std::vector<std::string> words(allowed.begin(), allowed.end());
  if (!has(key))
    fail_at(*node_, fmt::format("{} is missing, expected one of: {}", name_of(key), one_of(words)));
  const std::string given = word(key);
  if (std::find(words.begin(), words.end(), given) == words.end())
    fail_at(value(key),
            fmt::format("{} is {}, {}", name_of(key), shown(given), expected_one_of(given, words)));
  return given;
}

std::vector<std::string> YamlMap::words(const std::string& key) const {
  std::vector<std::string> words;
  for (const YamlNode* item : list(key, "words")) words.push_back(read_word(*item, name_of(key)));
  return words;
}

std::vector<std::string> YamlMap::some_words(const std::string& key, const std::string& known) const {
  std::vector<std::string> words = this->words(key);
  if (words.empty()) fail(key, fmt::format("{} is empty, expected some of: {}", name_of(key), known));
  return words;
}

double YamlMap::number(const std::string& key, Range range) const {
  return read_number(value(key), name_of(key), range);
}

int YamlMap::integer(const std::string& key, int low, int high) const {
  return read_integer(value(key), name_of(key), low, high);
}

nurbs::Vector3 YamlMap::vector3(const std::string& key) const {
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
  for (const YamlNode* item : list(key, "whole numbers"))
    integers.push_back(read_integer(*item, name_of(key), low, high));
  return integers;
}

std::vector<std::vector<double>> YamlMap::table(const std::string& key) const {
  std::vector<std::vector<double>> rows;
  for (const YamlNode* row : list(key, "lists of numbers")) {
    const std::string name = fmt::format("{}[{}]", name_of(key), rows.size());
    if (row->kind != NodeKind::list)
      fail_at(*row, fmt::format("{} is {}, expected a list of numbers", name, described(*row)));
    rows.push_back(read_numbers(row->children, name));
  }
  return rows;
}

void YamlMap::fail(const std::string& key, const std::string& message) const {
  fail_at_line(file_, line_of(key), message);
}

const YamlNode& YamlMap::value(const std::string& key) const {
  const YamlNode* const found = find(key);
  if (found == nullptr) fail_at(*node_, fmt::format("{} is missing", name_of(key)));
  // An empty node stands where the parser noticed, often a line late: complain here, at the key.
  if (found->kind == NodeKind::empty) fail(key, fmt::format("{} is empty, expected a value", name_of(key)));
  return *found;
}

const std::vector<const YamlNode*>& YamlMap::list(const std::string& key, const std::string& of) const {
  const YamlNode& found = value(key);
  const std::string as =
      found.kind == NodeKind::scalar && of == "words" ? fmt::format(": [{}]", described(found)) : "";
  if (found.kind != NodeKind::list)
    fail(key, fmt::format("{} is {}, expected a list of {}{}", name_of(key), described(found), of, as));
  return found.children;
}

double YamlMap::read_number(const YamlNode& node, const std::string& name, Range range) const {
  double x = 0.0;
  if (node.kind != NodeKind::scalar || !parse_number(node.scalar, x) || !contains(range, x))
    fail_at(node, fmt::format("{} is {}, expected {}", name, described(node), described(range)));
  if (!nurbs::is_usable(x))
    fail_at(node, fmt::format("{} is {}, expected a number of at most {} in size", name, described(node),
                              nurbs::kLargestNumber));
  if (range.low == 0.0 && 0.0 < x && x < nurbs::kSmallestNumber)
    fail_at(node, fmt::format("{} is {}, expected a number of at least {}", name, described(node),
                              nurbs::kSmallestNumber));
  return x;
}

int YamlMap::read_integer(const YamlNode& node, const std::string& name, int low, int high) const {
  int i = 0;
  if (node.kind != NodeKind::scalar || !parse_number(node.scalar, i) || i < low || i > high)
    fail_at(node,
            fmt::format("{} is {}, expected a whole number from {} to {}", name, described(node), low, high));
  return i;
}

std::string YamlMap::read_word(const YamlNode& node, const std::string& name) const {
  if (node.kind != NodeKind::scalar || node.scalar.empty())
    fail_at(node, fmt::format("{} is {}, expected a word", name, described(node)));
  return node.scalar;
}

std::vector<double> YamlMap::read_numbers(const std::vector<const YamlNode*>& list,
                                          const std::string& name) const {
  std::vector<double> numbers;
  for (const YamlNode* item : list) numbers.push_back(read_number(*item, name, {}));
  return numbers;
}

std::string YamlMap::text_of(const std::string& key) const {
  std::string text;
  add_text(value(key), text);
  return text;
}

std::string YamlMap::name_of(const std::string& key) const {
  return where_.empty() ? key : where_ + "." + key;
}

void YamlMap::fail_at(const YamlNode& node, const std::string& message) const {
  fail_at_line(file_, node.line, message);
}

}  // namespace geometry_io
