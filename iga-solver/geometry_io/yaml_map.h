// SPDX-License-Identifier: GPL-2.0-or-later
// A YAML mapping that knows where it stands, so that every complaint names the file, the line and the way
// out.
#pragma once

#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "geometry_io/input_error.h"
#include "geometry_io/yaml_tree.h"
#include "nurbs/types.h"

namespace geometry_io {

/// Range of a number, bounds excluded unless said; only what the user may type.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = false, high_included = false;
};
inline Range positive() { return {0.0, std::numeric_limits<double>::infinity(), false, false}; }
inline Range non_negative() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }

class YamlMap {
 public:
  /// Parses a text that holds one document; InputError with file and line on a syntax error or if the top
  /// level is no mapping, and if it is another program's file (file_kind.h).
  static YamlMap parse(const std::string& text, const std::string& file);

  /// InputError at the first key not listed, with the nearest listed key ("did you mean 'density'?"); also if
  /// a key is given twice.
  void allow_only(const std::vector<std::string>& allowed) const;
  bool has(const std::string& key) const;
  /// Whether the key's value is a list.
  bool is_list(const std::string& key) const;
  bool is_map(const std::string& key) const;
  /// InputError if a key is given twice.
  std::vector<std::string> keys() const;
  int line() const;  ///< 1-based
  int line_of(const std::string& key) const;

  // Getters: InputError if the key is missing, of the wrong kind or out of range.  Numbers must be finite.
  /// `example`: how it looks, for the message where it is none, "{end: 1e-3}".
  YamlMap map(const std::string& key, const char* example = nullptr) const;
  std::vector<YamlMap> list_of_maps(const std::string& key) const;
  std::string word(const std::string& key) const;
  std::string word_of(const std::string& key, std::initializer_list<const char*> allowed) const;
  std::vector<std::string> words(const std::string& key) const;
  /// Not none; `known`: for the message.
  std::vector<std::string> some_words(const std::string& key, const std::string& known) const;
  double number(const std::string& key, Range range = {}) const;
  int integer(const std::string& key, int low, int high) const;
  nurbs::Vector3 vector3(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;
  std::vector<int> integers(const std::string& key, int low, int high) const;
  /// A list of lists of numbers (knots, control points).
  std::vector<std::vector<double>> table(const std::string& key) const;

  /// The value on one line as a flow, numbers alike however they are written: for comparisons.
  std::string text_of(const std::string& key) const;

  /// Throws InputError "file:line: message", the line being that of the key (or of the mapping).
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  const std::string& file() const { return file_; }

 private:
  /// `where` is the dotted path used in messages ("geometry.box"), "" at the top; InputError if `node`, which
  /// is one of `tree`, is no mapping.
  YamlMap(std::shared_ptr<const YamlTree> tree, const YamlNode& node, std::string file, std::string where);
  const YamlNode* find(const std::string& key) const;  // or null
  const YamlNode& value(const std::string& key) const;
  const std::vector<const YamlNode*>& list(const std::string& key, const std::string& of) const;
  double read_number(const YamlNode& node, const std::string& name, Range range) const;
  int read_integer(const YamlNode& node, const std::string& name, int low, int high) const;
  std::string read_word(const YamlNode& node, const std::string& name) const;
  std::vector<double> read_numbers(const std::vector<const YamlNode*>& list, const std::string& name) const;
  std::string name_of(const std::string& key) const;
  [[noreturn]] void fail_at(const YamlNode& node, const std::string& message) const;

  std::shared_ptr<const YamlTree> tree_;
  const YamlNode* node_;
  std::string file_, where_;
};

/// The candidate nearest to `word` in edit distance, upper and lower case alike, or "" if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);
/// "did you mean 'density'? expected one of: law, density": of what is none of them.
std::string expected_one_of(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace geometry_io
