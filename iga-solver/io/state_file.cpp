// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <variant>

#include "geometry_io/hdf5_file.h"
#include "geometry_io/regular_file.h"
#include "structure/material/viscous.h"

namespace io {

namespace {

using geometry_io::Hdf5Input;
using geometry_io::InputError;
using nurbs::nodal_vectors;
using nurbs::NodalVectors;

constexpr const char* kFormat = "iga-solver state";
constexpr int kVersion = 1;
constexpr const char* kExpected = "a state that 'save' of an analysis or a run has written";

void append(const NodalVectors& values, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), values.data(), values.data() + values.size());
}

NodalVectors read_vectors(const Hdf5Input& file, const std::string& path) {
  const geometry_io::Hdf5Value& values = file.numbers(path);
  if (values.shape.size() != 2 || values.shape[1] != 3)
    file.fail(path, fmt::format("has shape {}, expected [nodes][3]", geometry_io::shape_text(values.shape)));
  return nodal_vectors(values.numbers);
}

double read_number(const Hdf5Input& file, const std::string& path) {
  const geometry_io::Hdf5Value& value = file.numbers(path);
  if (value.numbers.size() != 1)
    file.fail(path, fmt::format("has shape {}, expected one number", geometry_io::shape_text(value.shape)));
  return value.numbers.front();
}

/// Whether a law remembers more than viscosity, which may be given and taken away.
bool has_own_memory(const structure::Body& body) {
  const std::vector<const structure::Material*> materials = body.materials();
  return std::any_of(materials.begin(), materials.end(), [](const structure::Material* material) {
    return material->state_size() > 0 && structure::viscosity(*material) == 0.0;
  });
}

template <int Dim>
void append(const nurbs::Space<Dim>& patch, std::vector<double>& numbers) {
  for (const nurbs::KnotVector& direction : patch.knots()) {
    const std::vector<double>& knots = direction.knots();
    numbers.push_back(direction.degree());
    for (const double knot : knots)
      numbers.push_back((knot - knots.front()) / (knots.back() - knots.front()));
  }
  std::vector<double> weights(patch.control_point_count());
  for (int A = 0; A < patch.control_point_count(); ++A) weights[A] = patch.weight(A);
  if (std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 1.0; }))
    numbers.insert(numbers.end(), weights.begin(), weights.end());
}

std::vector<double> splines_of(const structure::Body& body) {
  std::vector<double> numbers;
  const auto append_all = [&](const auto& patches) {
    for (const auto& patch : patches) append(patch, numbers);
  };
  std::visit(append_all, body.patches());
  return numbers;
}

bool agree(const std::vector<double>& some, const std::vector<double>& others) {
  constexpr double kSame = 1e-9;
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](double a, double b) { return std::abs(a - b) <= kSame * std::max(1.0, std::abs(b)); });
}

void take(const SavedState& state, double time, structure::ExplicitSolver& solver) {
  constexpr double kSame = 1e-9;  // of the size
  const NodalVectors reference = nodal_vectors(solver.in_order(solver.body().reference()));
  const std::size_t remembered = solver.memory_size();
  if (reference.cols() != state.reference.cols() ||
      (reference - state.reference).lpNorm<Eigen::Infinity>() > kSame * reference.lpNorm<Eigen::Infinity>())
    throw InputError(
        fmt::format("{}: is a state of {} control points, expected one of the same {} undeformed ones as in "
                    "the model: mesh and geometry are others",
                    state.file, state.reference.cols(), reference.cols()));
  if (!state.splines.empty() && !agree(state.splines, splines_of(solver.body())))
    throw InputError(
        fmt::format("{}: is a state of a mesh with the same control points, but degrees, knots or weights "
                    "are others than in the model: give the mesh of then",
                    state.file));
  std::vector<double> numbers{time};
  append(state.displacement, numbers);
  append(state.velocity, numbers);
  append(NodalVectors::Zero(3, reference.cols()), numbers);  // accelerations: found from the forces
  const std::string discretisation = solver.body().discretisation();
  const bool are_its_points = state.discretisation.empty() || state.discretisation == discretisation,
             is_kept = state.memory.size() == remembered && are_its_points;
  if (!are_its_points && has_own_memory(solver.body()))
    throw InputError(fmt::format(
        "{}: has the memory of the law '{}' at other points: {} then, {} now; give the quadrature of then",
        state.file, solver.body().materials().front()->law(), state.discretisation, discretisation));
  if (!is_kept && has_own_memory(solver.body()))
    throw InputError(
        fmt::format("{}: has a memory of {} numbers, expected {}: that of the law '{}'; give "
                    "the material of then, or a state that was found with this one",
                    state.file, state.memory.size(), remembered, solver.body().materials().front()->law()));
  if (is_kept) numbers.insert(numbers.end(), state.memory.begin(), state.memory.end());
  numbers.resize(1 + 9 * static_cast<std::size_t>(reference.cols()) + remembered, 0.0);
  if (state.moment)
    numbers.insert(numbers.end(), state.moment->momentum.begin(), state.moment->momentum.end());
  solver.load(numbers);
  if (!is_kept) solver.settle();
}

}  // namespace

void write_state(const std::string& path, geometry_io::Units units, const SavedState& state) {
  geometry_io::Hdf5Output file;
  file.set_text("/", "format", kFormat);
  file.set_integers("/", "version", {kVersion});
  file.set_text("/", "units", geometry_io::units_name(units));
  file.add_group("/state");
  const auto add = [&](const char* name, const NodalVectors& values) {
    file.add_numbers(std::string("/state/") + name, {static_cast<hsize_t>(values.cols()), 3}, values.data());
  };
  add("reference", state.reference);
  add("displacement", state.displacement);
  add("velocity", state.velocity);
  if (!state.memory.empty()) file.add_numbers("/state/memory", {state.memory.size()}, state.memory.data());
  if (state.moment) {
    file.add_numbers("/state/time", {1}, &state.moment->time);
    file.add_numbers("/state/time_step", {1}, &state.moment->step);
    file.add_numbers("/state/work", {state.moment->work.size()}, state.moment->work.data());
    if (!state.moment->momentum.empty()) add("momentum", nodal_vectors(state.moment->momentum));
  }
  if (!state.splines.empty())
    file.add_numbers("/state/splines", {state.splines.size()}, state.splines.data());
  if (!state.discretisation.empty()) file.set_text("/state", "discretisation", state.discretisation);
  if (!state.settings.empty()) file.add_texts("/state/settings", to_texts(state.settings));
  const std::string problem = geometry_io::write_file(path, [&](std::ostream& out) { out << file.bytes(); });
  if (!problem.empty()) throw std::runtime_error(fmt::format("{}: cannot write here: {}", path, problem));
}

SavedState read_state(const std::string& path, geometry_io::Units units, const geometry_io::ReadFile& read) {
  const Hdf5Input file(read(path), path);
  if (!file.has("/", "format"))
    file.fail("/", fmt::format("attribute 'format' is missing, as in the histories and frequencies that "
                               "'output' writes, expected {}",
                               kExpected));
  if (file.text("/", "format") != kFormat || !file.has("/state"))
    file.fail("/",
              fmt::format("format is '{}', expected '{}': {}", file.text("/", "format"), kFormat, kExpected));
  if (file.text("/", "units") != geometry_io::units_name(units))
    file.fail("/", fmt::format("units are {}, expected {} as in the model", file.text("/", "units"),
                               geometry_io::units_name(units)));
  SavedState state{path,
                   read_vectors(file, "/state/reference"),
                   read_vectors(file, "/state/displacement"),
                   read_vectors(file, "/state/velocity"),
                   {}};
  for (const NodalVectors* values : {&state.displacement, &state.velocity})
    if (values->cols() != state.reference.cols())
      file.fail("/state", fmt::format("has {} and {} nodes, expected the same number in all data sets",
                                      state.reference.cols(), values->cols()));
  if (file.has("/state/memory")) state.memory = file.numbers("/state/memory").numbers;
  if (file.has("/state/time"))
    state.moment = {read_number(file, "/state/time"),
                    read_number(file, "/state/time_step"),
                    file.numbers("/state/work").numbers,
                    {}};
  if (state.moment && file.has("/state/momentum")) {
    const NodalVectors momentum = read_vectors(file, "/state/momentum");
    if (momentum.cols() != state.reference.cols())
      file.fail("/state/momentum", fmt::format("has {} nodes, expected {} as the other data sets",
                                               momentum.cols(), state.reference.cols()));
    append(momentum, state.moment->momentum);
  }
  if (file.has("/state/splines")) state.splines = file.numbers("/state/splines").numbers;
  if (file.has("/state", "discretisation")) state.discretisation = file.text("/state", "discretisation");
  if (file.has("/state/settings")) state.settings = settings_from(file.texts("/state/settings"));
  return state;
}

SavedState read_state(const geometry_io::YamlMap& document, geometry_io::Units units,
                      const geometry_io::ReadFile& read) {
  const std::filesystem::path folder = std::filesystem::path(document.file()).parent_path();
  return read_state((folder / document.word("state")).string(), units, read);
}

void put_at_rest(structure::ExplicitSolver& solver, const NodalVectors& u, double time) {
  solver.set_motion(u, NodalVectors::Zero(3, u.cols()), time);
  solver.settle();
}

SavedState state_of(const structure::ExplicitSolver& solver) {
  SavedState state{"", nodal_vectors(solver.in_order(solver.body().reference())),
                   nodal_vectors(solver.in_order(solver.displacements())),
                   nodal_vectors(solver.in_order(solver.velocities())), solver.memory_in_order()};
  state.discretisation = solver.body().discretisation();
  state.splines = splines_of(solver.body());
  return state;
}

SavedState moment_of(const structure::ExplicitSolver& solver) {
  SavedState state = state_of(solver);
  state.moment = {solver.time(), solver.time_step(), solver.save_work_done(), solver.momenta_in_order()};
  return state;
}

void start_from(const SavedState& state, structure::ExplicitSolver& solver) { take(state, 0.0, solver); }

void continue_from(const SavedState& state, structure::ExplicitSolver& solver) {
  if (!state.moment)
    throw InputError(fmt::format(
        "{0}: is what an analysis has found, expected the state of a motion that 'time: {{save: FILE}}' has "
        "written; a motion that starts from it has 'state: {0}'",
        state.file));
  take(state, state.moment->time, solver);
}

}  // namespace io
