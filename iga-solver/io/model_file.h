// SPDX-License-Identifier: GPL-2.0-or-later
// The model file of a deformable solid (YAML): what README.md of this folder lists.  The same file serves a
// run with particles and one without (iga-solve).  `units` names a consistent system; numbers are taken as
// they are.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry_io/geometry_io.h"
#include "io/analysis_keys.h"
#include "io/boundary_keys.h"
#include "io/load_keys.h"
#include "io/output_keys.h"
#include "io/run_keys.h"
#include "io/state_file.h"
#include "structure/conditions/probe.h"
#include "structure/node_numbering.h"
#include "structure/partition.h"
#include "structure/solid/solid.h"
#include "structure/time/explicit_solver.h"

namespace io {

using nurbs::Vector3;

struct ModelFile {
  std::string file;  ///< as given, for messages
  int geometry_line;
  geometry_io::GeometryFile geometry;                                 ///< holds Volumes alone
  structure::NodeNumbering nodes;                                     ///< of their control points
  std::vector<std::shared_ptr<const structure::Material>> materials;  ///< of each patch
  bool welds = true;                                                  ///< unless `weld: no`
  structure::Integration integration = {};
  std::vector<BoundaryEntry> boundary = {};
  std::vector<structure::Probe> probes = {};  ///< in the order of the file
  std::optional<HistoryOutput> output = {};
  Loads loads = {};
  std::optional<FieldKey> initial_velocity = {};
  double mass_damping = 0.0;               ///< rate [1/time]
  std::vector<double> modal_damping = {};  ///< of critical damping (damping_keys.h); of a modal body alone
  std::optional<TimeSpan> time = {};
  std::optional<Analysis> analysis = {};   ///< absent: a motion in time
  std::optional<SavedState> state = {};    ///< what it starts from
  Settings settings = {};                  ///< of a motion that is saved
  std::vector<std::string> surfaces = {};  ///< names that its own key `surfaces` gives, beside those of files

  /// Those of `boundary` that have names.
  std::vector<structure::NamedSupport> named_supports() const { return io::named_supports(boundary); }

  /// Without control points once a solver was built.
  const nurbs::Volume& volume(int patch = 0) const {
    return std::get<nurbs::Volume>(geometry.patches[patch]);
  }
  int patch_count() const { return static_cast<int>(geometry.patches.size()); }
  void drop_control_points();
};

/// `file` is the name used in messages; `read` gives the geometry file that the text may name.  Throws
/// geometry_io::InputError "file:line: what was given, what was expected".
ModelFile parse_model_file(const std::string& text, const std::string& file,
                           const geometry_io::ReadFile& read = geometry_io::read_file);
/// Throws geometry_io::InputError also if the file cannot be read.
ModelFile read_model_file(const std::string& path,
                          const geometry_io::ReadFile& read = geometry_io::read_file);

/// Which part of a solid is wanted, of how many, and what ties them together.
struct Cut {
  int part = 0, parts = 1;
  std::function<std::unique_ptr<const structure::Halo>(structure::Part part)> halo = {};
  /// Called by all parts with what went wrong here, or nothing: throws on all if there is anything.
  std::function<void(const std::string& problem)> agree = {};
};

/// The solver in its initial state, loads applied, accelerations not yet worked out; of one part, if the
/// solid is cut (collective).  Takes the control points out of the model: a part keeps no more than its own.
/// Throws geometry_io::InputError if the geometry is left-handed or folded.
structure::ExplicitSolver build_solver(ModelFile& model, const Cut& cut = {});
inline structure::ExplicitSolver build_solver(ModelFile&& model, const Cut& cut = {}) {
  return build_solver(model, cut);
}

}  // namespace io
