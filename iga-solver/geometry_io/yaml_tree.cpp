// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>

#include "geometry_io/input_error.h"

namespace geometry_io {
namespace {

constexpr std::size_t kAliasAllowance = 1000000;  // values that aliases may add to those of the text

int line_of(const YAML::Mark& mark) { return std::max(mark.line, 0) + 1; }

/// Of a line, counted from 1.
std::string hint_of_tabs(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string words;
  for (int i = 0; i < line; ++i) std::getline(lines, words);
  return words.find('\t') < words.find_first_not_of(" \t") ? "; the line begins with a tab, expected spaces"
                                                           : "";
}

/// yaml-cpp takes a text without its second quote for one that ends with the file.  `begin`: as it counts,
/// without a mark of byte order, of the scalar with its anchor and tag.
bool is_open_quote(const std::string& text, std::size_t begin) {
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) begin += 3;
  while (begin < text.size() && (text[begin] == '&' || text[begin] == '!'))
    begin = text.find_first_not_of(" \t\r\n", text.find_first_of(" \t\r\n", begin));
  if (begin >= text.size() || !(text[begin] == '"' || text[begin] == '\'')) return false;
  const char quote = text[begin], escape = quote == '"' ? '\\' : '\'';
  for (std::size_t at = begin + 1; at < text.size(); ++at) {
    const bool is_escaped = text[at] == escape && (quote == '"' || text.compare(at + 1, 1, "'") == 0);
    if (!is_escaped && text[at] == quote) return false;
    at += is_escaped ? 1 : 0;
  }
  return true;
}

}  // namespace

// What yaml-cpp calls while it reads: one document after the other, each from its root down.
class YamlTree::Builder : public YAML::EventHandler {
 public:
  Builder(const std::string& text, const std::string& file, std::deque<YamlNode>& nodes)
      : text_(text), file_(file), nodes_(nodes) {}

  // Where a document starts that is no document: the parser has read nothing and would come again for ever.
  void OnDocumentStart(const YAML::Mark& mark) override {
    if (mark.pos == last_start_)
      fail_at_line(file_, line_of(mark), "broken YAML: text where a key or the end is expected");
    last_start_ = mark.pos;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    append(mark, anchor, YamlNode::Kind::empty);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& value) override {
    if (is_open_quote(text_, static_cast<std::size_t>(std::max(mark.pos, 0))))
      fail_at_line(file_, line_of(mark), "broken YAML: a quoted text begins here and does not end");
    append(mark, anchor, YamlNode::Kind::scalar).scalar = value;
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const YamlNode* const node = anchor <= anchored_.size() ? anchored_[anchor - 1] : nullptr;
    if (node == nullptr || std::find(open_.begin(), open_.end(), node) != open_.end())
      fail_at_line(file_, line_of(mark), "broken YAML: an alias stands inside of what it is an alias of");
    aliased_ += node->size;
    if (aliased_ > kAliasAllowance + text_.size())
      fail_at_line(file_, line_of(mark),
                   fmt::format("aliases stand for more than {} values, expected fewer", kAliasAllowance));
    attach(*node);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back(&append(mark, anchor, YamlNode::Kind::list));
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open_.push_back(&append(mark, anchor, YamlNode::Kind::map));
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

  const std::vector<const YamlNode*>& roots() const { return roots_; }

 private:
  YamlNode& append(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) {
    YamlNode& node = nodes_.emplace_back(YamlNode{kind, line_of(mark), {}, {}});
    if (anchor != 0) {  // counted from 1 in each document
      anchored_.resize(std::max(anchored_.size(), anchor));
      anchored_[anchor - 1] = &node;
    }
    attach(node);
    return node;
  }
  void attach(const YamlNode& node) {
    if (open_.empty())
      roots_.push_back(&node);
    else
      open_.back()->children.push_back(&node);
  }
  void close() {
    YamlNode& node = *open_.back();
    for (const YamlNode* child : node.children) node.size += child->size;
    open_.pop_back();
  }

  const std::string& text_;
  const std::string& file_;
  std::deque<YamlNode>& nodes_;
  std::vector<YamlNode*> open_;
  std::vector<const YamlNode*> anchored_, roots_;
  std::size_t aliased_ = 0;
  int last_start_ = -1;
};

YamlTree::YamlTree(const std::string& text, const std::string& file) {
  Builder builder(text, file, nodes_);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::DeepRecursion& error) {
    fail_at_line(file, line_of(error.mark),
                 "lists or mappings nested too deeply, expected 500 levels at most");
  } catch (const YAML::Exception& error) {
    fail_at_line(file, line_of(error.mark),
                 "broken YAML: " + shown(error.msg) + hint_of_tabs(text, line_of(error.mark)));
  }
  const std::size_t count = builder.roots().size();
  if (count == 0) fail_at_line(file, 1, "file is empty, expected a mapping (key: value)");
  if (count > 1)
    fail_at_line(file, builder.roots()[1]->line, fmt::format("{} documents given, expected one", count));
  root_ = builder.roots().front();
}

}  // namespace geometry_io
