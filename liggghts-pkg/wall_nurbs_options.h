// SPDX-License-Identifier: GPL-2.0-or-later
// The words of `fix ID group wall/nurbs ...`, split into ours and LIGGGHTS'.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/contact/local_search.h"
#include "coupling/rigid/rigid_surface.h"
#include "coupling/solid_options.h"
#include "coupling/substep_options.h"
#include "geometry_io/placement.h"
#include "output_words.h"
#include "word_reader.h"

namespace liggghts_pkg {

struct WallNurbsOptions {
  enum class Body { rigid, iga, plugin };

  std::vector<std::string> model_words;    ///< `model ... surface ...`, for LIGGGHTS' contact model factory
  std::vector<std::string> setting_words;  ///< on/off settings of these models, for LIGGGHTS
  int atom_type = 0;                       ///< the wall's material, 1-based
  Body body = Body::rigid;
  std::string file;                      ///< model file (iga), geometry file (rigid), a plug-in's model
  std::string plugin;                    ///< its shared library
  std::string keep;                      ///< what is read of a CAD file is written here, if not empty
  std::string surface;                   ///< name of the surface in that file
  double edge_angle = brep::kEdgeAngle;  ///< below which edges of a rigid wall are smooth [rad]
  coupling::SolidOptions solid;          ///< of a deforming wall
  std::string uncorrected;               ///< why its contacts are not corrected, if the deck does not say
  bool material_independent = false;     ///< the deck's E and nu may differ from the model file's
  bool store_force = false;
  contact::SearchMethod search = contact::SearchMethod::newton;
  int slots = 4;                          ///< contacts that one particle may have at a time
  bool curvature_radius = false;          ///< the effective radius takes the wall's curvature into account
  std::string temperature;                ///< of the wall, as LIGGGHTS reads it; empty: no heat transfer
  std::vector<std::string> contact_area;  ///< that heat goes through, likewise: "constant", "1e-6"
  std::optional<geometry_io::Placement> placement;   ///< of a rigid wall: what is done to its geometry first
  coupling::RigidDrive drive;                        ///< what moves it
  std::optional<coupling::SubstepOptions> substeps;  ///< of a deforming one
  OutputOptions output;
  StlOptions stl;
  int twin = 2;  ///< cells per element and direction of the triangle twin
  bool verbose = false;
};

/// Parses the words after `wall/nurbs`.  Throws std::invalid_argument: what was given, what was expected.
WallNurbsOptions parse_wall_nurbs(const std::vector<std::string>& words, const VariableLookup& variable);

/// The keywords with their values, as the manual shows them: "contacts N"; and the words after `structure`.
std::vector<std::string> wall_nurbs_syntax();

}  // namespace liggghts_pkg
