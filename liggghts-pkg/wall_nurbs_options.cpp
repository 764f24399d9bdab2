// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_nurbs_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "geometry_io/geometry_io.h"
#include "keyword_table.h"
#include "model_words.h"
#include "motion_words.h"
#include "placement_words.h"
#include "stock_words.h"
#include "structure_words.h"

namespace liggghts_pkg {

namespace {

const std::vector<std::string> kModelStarts = {"model", "tangential", "cohesion", "rolling_friction"};

constexpr int kMostContacts = 256, kMostTwinCells = 100;

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What a row of the table reads: the words after its own, into the options.
struct Reading {
  const std::string& keyword;
  WordReader& words;
  const VariableLookup& variable;
  WallNurbsOptions& options;
};

void read_body(const Reading& in, WallNurbsOptions::Body body) {
  if (!in.options.file.empty()) fail("both 'structure' and 'geometry' are given, expected one of them");
  in.options.body = body;
  if (body == WallNurbsOptions::Body::iga) {
    if (const std::optional<PluginWords> plugin = read_plugin(in.words)) {
      in.options.body = WallNurbsOptions::Body::plugin;
      in.options.plugin = plugin->library;
      in.options.file = plugin->model;
      return;
    }
  }
  in.options.file = in.words.value("a file");
}

void read_search(const Reading& in) {
  in.options.search = in.words.value_of(in.keyword, {"newton", "simplex_brent"}) == "newton"
                          ? contact::SearchMethod::newton
                          : contact::SearchMethod::simplex_brent;
}

void read_contacts(const Reading& in) {
  in.options.slots = in.words.count(in.keyword,
                                    "how many contacts one particle may have with the wall (each has its "
                                    "place in every particle's memory)",
                                    kMostContacts);
}

void read_twin(const Reading& in) {
  in.options.twin = in.words.count(
      in.keyword, "how many cells of two triangles an element has in each direction", kMostTwinCells);
}

void read_substeps(const Reading& in) {
  coupling::SubstepOptions substeps;
  if (in.words.next_is_one_of({"particles", "structure"}))
    substeps.fast = in.words.keyword() == "particles" ? coupling::SubstepOptions::Fast::particles
                                                      : coupling::SubstepOptions::Fast::structure;
  if (in.words.next_is_one_of({"auto"}))
    in.words.keyword();
  else
    substeps.count = in.words.count(
        in.keyword, "'auto' or a number of steps, after 'particles' or 'structure' if that is to be said",
        coupling::kMostSubsteps);
  in.options.substeps = std::move(substeps);
}

void read_contact_area(const Reading& in) {
  in.options.contact_area = {in.words.value_of(in.keyword, {"overlap", "projection", "constant"})};
  if (in.options.contact_area.front() == "constant")
    in.options.contact_area.push_back(fmt::format("{}", in.words.number_above_zero(in.keyword)));
}

void read_drive_of_wall(const Reading& in) {
  read_drive(in.keyword, in.words, in.variable, in.options.drive);
}

void read_placement_of_wall(const Reading& in) { read_placement(in.keyword, in.words, in.options.placement); }

// Checked here: where the name is forgotten, the keyword after `keep` is taken for it.
void read_kept(const Reading& in) {
  std::string& keep = in.options.keep;
  keep = in.words.value("the name of the file that is kept, which ends in .h5");
  if (std::filesystem::path(keep).extension() == ".h5") return;
  const std::filesystem::path file = in.options.file.empty() ? "wall" : in.options.file;
  fail(fmt::format("keep is '{}', expected a name that ends in .h5, as in 'keep {}'", keep,
                   file.filename().replace_extension(".h5").string()));
}

constexpr Keyword<void(const Reading&)> kWallKeywords[] = {
    {"type", "type T",
     [](const Reading& in) {
       in.options.atom_type = in.words.count(in.keyword, "the number of an atom type");
     }},
    {"structure", "structure FILE", [](const Reading& in) { read_body(in, WallNurbsOptions::Body::iga); }},
    {"geometry", "geometry FILE", [](const Reading& in) { read_body(in, WallNurbsOptions::Body::rigid); }},
    {"state", "state STATE", [](const Reading& in) { read_state(in.words, in.options.solid); }},
    {"body", "body modal N", [](const Reading& in) { read_modes(in.words, in.options.solid); }},
    {"keep", "keep KEPT.h5", read_kept},
    {"surface", "surface NAME",
     [](const Reading& in) { in.options.surface = in.words.value("the name of a surface in the file"); }},
    {"edge_angle", "edge_angle A",
     [](const Reading& in) { in.options.edge_angle = in.words.angle(in.keyword); }},
    {"scale", "scale S", read_placement_of_wall},
    {"move", "move X Y Z", read_placement_of_wall},
    {"rotate", "rotate axis X Y Z angle A", read_placement_of_wall},
    {"material", "material independent",
     [](const Reading& in) {
       in.words.value_of(in.keyword, {"independent"});
       in.options.material_independent = true;
     }},
    {"store_force", "store_force yes|no",
     [](const Reading& in) {
       in.options.store_force = in.words.value_of(in.keyword, {"yes", "no"}) == "yes";
     }},
    {"search", "search newton|simplex_brent", read_search},
    {"contacts", "contacts N", read_contacts},
    {"rstar", "rstar particle|curvature",
     [](const Reading& in) {
       in.options.curvature_radius = in.words.value_of(in.keyword, {"particle", "curvature"}) == "curvature";
     }},
    {"temperature", "temperature T",
     [](const Reading& in) {
       in.options.temperature = fmt::format("{}", in.words.number_at_least_zero(in.keyword));
     }},
    {"contact_area", "contact_area overlap|projection|constant A", read_contact_area},
    {"compliance", "compliance corrected|none",
     [](const Reading& in) {
       in.options.solid.corrects_contacts =
           in.words.value_of(in.keyword, {"corrected", "none"}) == "corrected";
     }},
    {"substeps", "substeps [particles|structure] N|auto", read_substeps},
    {"motion", "motion VERB ...", read_drive_of_wall},
    {"servo", "servo ...", read_drive_of_wall},
    {"surface_vel", "surface_vel Vx Vy Vz", read_drive_of_wall},
    {"surface_ang_vel", "surface_ang_vel ...", read_drive_of_wall},
    {"output", "output FILE every N [fields F ...] [average yes|no]",
     [](const Reading& in) { in.options.output = read_output(in.words); }},
    {"stl", "stl FILE every N [chord D]", [](const Reading& in) { in.options.stl = read_stl(in.words); }},
    {"twin", "twin N", read_twin},
    {"verbose", "verbose yes|no",
     [](const Reading& in) {
       in.options.verbose = in.words.value_of(in.keyword, {"yes", "no"}) == "yes";
     }},
};

[[noreturn]] void fail_unknown(const std::string& word) {
  if (contains(kModelStarts, word))
    fail(fmt::format(
        "'{}' stands too late: model, tangential, cohesion, rolling_friction and the surface model come "
        "first, in this order",
        word));
  fail(unknown_word("keyword", word, words_of(kWallKeywords)) +
       ", or a contact model's setting with on or off");
}

void check_kept(const WallNurbsOptions& options) {
  if (options.keep.empty()) return;
  const bool rigid = options.body == WallNurbsOptions::Body::rigid;
  if (!rigid || geometry_io::format_of_path(options.file) != geometry_io::format::cad)
    fail(fmt::format(
        "'keep' is for what is read of a CAD file, given '{} {}', expected 'geometry FILE' with a "
        "file .step, .stp, .iges or .igs, or no 'keep'",
        rigid ? "geometry" : "structure", options.file));
}

void check_solid(const WallNurbsOptions& options) {
  if (options.body == WallNurbsOptions::Body::iga) return;
  const char* const given = options.body == WallNurbsOptions::Body::rigid ? "geometry" : "structure plugin";
  for (const auto& [is_given, words] : {std::pair{!options.solid.state.empty(), "state"},
                                        std::pair{options.solid.modes.has_value(), "body modal"}})
    if (is_given)
      fail(fmt::format("'{}' is for a solid of ours, given '{}', expected 'structure FILE'", words, given));
}

struct Refusal {
  std::string given, expected;
};

// What is not shown to be right.
std::optional<Refusal> why_not_corrected(const WallNurbsOptions& options) {
  const ModelChoice models = model_of(options.model_words);
  if (options.body != WallNurbsOptions::Body::iga)
    return Refusal{
        fmt::format("is for a solid of ours, given '{}'",
                    options.body == WallNurbsOptions::Body::rigid ? "geometry" : "structure plugin"),
        "'structure FILE' or 'compliance none'"};
  if (!is_hertzian(models.normal))
    return Refusal{fmt::format("is for the laws hertz and penalty/hertz, given 'model {}'", models.normal),
                   "one of them or 'compliance none'"};
  if (models.cohesion != "off")
    return Refusal{fmt::format("is for contacts without cohesion, given 'cohesion {}'", models.cohesion),
                   "'compliance none'"};
  if (options.solid.modes)
    return Refusal{"is for a whole mesh, given 'body modal', whose modes hardly give way under a contact",
                   "one of them"};
  if (options.substeps) return Refusal{"is not for 'substeps'", "one of them"};
  return std::nullopt;
}

// Refused where it is asked for; where nothing is said contacts are then as they are without it.
void settle_compliance(WallNurbsOptions& options) {
  std::optional<bool>& corrects = options.solid.corrects_contacts;
  if (corrects == false) return;
  const std::optional<Refusal> refusal = why_not_corrected(options);
  if (!refusal) return;
  const std::string words = "'compliance corrected' " + refusal->given;
  if (corrects) fail(words + ", expected " + refusal->expected);
  corrects = false;
  if (options.body != WallNurbsOptions::Body::rigid) options.uncorrected = words;
}

void check_complete(const WallNurbsOptions& options) {
  if (options.atom_type == 0)
    fail("keyword 'type' is missing, expected 'type T', the atom type of the wall's material");
  if (options.file.empty())
    fail(
        "keyword 'structure' or 'geometry' is missing, expected 'structure FILE surface NAME' for a "
        "deforming wall or 'geometry FILE surface NAME' for a rigid one");
  if (options.surface.empty())
    fail(
        "keyword 'surface' is missing, expected 'surface NAME' after the file: a name under 'surfaces' in "
        "that file, or 'all' of it");
  if (!options.contact_area.empty() && options.temperature.empty())
    fail("'contact_area' is that of heat, expected 'temperature T' of the wall beside it");
  if (options.placement && options.body != WallNurbsOptions::Body::rigid)
    fail(
        "'scale', 'move' and 'rotate' place a rigid wall, given 'structure', expected them in the solid's "
        "model file, as in 'geometry: {file: part.h5, scale: 0.001, rotate: {axis: [1, 0, 0], angle: 90}, "
        "move: [0, 0, 1]}'");
  if (options.substeps && options.body == WallNurbsOptions::Body::rigid)
    fail("'substeps' are those of a deforming wall, given 'geometry', expected 'structure FILE'");
  if (options.substeps && options.solid.modes)
    fail(
        "'substeps' are those of a solid with a stable step, given 'body modal', expected one of them: modes "
        "take any timestep");
  check_kept(options);
  check_solid(options);
  const std::string drive = drive_name(options.drive);
  if (!drive.empty() && options.body != WallNurbsOptions::Body::rigid)
    fail(fmt::format("'{}' drives a rigid wall, given 'structure', expected 'geometry FILE'", drive));
}

}  // namespace

std::vector<std::string> wall_nurbs_syntax() {
  std::vector<std::string> lines = syntax_of(kWallKeywords);
  lines.emplace_back("structure plugin LIBRARY MODEL");
  return lines;
}

WallNurbsOptions parse_wall_nurbs(const std::vector<std::string>& words, const VariableLookup& variable) {
  WallNurbsOptions options;
  const std::size_t model_count = check_contact_models(words);
  options.model_words.assign(words.begin(), words.begin() + model_count);

  std::vector<std::string> seen;
  WordReader reader(words, model_count);
  while (!reader.at_end()) {
    const std::string keyword = reader.keyword();
    if (contains(seen, keyword) && !contains(drive_keywords(), keyword) &&
        !contains(placement_keywords(), keyword))
      fail(fmt::format("keyword '{}' is given twice, expected once", keyword));
    seen.push_back(keyword);

    if (const auto* row = find_row(kWallKeywords, keyword)) {
      row->read({keyword, reader, variable, options});
    } else if (const auto* stock = find_row(kStockWords, keyword)) {
      fail(fmt::format("'{}' is for walls of LIGGGHTS' own, expected {} (doc/mesh_walls.md)", keyword,
                       stock->instead));
    } else if (reader.next_is_one_of({"on", "off"})) {
      options.setting_words.push_back(keyword);
      options.setting_words.push_back(reader.keyword());
    } else {
      fail_unknown(keyword);
    }
  }
  check_complete(options);
  settle_compliance(options);
  check_model_settings(options.setting_words);
  return options;
}

}  // namespace liggghts_pkg
