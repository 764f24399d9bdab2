// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "coupling/modal_setup.h"
#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "io/inner_faces.h"
#include "io/loose_patches.h"
#include "io/model_file.h"
#include "parallel/all_or_none.h"
#include "parallel/session.h"
#include "structure/compliance/flat_elements.h"

namespace coupling {

namespace {

/// If it is known, so that a deck's need not be missed.
std::optional<Vector3> gravity_of(const io::ModelFile& model) {
  if (!model.loads.gravity || model.loads.gravity->of_the_deck) return std::nullopt;
  return model.loads.gravity->value;
}

void expect_skin(const io::ModelFile& model, const std::vector<structure::SkinPiece>& skin,
                 const std::string& surface) {
  const io::InnerFaces inner(model.geometry, model.nodes);
  for (const structure::SkinPiece& piece : skin)
    if (const std::string told = inner.told(piece); !told.empty())
      throw geometry_io::InputError(
          fmt::format("{}: surface '{}' is on {}, expected faces that particles can "
                      "reach",
                      model.file, surface, told));
}

std::optional<ModalDamping> expect_no_modal_damping(const io::ModelFile& model) {
  if (model.modal_damping.empty()) return std::nullopt;
  throw geometry_io::InputError(
      fmt::format("{}: damping.modal is of modes, expected 'body modal N' after the file, or damping by mass "
                  "or stiffness",
                  model.file));
}

/// Copies the patches, which the solver takes out of the model.  Throws std::invalid_argument where it is not
/// known; `everywhere`: on any element of the skin, in place of those that are hit.
std::unique_ptr<MeshCompliance> compliance_of(const io::ModelFile& model,
                                              const std::vector<structure::SkinPiece>& skin,
                                              bool everywhere) {
  std::vector<nurbs::Volume> patches;
  for (int p = 0; p < model.patch_count(); ++p) patches.push_back(model.volume(p));
  structure::ReferenceBody body{std::move(patches), model.materials, model.nodes,
                                model.integration.quadrature};
  auto compliance = std::make_unique<MeshCompliance>(body, skin);
  if (everywhere) structure::expect_no_flat_elements(body, skin);
  return compliance;
}

OpenedStructure read_iga_structure(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const SolidOptions& options) {
  io::ModelFile model = io::read_model_file(path, reader_on_all_ranks(comm));
  if (!options.state.empty()) {
    model.state = io::read_state(options.state, model.geometry.units, reader_on_all_ranks(comm));
    if (model.output) model.output->inputs.push_back(options.state);
  }
  geometry_io::named_surface(model.geometry, surface, path);  // complains about a name that is not there
  std::vector<structure::SkinPiece> skin;
  for (const geometry_io::SurfacePiece& piece : model.geometry.surfaces.at(surface))
    skin.push_back({piece.patch, *piece.face});
  expect_skin(model, skin, surface);
  std::vector<std::string> warnings = io::loose_patches(model);
  const std::optional<ModalDamping> damping =
      options.modes ? std::optional(take_damping(model)) : expect_no_modal_damping(model);
  std::optional<parallel::SharedFields> fields;
  if (model.output && model.output->fields) fields.emplace(comm, model);
  const io::Cut cut = parallel::cut_among(comm);
  std::optional<io::ModelFile> whole;
  if (damping && cut.parts > 1 && cut.part == 0) whole = model;
  std::unique_ptr<MeshCompliance> compliance;
  std::string uncorrected;
  try {
    if (options.corrects_contacts.value_or(!damping))
      compliance = compliance_of(model, skin, !options.corrects_contacts);
  } catch (const std::invalid_argument& problem) {
    if (options.corrects_contacts)
      throw geometry_io::InputError(
          fmt::format("{}: {}; expected such a solid, or 'compliance none'", model.file, problem.what()));
    uncorrected = problem.what();
  }
  structure::ExplicitSolver body = io::build_solver(model, cut);
  if (!damping) body.stable_time_step();  // kept; the most memory of a run, so before there is anything else
  auto solver = std::make_unique<IgaStructure>(std::move(body), std::move(skin), model.probes,
                                               gravity_of(model), cut.parts > 1);
  solver->correct_contacts(std::move(compliance));
  if (model.loads.gravity && model.loads.gravity->of_the_deck) solver->take_gravity_of_deck();
  solver->watch(model.named_supports());
  if (model.output)
    solver->write_history(parallel::SharedHistory(comm, *model.output, model.geometry.units, model.probes,
                                                  model.named_supports()));
  if (fields) solver->write_fields(std::move(*fields));
  if (!damping) return {std::move(solver), model.geometry.units, std::move(warnings), std::move(uncorrected)};
  return {make_modal(comm, std::move(solver), std::move(whole), *options.modes, *damping),
          model.geometry.units, std::move(warnings)};
}

}  // namespace

OpenedStructure open_iga_structure(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const SolidOptions& options) {
  return parallel::on_every_rank(comm, path,
                                 [&] { return read_iga_structure(comm, path, surface, options); });
}

}  // namespace coupling
