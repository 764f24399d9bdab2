// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/xml_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "geometry_io/file_kind.h"
#include "geometry_io/input_error.h"
#include "geometry_io/parse_number.h"

namespace geometry_io {
namespace {

bool parse_value(std::string_view word, int& value) { return parse_number(word, value); }

bool parse_value(std::string_view word, double& value) {
  const size_t slash = word.find('/');
  if (slash == std::string_view::npos) return parse_number(word, value);
  double divisor = 0.0;
  if (!parse_number(word.substr(0, slash), value) || !parse_number(word.substr(slash + 1), divisor))
    return false;
  value /= divisor;
  return true;
}

}  // namespace

XmlInput::XmlInput(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {
  expect_kind(FileKind::xml, file_, text);
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  if (!result) fail_at(result.offset, fmt::format("broken XML: {}", result.description()));
}

void XmlInput::fail_at(std::ptrdiff_t offset, const std::string& message) const {
  const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, text_.size());
  throw InputError(fmt::format("{}:{}: {}", file_, 1 + std::count(text_.begin(), end, '\n'), message));
}

void XmlInput::fail(pugi::xml_node node, const std::string& message) const {
  fail_at(node.offset_debug(), message);
}

pugi::xml_node XmlInput::child(pugi::xml_node node, const char* name) const {
  const pugi::xml_node found = node.child(name);
  if (!found) fail(node, fmt::format("<{}> has no <{}>, expected one", node.name(), name));
  if (found.next_sibling(name))
    fail(found.next_sibling(name), fmt::format("second <{}> in <{}>, expected one", name, node.name()));
  return found;
}

std::string XmlInput::attribute(pugi::xml_node node, const char* name) const {
  const pugi::xml_attribute found = node.attribute(name);
  if (!found) fail(node, fmt::format("<{}> has no attribute '{}'", node.name(), name));
  return found.value();
}

int XmlInput::integer_attribute(pugi::xml_node node, const char* name) const {
  const std::string text = attribute(node, name);
  int value = 0;
  if (!parse_value(text, value))
    fail(node, fmt::format("attribute '{}' of <{}> is '{}', expected a whole number", name, node.name(),
                           shown(text)));
  return value;
}

template <class Number>
static std::vector<Number> parse_list(const XmlInput& file, pugi::xml_node node) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string_view text = node.child_value();
  std::vector<Number> values;
  for (size_t begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    if (!parse_value(word, values.emplace_back()))
      file.fail(node, fmt::format("number {} of <{}> is '{}', expected {}", values.size(), node.name(),
                                  shown(std::string(word)),
                                  std::is_same_v<Number, int> ? "a whole number" : "a number"));
    begin = text.find_first_not_of(kBlanks, end);
  }
  return values;
}

std::vector<double> XmlInput::numbers(pugi::xml_node node) const { return parse_list<double>(*this, node); }
std::vector<int> XmlInput::integers(pugi::xml_node node) const { return parse_list<int>(*this, node); }

}  // namespace geometry_io
