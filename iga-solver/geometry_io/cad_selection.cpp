// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <stdexcept>

#include "geometry_io/input_error.h"

namespace geometry_io {
namespace {

using brep::CadFace;
using brep::CadModel;

constexpr size_t kListed = 30;

const std::string& solid_name(const CadModel& model, const CadFace& face) {
  static const std::string none;
  return face.solid < 0 ? none : model.solids[face.solid].name;
}

int colour_of(const CadModel& model, const CadFace& face) {
  return face.colour >= 0 || face.solid < 0 ? face.colour : model.solids[face.solid].colour;
}

// Whether `part` is one or several whole components of a path.
bool has_component(const std::string& path, const std::string& part) {
  return !part.empty() && ("/" + path + "/").find("/" + part + "/") != std::string::npos;
}

std::optional<int> number_behind(const std::string& word, const char* start, int base) {
  const std::string head(start);
  if (word.compare(0, head.size(), head) != 0) return std::nullopt;
  int number = 0;
  const char *begin = word.data() + head.size(), *end = word.data() + word.size();
  const auto read = std::from_chars(begin, end, number, base);
  if (read.ec != std::errc() || read.ptr != end || begin == end)
    throw std::invalid_argument(
        fmt::format("'{}' has no {} behind its colon", shown(word), base == 16 ? "colour RRGGBB" : "number"));
  return number;
}

std::string listed(const std::set<std::string>& names) {
  std::vector<std::string> first;
  for (const std::string& name : names)
    if (first.size() < kListed) first.push_back(shown(name));
  return fmt::format("{}{}", fmt::join(first, ", "), names.size() > kListed ? ", ..." : "");
}

[[noreturn]] void fail_unknown(const CadModel& model, const std::string& word) {
  std::set<std::string> names, colours;
  for (const CadFace& face : model.faces) {
    if (!face.name.empty()) names.insert(face.name);
    if (!solid_name(model, face).empty()) names.insert(solid_name(model, face));
    const int colour = colour_of(model, face);
    if (colour >= 0) colours.insert(fmt::format("colour:{:06X}", colour));
  }
  throw std::invalid_argument(fmt::format(
      "no face of the CAD file is '{}', expected all, face:N with N from {} to {}{}{}{}{}", shown(word),
      model.faces.front().number, model.faces.back().number, colours.empty() ? "" : ", ", listed(colours),
      names.empty() ? " (the file names nothing)" : ", or one of: ", listed(names)));
}

}  // namespace

std::vector<int> cad_faces(const CadModel& model, const std::vector<std::string>& words) {
  std::set<int> found;
  for (const std::string& word : words) {
    const std::optional<int> number = number_behind(word, "face:", 10),
                             colour = number_behind(word, "colour:", 16);
    const auto is_meant = [&](const CadFace& face) {
      if (number) return face.number == *number;
      if (colour) return colour_of(model, face) == *colour;
      return word == "all" || face.name == word || has_component(solid_name(model, face), word);
    };
    bool any = false;
    for (size_t f = 0; f < model.faces.size(); ++f)
      if (is_meant(model.faces[f])) {
        found.insert(static_cast<int>(f));
        any = true;
      }
    if (!any) fail_unknown(model, word);
  }
  if (found.empty()) throw std::invalid_argument("no words, expected names of faces or solids, or all");
  return {found.begin(), found.end()};
}

}  // namespace geometry_io
