// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/model_file.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "geometry_io/file_kind.h"
#include "io/damping_keys.h"
#include "io/integration_keys.h"
#include "io/material_keys.h"
#include "nurbs/memory.h"
#include "structure/weld.h"

namespace io {

using geometry_io::YamlMap;

namespace {

structure::Probe read_probe(const YamlMap& probes, const std::string& name, const ModelFile& model) {
  expect_series_name(probes, name, name);
  const YamlMap map = probes.map(name);
  map.allow_only({"face", "patch", "at"});
  const int patch = read_patch(map, model.geometry);
  const nurbs::Space<3>& space = model.volume(patch).space;
  const nurbs::Face face = read_face(map, "face");
  const std::vector<double> at = map.numbers("at");
  if (at.size() != 2) map.fail("at", fmt::format("at has {} numbers, expected 2 from 0 to 1", at.size()));
  try {
    structure::Probe probe =
        structure::probe_at(name, space, structure::face_point(space, face, {at[0], at[1]}));
    for (int& node : probe.nodes) node = static_cast<int>(model.nodes.node(patch, node));
    return probe;
  } catch (const std::invalid_argument&) {
    map.fail("at", fmt::format("at is [{}, {}], expected 2 numbers from 0 to 1", at[0], at[1]));
  }
}

bool wants_welds(const YamlMap& document) {
  return !document.has("weld") || document.word_of("weld", {"yes", "no"}) == "yes";
}

/// Volumes alone, and what of them is welded.
structure::NodeNumbering read_welds(const YamlMap& document, const geometry_io::GeometryFile& geometry) {
  std::vector<nurbs::Volume> volumes;
  for (const geometry_io::Shape& patch : geometry.patches) {
    if (!std::holds_alternative<nurbs::Volume>(patch))
      document.fail("geometry",
                    "geometry is a surface, expected a volume: a solid with a material needs one");
    volumes.push_back(std::get<nurbs::Volume>(patch));
  }
  if (!wants_welds(document)) return structure::without_welds(volumes);
  try {
    return structure::weld(volumes);
  } catch (const std::invalid_argument& error) {
    document.fail("geometry", fmt::format("geometry: {}; or 'weld: no'", error.what()));
  }
}

bool is_saved(const YamlMap& document) {
  return document.has("time") && document.is_map("time") && document.map("time").has("save");
}

ModelFile read_required(const YamlMap& document, const geometry_io::ReadFile& read) {
  geometry_io::GeometryFile geometry =
      geometry_io::read_geometry(document, geometry_io::geometry_opener(read));
  structure::NodeNumbering nodes = read_welds(document, geometry);
  const int patches = static_cast<int>(geometry.patches.size());
  return {document.file(),  document.line_of("geometry"),      std::move(geometry),
          std::move(nodes), read_materials(document, patches), wants_welds(document)};
}

}  // namespace

ModelFile parse_model_file(const std::string& text, const std::string& file,
                           const geometry_io::ReadFile& read) {
  std::vector<std::string> inputs{file};
  const auto read_and_note = [&](const std::string& path) {
    inputs.push_back(path);
    return read(path);
  };
  const YamlMap document = YamlMap::parse(text, file);
  document.allow_only({"units", "geometry", "material", "boundary", "surfaces", "probes", "output", "loads",
                       "initial", "time", "integration", "damping", "weld", "analysis", "state"});
  ModelFile model = read_required(document, read_and_note);
  if (is_saved(document)) model.settings = settings_of(document, model.materials);
  if (document.has("surfaces")) model.surfaces = document.map("surfaces").keys();
  if (document.has("boundary"))
    model.boundary = read_boundary(document.list_of_maps("boundary"), model.geometry, model.nodes);
  if (document.has("integration")) {
    const YamlMap integration = document.map("integration", "{quadrature: full}");
    model.integration = read_integration(integration);
    correct_shear(integration, model.geometry, model.nodes, model.boundary, model.materials);
  }
  if (document.has("probes")) {
    const YamlMap probes = document.map("probes", "{NAME: {face: zeta+, at: [0.5, 0.5]}}");
    for (const std::string& name : probes.keys()) model.probes.push_back(read_probe(probes, name, model));
  }
  // Before what names files to be written, none of which may be this one.
  if (document.has("state")) model.state = read_state(document, model.geometry.units, read_and_note);
  if (document.has("output"))
    model.output = read_output(document.map("output", "{every: 1e-5, file: NAME}"), model.geometry, inputs,
                               document.has("analysis"));
  if (document.has("loads"))
    model.loads = read_loads(document.map("loads", "{gravity: [0, 0, -9.81]}"), model.geometry, model.nodes);
  if (document.has("initial"))
    model.initial_velocity = read_initial_velocity(document.map("initial", "{velocity: [0, 0, 0]}"));
  if (document.has("damping")) {
    const DampingKeys damping = read_damping(document.map("damping"), model.geometry);
    model.mass_damping = damping.mass;
    model.modal_damping = damping.modal;
    if (damping.stiffness > 0.0) add_viscosity(damping.stiffness, model.materials);
  }
  if (document.has("time"))
    model.time = read_time_span(document.map("time", "{end: 1e-3}"), inputs, model.output);
  if (document.has("analysis")) model.analysis = read_analysis(document, inputs, model.output);
  return model;
}

void ModelFile::drop_control_points() {
  for (geometry_io::Shape& patch : geometry.patches) std::get<nurbs::Volume>(patch).control_points = {};
}

ModelFile read_model_file(const std::string& path, const geometry_io::ReadFile& read) {
  if (geometry_io::format_of_path(path) == geometry_io::format::cad)
    throw geometry_io::InputError(
        path +
        ": is a STEP or IGES file, expected a model file (YAML): CAD has the faces of "
        "a body, not the body; rigid walls take them by 'geometry'");
  const std::string text = read(path);
  if (geometry_io::format_of_path(path) == geometry_io::format::hdf5)  // what was read are its values
    geometry_io::refuse_kind(geometry_io::FileKind::hdf5, path);
  return parse_model_file(text, path, read);
}

namespace {

std::unique_ptr<structure::Solid> build_solid(const ModelFile& model, const structure::Part& part) {
  std::vector<structure::MaterialPatch> patches;
  for (int p = 0; p < model.patch_count(); ++p) patches.push_back({model.volume(p), model.materials[p]});
  try {
    return std::make_unique<structure::Solid>(patches, model.nodes, model.integration, part);
  } catch (const std::invalid_argument& error) {
    throw geometry_io::InputError(
        fmt::format("{}:{}: geometry: {}", model.file, model.geometry_line, error.what()));
  }
}

structure::Part cut_out(const ModelFile& model, int part, int parts) {
  std::vector<structure::PatchBoxes> boxes;
  for (int p = 0; p < model.patch_count(); ++p)
    boxes.emplace_back(model.volume(p).space, structure::box_cuts(model.volume(p).space));
  return structure::Partition(std::move(boxes), model.nodes, parts).part(part);
}

struct OwnPart {
  structure::Part part;
  std::unique_ptr<structure::Solid> solid;
  structure::Supports supports;
};

/// Takes the memory that a solver will need, for a moment: where it ends, it does so here.
void expect_room_for_solver(const structure::Part& part) {
  constexpr std::size_t kBytesPerColumn = 300;
  ::operator delete(::operator new(kBytesPerColumn* part.columns));
}

/// What fails on one rank fails on all: nothing here waits for another.
OwnPart build_part(const ModelFile& model, const Cut& cut) {
  OwnPart own;
  std::string problem;
  try {
    own.part = cut_out(model, cut.part, cut.parts);
    own.solid = build_solid(model, own.part);
    own.supports = supports_of(model.boundary).on(own.part.nodes);
    expect_room_for_solver(own.part);
  } catch (const std::bad_alloc&) {
    problem = nurbs::out_of_memory(model.file);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  cut.agree(problem);
  return own;
}

structure::ExplicitSolver build_solver_at_rest(const ModelFile& model, const Cut& cut) {
  if (cut.parts > 1) {
    OwnPart own = build_part(model, cut);
    return {std::move(own.solid), std::move(own.supports), cut.halo(std::move(own.part))};
  }
  structure::Part all = cut_out(model, 0, 1);
  return {build_solid(model, all), supports_of(model.boundary),
          std::make_unique<const structure::Halo>(std::move(all.runs))};
}

}  // namespace

structure::ExplicitSolver build_solver(ModelFile& model, const Cut& cut) {
  structure::ExplicitSolver solver = build_solver_at_rest(model, cut);
  solver.set_springs(springs_of(model.boundary, model.geometry, model.nodes, solver.node_ids()));
  solver.set_mass_damping(model.mass_damping);
  apply_loads(model.loads, model.geometry, model.nodes, solver);
  if (model.state) start_from(*model.state, solver);
  if (model.initial_velocity) solver.set_velocities(velocities_of(*model.initial_velocity, solver));
  if (!model.named_supports().empty()) solver.keep_reactions();
  model.drop_control_points();
  return solver;
}

}  // namespace io
