// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/model_file.h"

#include <fmt/format.h>

#include <new>

#include "geometry_io/file_kind.h"
#include "nurbs/memory.h"
#include "structure/material/laws.h"
#include "structure/material/viscous.h"

namespace io {

using geometry_io::YamlMap;

namespace {

std::shared_ptr<const structure::Material> read_constants(const YamlMap& map,
                                                          const structure::MaterialLaw& law) {
  std::vector<std::string> keys = {"law"};
  for (const structure::MaterialConstant& constant : law.constants) keys.emplace_back(constant.key);
  for (const structure::MaterialDirection& direction : law.directions) keys.emplace_back(direction.key);
  map.allow_only(keys);
  std::vector<double> values;
  for (const structure::MaterialConstant& constant : law.constants)
    values.push_back(map.number(constant.key, {constant.low, constant.high}));
  for (const structure::MaterialDirection& direction : law.directions) {
    const Vector3 v = map.has(direction.key) ? map.vector3(direction.key) : direction.otherwise;
    values.insert(values.end(), v.begin(), v.end());
  }
  try {
    return law.make(values);
  } catch (const std::invalid_argument& error) {
    map.fail("law", error.what());
  }
}

std::shared_ptr<const structure::Material> read_material(const YamlMap& map) {
  const std::string name = map.word("law");
  std::vector<std::string> known;
  for (const structure::MaterialLaw& law : structure::material_laws()) {
    if (name == law.word) return read_constants(map, law);
    known.emplace_back(law.word);
  }
  map.fail("law", fmt::format("law is '{}', expected one of: {}", name, fmt::join(known, ", ")));
}

structure::Probe read_probe(const YamlMap& probes, const std::string& name, const nurbs::Space<3>& space) {
  const YamlMap map = probes.map(name);
  map.allow_only({"face", "at"});
  const nurbs::Face face = read_face(map, "face");
  const std::vector<double> at = map.numbers("at");
  if (at.size() != 2) map.fail("at", fmt::format("at has {} numbers, expected 2 from 0 to 1", at.size()));
  try {
    return structure::probe_at(name, space, structure::face_point(space, face, {at[0], at[1]}));
  } catch (const std::invalid_argument&) {
    map.fail("at", fmt::format("at is [{}, {}], expected 2 numbers from 0 to 1", at[0], at[1]));
  }
}

TimeSpan read_time(const YamlMap& map) {
  map.allow_only({"end", "step"});
  TimeSpan time{map.number("end", geometry_io::positive()), {}};
  if (map.has("step")) time.step = map.number("step", geometry_io::positive());
  return time;
}

/// A word, by the reader that knows all of them.
template <class Value>
Value read_word(const YamlMap& map, const std::string& key, Value (*from_name)(const std::string&)) {
  try {
    return from_name(map.word(key));
  } catch (const std::invalid_argument& error) {
    map.fail(key, error.what());
  }
}

structure::Integration read_integration(const YamlMap& map) {
  map.allow_only({"quadrature", "method"});
  structure::Integration integration;
  if (map.has("quadrature"))
    integration.quadrature = read_word(map, "quadrature", structure::quadrature_from_name);
  if (map.has("method"))
    integration.method = read_word(map, "method", structure::integration_method_from_name);
  return integration;
}

ModelFile read_required(const YamlMap& document, const geometry_io::ReadFile& read) {
  ModelFile model{document.file(), document.line_of("geometry"),
                  geometry_io::read_geometry(document, geometry_io::geometry_opener(read)),
                  read_material(document.map("material"))};
  const std::vector<geometry_io::Shape>& patches = model.geometry.patches;
  if (patches.size() != 1)
    document.fail("geometry",
                  fmt::format("geometry has {} patches, expected one for a solid", patches.size()));
  if (!std::holds_alternative<nurbs::Volume>(patches.front()))
    document.fail("geometry", "geometry is a surface, expected a volume: a solid with a material needs one");
  return model;
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
                       "initial", "time", "integration", "damping"});
  ModelFile model = read_required(document, read_and_note);
  if (document.has("integration")) model.integration = read_integration(document.map("integration"));
  if (document.has("boundary"))
    model.boundary = read_boundary(document.list_of_maps("boundary"), model.geometry);
  if (document.has("probes")) {
    const YamlMap probes = document.map("probes");
    for (const std::string& name : probes.keys())
      model.probes.push_back(read_probe(probes, name, model.volume().space));
  }
  if (document.has("output")) model.output = read_output(document.map("output"), model.geometry, inputs);
  if (document.has("loads")) model.loads = read_loads(document.map("loads"), model.geometry);
  if (document.has("initial")) model.initial_velocity = read_initial_velocity(document.map("initial"));
  if (document.has("damping")) {
    const YamlMap damping = document.map("damping");
    damping.allow_only({"mass", "stiffness"});
    if (damping.has("mass")) model.mass_damping = damping.number("mass", geometry_io::non_negative());
    if (damping.has("stiffness"))
      model.material = std::make_shared<structure::Viscous>(
          model.material, damping.number("stiffness", geometry_io::positive()));
  }
  if (document.has("time")) model.time = read_time(document.map("time"));
  return model;
}

ModelFile read_model_file(const std::string& path, const geometry_io::ReadFile& read) {
  const std::string text = read(path);
  if (geometry_io::format_of_path(path) == geometry_io::format::hdf5)  // what was read are its values
    geometry_io::refuse_kind(geometry_io::FileKind::hdf5, path);
  return parse_model_file(text, path, read);
}

namespace {

std::unique_ptr<structure::Solid> build_solid(const ModelFile& model, const structure::Part* part) {
  try {
    if (part)
      return std::make_unique<structure::Solid>(model.volume(), model.material, model.integration, *part);
    return std::make_unique<structure::Solid>(model.volume(), model.material, model.integration);
  } catch (const std::invalid_argument& error) {
    throw geometry_io::InputError(
        fmt::format("{}:{}: geometry: {}", model.file, model.geometry_line, error.what()));
  }
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
  const nurbs::Space<3>& space = model.volume().space;
  OwnPart own;
  std::string problem;
  try {
    own.part = structure::Partition(space, structure::box_cuts(space), cut.parts).part(cut.part);
    own.solid = build_solid(model, &own.part);
    own.supports = supports_of(model.boundary, model.geometry).on(own.part.nodes);
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
  const nurbs::Space<3>& space = model.volume().space;
  std::vector<Eigen::Index> runs = structure::Partition(space, structure::box_cuts(space), 1).part(0).runs;
  return {build_solid(model, nullptr), supports_of(model.boundary, model.geometry),
          std::make_unique<const structure::Halo>(std::move(runs))};
}

}  // namespace

structure::ExplicitSolver build_solver(const ModelFile& model, const Cut& cut) {
  structure::ExplicitSolver solver = build_solver_at_rest(model, cut);
  solver.set_springs(springs_of(model.boundary, model.geometry, solver.body(), solver.node_ids()));
  solver.set_mass_damping(model.mass_damping);
  apply_loads(model.loads, model.geometry, solver);
  if (model.initial_velocity) solver.set_velocities(velocities_of(*model.initial_velocity, solver));
  if (!model.named_supports().empty()) solver.keep_reactions();
  return solver;
}

}  // namespace io
