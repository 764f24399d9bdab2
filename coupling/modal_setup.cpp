// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/modal_setup.h"

#include <fmt/format.h>

#include <utility>

#include "geometry_io/input_error.h"
#include "parallel/all_or_none.h"
#include "parallel/session.h"
#include "structure/material/viscous.h"

namespace coupling {

namespace {

using structure::ModalBasis;

void refuse(const io::ModelFile& model, const std::string& what, const std::string& expected) {
  throw geometry_io::InputError(
      fmt::format("{}: body modal: {}, expected {}: modes are those of a linear solid of lumped mass",
                  model.file, what, expected));
}

void broadcast(MPI_Comm comm, std::vector<double>& numbers) {
  long count = static_cast<long>(numbers.size());
  MPI_Bcast(&count, 1, MPI_LONG, 0, comm);
  numbers.resize(count);
  constexpr long kMost = 1 << 28;  // MPI counts in int
  for (long first = 0; first < count; first += kMost)
    MPI_Bcast(numbers.data() + first, static_cast<int>(std::min(kMost, count - first)), MPI_DOUBLE, 0, comm);
}

/// Of this rank's part, from rank 0's of the whole.
std::vector<NodalVectors> shared(MPI_Comm comm, const structure::ExplicitSolver& solver,
                                 const std::vector<NodalVectors>& whole, Eigen::Index count) {
  std::vector<NodalVectors> shapes;
  for (Eigen::Index k = 0; k < count; ++k) {
    std::vector<double> rows;
    if (!whole.empty()) rows.assign(whole[k].data(), whole[k].data() + whole[k].size());
    broadcast(comm, rows);
    shapes.push_back(NodalVectors::Zero(3, solver.body().node_count()));
    solver.from_order(rows.data(), shapes.back());
  }
  return shapes;
}

ModalBasis basis_of_part(MPI_Comm comm, const structure::ExplicitSolver& solver,
                         std::optional<io::ModelFile> whole, int modes) {
  ModalBasis all;
  parallel::on_first_rank(comm, [&] { all = structure::modal_basis(io::build_solver(*whole), modes); });
  std::vector<double> eigenvalues(all.eigenvalues.begin(), all.eigenvalues.end());
  broadcast(comm, eigenvalues);
  const auto motions = static_cast<Eigen::Index>(solver.supports().motions().size());
  return {Eigen::VectorXd::Map(eigenvalues.data(), modes), shared(comm, solver, all.modes, modes),
          shared(comm, solver, all.follow, motions)};
}

}  // namespace

ModalDamping take_damping(io::ModelFile& model) {
  ModalDamping damping{model.modal_damping, model.mass_damping, 0.0};
  for (std::shared_ptr<const structure::Material>& material : model.materials) {
    if (const auto* viscous = dynamic_cast<const structure::Viscous*>(material.get())) {
      damping.stiffness = viscous->viscosity();
      material = std::shared_ptr<const structure::Material>(viscous->elastic());
    }
    if (!material->is_linear()) refuse(model, fmt::format("law is '{}'", material->law()), "linear_elastic");
  }
  if (damping.stiffness > 0.0 && model.state) model.state->memory.clear();  // what viscosity remembers
  if (model.integration.mass == structure::TimeMass::corrected)
    refuse(model, "integration.mass is 'corrected'", "lumped");
  if (!model.loads.pressures.empty()) refuse(model, "loads.pressures follow the motion", "loads.tractions");
  return damping;
}

std::unique_ptr<StructureSolver> make_modal(MPI_Comm comm, std::unique_ptr<IgaStructure> body,
                                            std::optional<io::ModelFile> whole, int modes,
                                            const ModalDamping& damping) {
  const ModalBasis basis = body->is_in_parts() ? basis_of_part(comm, body->solver(), std::move(whole), modes)
                                               : structure::modal_basis(body->solver(), modes);
  return std::make_unique<ModalStructure>(std::move(body), basis, damping);
}

}  // namespace coupling
