// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_nurbs_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "atom.h"
#include "deck_variable.h"
#include "domain.h"
#include "error.h"
#include "geometry_io/geometry_io.h"
#include "lammps.h"
#include "motion_words.h"
#include "update.h"

using namespace LAMMPS_NS;
using liggghts_pkg::WallNurbsOptions;

namespace {

// FixWallGran takes the granular path only for styles that start with wall/gran.
const char* const kStockStyle = "wall/gran/nurbs";

std::vector<std::string> stock_command_line(char** arg, const liggghts_pkg::WallNurbsOptions& options) {
  std::vector<std::string> words = {arg[0], arg[1], kStockStyle};
  words.insert(words.end(), options.model_words.begin(), options.model_words.end());
  // A plane that is thrown away at once: FixWallGran insists on a mesh or a primitive.
  for (const std::string& word :
       {std::string("primitive"), std::string("type"), std::to_string(options.atom_type),
        std::string("zplane"), std::string("0.")})
    words.push_back(word);
  if (options.store_force) words.insert(words.end(), {"store_force", "yes"});
  if (!options.temperature.empty()) words.insert(words.end(), {"temperature", options.temperature});
  if (!options.contact_area.empty()) {
    words.emplace_back("contact_area");
    words.insert(words.end(), options.contact_area.begin(), options.contact_area.end());
  }
  words.insert(words.end(), options.setting_words.begin(), options.setting_words.end());
  return words;
}

// LIGGGHTS' contact models would take their bounding spheres without a word.
void check_particles(const Atom& atom) {
  if (atom.superquadric_flag || atom.shapetype_flag)
    throw std::invalid_argument("the particles are superquadrics or polyhedra, expected spheres");
}

void check_type(int type, int types) {
  if (type > types)
    throw std::invalid_argument(
        fmt::format("type is {}, expected 1 to {}, the number of types in create_box", type, types));
}

// LIGGGHTS has others, which no geometry file names.
std::optional<geometry_io::Units> units_of_deck(const char* name) {
  for (const geometry_io::Units units : {geometry_io::Units::si, geometry_io::Units::cgs})
    if (std::strcmp(geometry_io::units_name(units), name) == 0) return units;
  return std::nullopt;
}

std::optional<geometry_io::Format> format_of_wall(const WallNurbsOptions& options) {
  if (options.body != WallNurbsOptions::Body::rigid) return std::nullopt;
  return geometry_io::format_of_path(options.file);
}

void check_units(const WallNurbsOptions& options, geometry_io::Units units, const char* deck_units) {
  if (format_of_wall(options) == geometry_io::format::stl) return;  // has none: its numbers are the deck's
  if (std::strcmp(geometry_io::units_name(units), deck_units) != 0)
    throw std::invalid_argument(fmt::format("'{}' has units {}, expected those of the deck, units {}",
                                            options.file, geometry_io::units_name(units), deck_units));
}

// Before it is read, and kept.
void check_units_of_cad(const WallNurbsOptions& options, const char* deck_units) {
  if (format_of_wall(options) == geometry_io::format::cad && !units_of_deck(deck_units))
    throw std::invalid_argument(
        fmt::format("'{}' is a CAD file, whose lengths are in mm or such a unit, given a deck in units {}, "
                    "expected units si or cgs",
                    options.file, deck_units));
}

liggghts_pkg::VariableLookup variables_of(LAMMPS* lmp, const std::string& fix_id) {
  return [=](const std::string& name) { return liggghts_pkg::deck_variable(lmp, fix_id, name); };
}

coupling::OpenedStructure open(MPI_Comm world, const WallNurbsOptions& options, const char* deck_units) {
  switch (options.body) {
    case WallNurbsOptions::Body::iga:
      return coupling::open_iga_structure(world, options.file, options.surface, options.solid);
    case WallNurbsOptions::Body::plugin:
      return coupling::open_plugin_structure(world, options.plugin, options.file, options.surface);
    case WallNurbsOptions::Body::rigid:
      break;
  }
  return coupling::open_rigid_surface(
      world, options.file, options.surface, options.drive,
      {units_of_deck(deck_units).value_or(geometry_io::Units::si), options.placement, options.edge_angle,
       options.search == contact::SearchMethod::newton, options.keep});
}

/// Of the particles of all ranks; infinite if there are none.
double smallest_radius(const LAMMPS& lmp) {
  double mine = std::numeric_limits<double>::infinity(), smallest;
  for (int i = 0; i < lmp.atom->nlocal; ++i) mine = std::min(mine, lmp.atom->radius[i]);
  MPI_Allreduce(&mine, &smallest, 1, MPI_DOUBLE, MPI_MIN, lmp.world);
  return smallest;
}

/// Of the particles of all ranks; 0 if there are none.
double heaviest_particle(const LAMMPS& lmp) {
  double mine = 0.0, heaviest;
  for (int i = 0; i < lmp.atom->nlocal; ++i) mine = std::max(mine, lmp.atom->rmass[i]);
  MPI_Allreduce(&mine, &heaviest, 1, MPI_DOUBLE, MPI_MAX, lmp.world);
  return heaviest;
}

}  // namespace

void WallNurbsSetup::complete_servo(LAMMPS* lmp, coupling::ServoSettings& servo) {
  if (!servo.automatic) return;
  servo.automatic->smallest_radius = [lmp] { return smallest_radius(*lmp); };
  // In each step: ranks rebuild their lists when they have to, not together.
  servo.automatic->near_particles = [this, lmp] {
    long all;
    MPI_Allreduce(&near_particles_, &all, 1, MPI_LONG, MPI_SUM, lmp->world);
    return all;
  };
}

void WallNurbsSetup::check_box(const Domain& box) {
  if (box.triclinic && (box.xperiodic || box.yperiodic || box.zperiodic))
    throw std::invalid_argument(
        "the simulation box is triclinic and periodic, expected an orthogonal one ('region ID block'), or "
        "boundaries that are not periodic");
}

int WallNurbsSetup::modify_drive(LAMMPS* lmp, const char* id, int narg, char** arg) {
  const std::vector<std::string> words(arg, arg + narg);
  liggghts_pkg::WordReader reader(words, 0);
  try {
    auto* const wall = dynamic_cast<coupling::RigidSurface*>(opened_.solver.get());
    if (!wall) throw std::invalid_argument("fix_modify: a deforming wall has nothing to modify");
    liggghts_pkg::change_drive(reader, variables_of(lmp, id), *wall);
  } catch (const std::exception& problem) {
    lmp->error->all(FLERR, liggghts_pkg::wall_message(id, problem.what()).c_str());
  }
  return static_cast<int>(reader.position());
}

WallNurbsSetup::WallNurbsSetup(LAMMPS* lmp, int narg, char** arg) {
  try {
    check_particles(*lmp->atom);
    check_box(*lmp->domain);
    options_ = liggghts_pkg::parse_wall_nurbs(std::vector<std::string>(arg + 3, arg + narg),
                                              variables_of(lmp, arg[0]));
    if (options_.drive.servo) complete_servo(lmp, *options_.drive.servo);
    check_type(options_.atom_type, lmp->atom->ntypes);
    check_units_of_cad(options_, lmp->update->unit_style);
    opened_ = open(lmp->world, options_, lmp->update->unit_style);
    if (!opened_.uncorrected.empty()) options_.uncorrected = opened_.uncorrected;
    if (options_.substeps) {
      options_.substeps->heaviest_particle = [lmp] { return heaviest_particle(*lmp); };
      opened_.solver = coupling::with_substeps(std::move(opened_.solver), *options_.substeps);
    }
    check_units(options_, opened_.units, lmp->update->unit_style);
  } catch (const std::exception& problem) {
    lmp->error->all(FLERR, liggghts_pkg::wall_message(arg[0], problem.what()).c_str());
  }
  stock_words_ = stock_command_line(arg, options_);
  for (std::string& word : stock_words_) stock_arg_.push_back(word.data());
}

void WallNurbsSetup::report_opening(const liggghts_pkg::WallMessages& messages) const {
  for (const std::string& warning : opened_.warnings)
    messages.warn(fmt::format("'{}': {}", options_.file, warning));
  if (!options_.uncorrected.empty())
    messages.print(
        fmt::format("'{}': contacts are as with 'compliance none': {}", options_.file, options_.uncorrected));
}
