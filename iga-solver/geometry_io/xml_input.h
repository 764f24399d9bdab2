// SPDX-License-Identifier: GPL-2.0-or-later
// An XML file in memory whose complaints name file and line.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <vector>

namespace geometry_io {

/// Every function throws InputError "file:line: what is there, what is expected".
class XmlInput {
 public:
  /// `text` must outlive this object.
  XmlInput(const std::string& text, std::string file);

  pugi::xml_node root() const { return document_.document_element(); }
  /// The only child of this name.
  pugi::xml_node child(pugi::xml_node node, const char* name) const;
  std::string attribute(pugi::xml_node node, const char* name) const;
  int integer_attribute(pugi::xml_node node, const char* name) const;
  /// The element's text: numbers between blanks; for doubles also quotients a/b, as G+Smo reads them.
  std::vector<double> numbers(pugi::xml_node node) const;
  std::vector<int> integers(pugi::xml_node node) const;

  [[noreturn]] void fail(pugi::xml_node node, const std::string& message) const;

 private:
  [[noreturn]] void fail_at(std::ptrdiff_t offset, const std::string& message) const;

  const std::string& text_;
  std::string file_;
  pugi::xml_document document_;
};

}  // namespace geometry_io
