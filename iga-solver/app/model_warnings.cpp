// SPDX-License-Identifier: GPL-2.0-or-later
// What looks like a slip in a model file.
#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "held_pieces.h"
#include "io/inner_faces.h"
#include "io/loose_patches.h"
#include "model_report.h"
#include "structure/material/viscous.h"

namespace app {

namespace {

using Warnings = std::vector<std::string>;

bool is_of(const io::ModelFile& model, std::size_t analysis) {
  return model.analysis && model.analysis->index() == analysis;
}
constexpr std::size_t kStatic = 0, kRelax = 1, kModes = 2;
static_assert(std::is_same_v<std::variant_alternative_t<kStatic, io::Analysis>, io::StaticAnalysis> &&
              std::is_same_v<std::variant_alternative_t<kRelax, io::Analysis>, io::RelaxAnalysis> &&
              std::is_same_v<std::variant_alternative_t<kModes, io::Analysis>, io::ModeAnalysis>);

/// Of an element's edges through its centre: the shortest, and how many times as long the longest is.
struct Shape {
  double shortest, ratio;
};

Shape shape_of(const nurbs::Volume& patch, int element, nurbs::RationalBasis<3>& basis) {
  const nurbs::Space<3>& space = patch.space;
  evaluate_on_element(space, element, space.element_centre(element), 1, basis);
  const nurbs::Indices<3> at = space.element_indices(element);
  double lengths[3];
  for (int d = 0; d < 3; ++d) {
    nurbs::Vector3 tangent = nurbs::Vector3::Zero();
    for (int a = 0; a < basis.count; ++a)
      tangent += basis.dR[d][a] * patch.control_points.col(basis.control_point[a]);
    const auto& breaks = space.knots(d).breaks();
    lengths[d] = tangent.norm() * (breaks[at[d] + 1] - breaks[at[d]]);
  }
  const auto [low, high] = std::minmax_element(lengths, lengths + 3);
  return {*low, *high / *low};
}

void warn_of_thin_elements(const io::ModelFile& model, Warnings& warnings) {
  constexpr double kThin = 20.0;
  nurbs::RationalBasis<3> basis;
  for (int p = 0; p < model.patch_count(); ++p) {
    const nurbs::Volume& patch = model.volume(p);
    Shape worst{0.0, 0.0};
    for (int e = 0; e < patch.space.element_count(); ++e)
      if (const Shape shape = shape_of(patch, e, basis); !(shape.ratio <= worst.ratio)) worst = shape;
    if (!(worst.ratio <= kThin))
      warnings.push_back(
          fmt::format("patch {} has elements {:.0f} times as long as they are thin ({:.3g}): the shortest "
                      "length sets the stable step; fewer elements there, or more in the other directions",
                      p, worst.ratio, worst.shortest));
  }
}

bool is_loaded(const io::Loads& loads) {
  return loads.gravity || loads.body_force || !loads.tractions.empty() || !loads.pressures.empty() ||
         !loads.lines.empty() || !loads.points.empty();
}

bool is_moved(const io::ModelFile& model) {
  return std::any_of(model.boundary.begin(), model.boundary.end(), [](const auto& e) { return e.moves; });
}

void warn_of_conditions(const io::ModelFile& model, Warnings& warnings) {
  const bool loaded = is_loaded(model.loads), moved = is_moved(model);
  if (!loaded && !moved && !is_of(model, kModes) &&
      (model.analysis || !(model.initial_velocity || model.state)))
    warnings.push_back(
        model.analysis ? "nothing deforms it: no 'loads' and no support that moves"
                       : "nothing moves it: no 'loads', 'initial' velocity, 'state' or support that moves");
  const FreeMotions free = is_of(model, kModes) ? FreeMotions() : free_motions(model);
  if (free.count > 0 && (model.analysis || loaded))
    warnings.push_back(
        fmt::format("'boundary' leaves {} free in {} of its 6 rigid motions: {}", free.whose, free.count,
                    model.analysis ? "there is no equilibrium to be found" : "loads carry it away"));
}

/// Keys that are read and do nothing.
void warn_of_unused(const io::ModelFile& model, Warnings& warnings) {
  const auto unused = [&](bool is_so, const char* key, const char* why) {
    if (is_so) warnings.push_back(fmt::format("'{}' is not used: {}", key, why));
  };
  if (!model.analysis) {
    unused(!model.output && !model.probes.empty(), "probes", "there is no 'output'");
    unused(!model.output && !model.named_supports().empty(), "name of boundary",
           "reactions are recorded by 'output'");
    return;
  }
  unused(is_of(model, kModes) && !model.probes.empty(), "probes", "modes have no displacement of their own");
  const char* const why = "an 'analysis' has no motion in time";
  unused(model.time.has_value() && !(is_of(model, kRelax) && model.time->step), "time", why);
  unused(model.initial_velocity.has_value(), "initial", why);
  unused(model.mass_damping > 0.0 && !is_of(model, kRelax), "damping.mass", why);
  unused(structure::viscosity(*model.materials.front()) > 0.0 && !is_of(model, kRelax), "damping.stiffness",
         why);
  unused(model.integration.mass == structure::TimeMass::corrected && !is_of(model, kRelax),
         "integration.mass", why);
  unused(is_of(model, kStatic) && model.state, "state", "'static' starts from the undeformed body");
  unused(is_of(model, kModes) && is_loaded(model.loads), "loads",
         "modes are about the undeformed body, or about 'state'");
}

void warn_of_output(const io::ModelFile& model, std::optional<double> end, Warnings& warnings) {
  if (!model.output || !end) return;
  const auto late = [&](double every, const char* key) {
    if (every > *end)
      warnings.push_back(fmt::format(
          "{} is {:.6g}, after the end {:.6g}: the state at time 0 alone is written", key, every, *end));
  };
  late(model.output->every, "output.every");
  if (model.output->fields && model.output->fields->every)
    late(*model.output->fields->every, "output.fields.every");
}

/// Where nobody pushes, and no particle gets to.
void warn_of_inner_faces(const io::ModelFile& model, Warnings& warnings) {
  const io::InnerFaces inner(model.geometry, model.nodes);
  const auto tell = [&](const std::string& what, const structure::SkinPiece& face) {
    if (const std::string told = inner.told(face); !told.empty())
      warnings.push_back(fmt::format("{} is on {}", what, told));
  };
  const auto tell_of_loads = [&](const char* key, const std::vector<io::FaceLoad>& loads) {
    for (std::size_t k = 0; k < loads.size(); ++k) tell(fmt::format("loads.{}[{}]", key, k), loads[k].piece);
  };
  tell_of_loads("tractions", model.loads.tractions);
  tell_of_loads("pressures", model.loads.pressures);
  for (std::size_t k = 0; k < model.boundary.size(); ++k)
    if (const io::Selection& where = model.boundary[k].where; model.boundary[k].is_symmetry)
      tell(fmt::format("boundary[{}].symmetry", k), {where.patches.front(), where.faces.front()});
  for (const std::string& name : model.surfaces)
    for (const geometry_io::SurfacePiece& piece : model.geometry.surfaces.at(name))
      tell(fmt::format("surface '{}'", geometry_io::shown(name)), {piece.patch, *piece.face});
}

}  // namespace

Warnings warnings_of_run(const io::ModelFile& model) {
  Warnings warnings;
  if (!model.modal_damping.empty())
    warnings.emplace_back("'damping.modal' is not used: it is of 'body modal N' in a deck");
  for (std::string& looseness : io::loose_patches(model)) warnings.push_back(std::move(looseness));
  warn_of_inner_faces(model, warnings);
  warn_of_unused(model, warnings);
  return warnings;
}

Warnings warnings_of(const io::ModelFile& model, std::optional<double> end) {
  Warnings warnings = warnings_of_run(model);
  warn_of_conditions(model, warnings);
  warn_of_thin_elements(model, warnings);
  warn_of_output(model, end, warnings);
  return warnings;
}

}  // namespace app
