// SPDX-License-Identifier: GPL-2.0-or-later
// The words of a deck's line, read from left to right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/value.h"
#include "nurbs/types.h"

namespace liggghts_pkg {

/// The value of a deck's variable, from its name without "v_"; throws std::invalid_argument if there is none.
using VariableLookup = std::function<coupling::Value(const std::string& name)>;

/// Throws std::invalid_argument: what was given and what was expected, of one wall.
[[noreturn]] void fail(const std::string& message);

/// Every member throws std::invalid_argument that says what was given and what was expected.
class WordReader {
 public:
  /// `words` must outlive the reader.
  WordReader(const std::vector<std::string>& words, std::size_t next) : words_(words), next_(next) {}

  bool at_end() const { return next_ == words_.size(); }
  std::size_t position() const { return next_; }  ///< words read so far
  bool next_is_one_of(const std::vector<std::string>& choices) const;
  std::string keyword() { return words_[next_++]; }

  /// The next word; the other readers of values name the keyword that it belongs to in their messages.
  std::string value(const std::string& expected);
  std::string value_of(const std::string& keyword, const std::vector<std::string>& allowed);
  /// 1 or more, up to `most`, if there is a limit.
  int count(const std::string& keyword, const std::string& expected, std::optional<int> most = {});
  double number(const std::string& keyword);  ///< finite, of at most nurbs::kLargestNumber in size
  double number_at_least_zero(const std::string& keyword);
  double angle(const std::string& keyword);  ///< 0 to pi [rad]
  double number_above_zero(const std::string& keyword);
  nurbs::Vector3 vector(const std::string& keyword);
  std::vector<double> numbers(const std::string& keyword, int count);
  coupling::Value number_or_variable(const std::string& keyword, const VariableLookup& variable);
  /// The next word must be `word`.
  void expect(const std::string& word);

 private:
  const std::vector<std::string>& words_;
  std::size_t next_;
};

}  // namespace liggghts_pkg
