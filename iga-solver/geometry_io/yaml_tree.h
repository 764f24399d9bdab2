// SPDX-License-Identifier: GPL-2.0-or-later
// A YAML text as a tree, built from yaml-cpp's events.  yaml-cpp's own loader does not end on some texts
// (",") and knows no bound for aliases.
#pragma once

#include <deque>
#include <string>
#include <vector>

namespace geometry_io {

struct YamlNode {
  enum class Kind { empty, scalar, list, map };
  Kind kind;
  int line;                               ///< 1-based
  std::string scalar;                     ///< of a scalar; empty otherwise
  std::vector<const YamlNode*> children;  ///< of a list: its items; of a map: key, value, key, value, ...
  std::size_t size = 1;                   ///< of the tree below, aliases counted as often as they stand
};

/// The one document of a text.  An alias is the node of its anchor.
class YamlTree {
 public:
  /// Throws InputError with file and line: broken YAML, no document or several of them, nodes nested deeper
  /// than 500, aliases that stand for more than a million values more than the text has characters.
  YamlTree(const std::string& text, const std::string& file);
  YamlTree(const YamlTree&) = delete;
  YamlTree& operator=(const YamlTree&) = delete;

  const YamlNode& root() const { return *root_; }

 private:
  class Builder;
  std::deque<YamlNode> nodes_;
  const YamlNode* root_ = nullptr;
};

}  // namespace geometry_io
