// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_nurbs_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "geometry_io/yaml_map.h"
#include "model_words.h"
#include "motion_words.h"

namespace liggghts_pkg {

namespace {

const std::vector<std::string> kKeywords = {
    "type",  "structure",   "geometry", "surface", "material",    "store_force",     "search", "contacts",
    "rstar", "temperature", "motion",   "servo",   "surface_vel", "surface_ang_vel", "output", "twin"};
const std::vector<std::string> kModelKeywords = {"model", "tangential", "cohesion", "rolling_friction"};

constexpr int kMostContacts = 256, kMostTwinCells = 100;

[[noreturn]] void fail(const std::string& message) { throw std::invalid_argument(message); }

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void fail_unknown(const std::string& word) {
  if (contains(kModelKeywords, word))
    fail(fmt::format(
        "'{}' stands too late: model, tangential, cohesion, rolling_friction and the surface model come "
        "first, in this order",
        word));
  const std::string near = geometry_io::nearest_word(word, kKeywords);
  fail(fmt::format("unknown keyword '{}'{}, expected one of {}, or a contact model's setting with on or off",
                   word, near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near),
                   fmt::join(kKeywords, ", ")));
}

void check_complete(const WallNurbsOptions& options) {
  if (options.atom_type == 0)
    fail("keyword 'type' is missing, expected 'type T', the atom type of the wall's material");
  if (options.file.empty())
    fail(
        "keyword 'structure' or 'geometry' is missing, expected 'structure FILE surface NAME' for a "
        "deforming wall or "
        "'geometry FILE surface NAME' for a rigid one");
  if (options.surface.empty())
    fail(
        "keyword 'surface' is missing, expected 'surface NAME' after the file, a name under 'surfaces' in "
        "that file");
  const std::string drive = drive_name(options.drive);
  if (!drive.empty() && options.body != WallNurbsOptions::Body::rigid)
    fail(fmt::format("'{}' drives a rigid wall, given 'structure', expected 'geometry FILE'", drive));
}

}  // namespace

WallNurbsOptions parse_wall_nurbs(const std::vector<std::string>& words, const VariableLookup& variable) {
  WallNurbsOptions options;
  const std::size_t model_count = check_contact_models(words);
  options.model_words.assign(words.begin(), words.begin() + model_count);

  std::vector<std::string> seen;
  WordReader reader(words, model_count);
  while (!reader.at_end()) {
    const std::string keyword = reader.keyword();
    if (contains(seen, keyword) && !contains(drive_keywords(), keyword))
      fail(fmt::format("keyword '{}' is given twice, expected once", keyword));
    seen.push_back(keyword);

    if (keyword == "type") {
      options.atom_type = reader.count(keyword, "the number of an atom type");
    } else if (keyword == "structure" || keyword == "geometry") {
      if (!options.file.empty()) fail("both 'structure' and 'geometry' are given, expected one of them");
      options.body = keyword == "structure" ? WallNurbsOptions::Body::iga : WallNurbsOptions::Body::rigid;
      options.file = reader.value("a file");
    } else if (keyword == "surface") {
      options.surface = reader.value("the name of a surface in the file");
    } else if (keyword == "material") {
      reader.value_of(keyword, {"independent"});
      options.material_independent = true;
    } else if (keyword == "store_force") {
      options.store_force = reader.value_of(keyword, {"yes", "no"}) == "yes";
    } else if (keyword == "search") {
      options.search = reader.value_of(keyword, {"newton", "simplex_brent"}) == "newton"
                           ? contact::SearchMethod::newton
                           : contact::SearchMethod::simplex_brent;
    } else if (keyword == "contacts") {
      options.slots = reader.count(keyword,
                                   "how many contacts one particle may have with the wall (each has its "
                                   "place in every particle's memory)",
                                   kMostContacts);
    } else if (keyword == "rstar") {
      options.curvature_radius = reader.value_of(keyword, {"particle", "curvature"}) == "curvature";
    } else if (keyword == "temperature") {
      options.temperature = fmt::format("{}", reader.number_at_least_zero(keyword));
    } else if (contains(drive_keywords(), keyword)) {
      read_drive(keyword, reader, variable, options.drive);
    } else if (keyword == "output") {
      options.output = read_output(reader);
    } else if (keyword == "twin") {
      options.twin = reader.count(keyword, "how many cells of two triangles an element has in each direction",
                                  kMostTwinCells);
    } else if (reader.next_is_one_of({"on", "off"})) {
      options.setting_words.push_back(keyword);
      options.setting_words.push_back(reader.keyword());
    } else {
      fail_unknown(keyword);
    }
  }
  check_complete(options);
  check_model_settings(options.setting_words);
  return options;
}

}  // namespace liggghts_pkg
