// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry_io/geometry_file.h"
#include "solve_options.h"

namespace app {

using structure::ExplicitSolver;

void print_model(const io::ModelFile& model, const ExplicitSolver& solver) {
  const structure::Halo& halo = solver.halo();
  const Eigen::Index owned = halo.owned(solver.body().node_count());
  const std::vector<Eigen::Index>& fixed = solver.supports().fixed_dofs();
  const double fixed_dofs = halo.sum(double(std::count_if(
                   fixed.begin(), fixed.end(), [&](Eigen::Index dof) { return dof < 3 * owned; }))),
               mass = halo.sum(solver.mass().nodal_mass().head(owned).sum());

  print_on_first("{} (units {})\n", model.file, geometry_io::units_name(model.geometry.units));
  for (int p = 0; p < model.patch_count(); ++p) {
    const nurbs::Space<3>& space = model.volume(p).space;
    print_on_first("  elements     {} ({} x {} x {}), degrees {} {} {}{}\n", space.element_count(),
                   space.knots(0).element_count(), space.knots(1).element_count(),
                   space.knots(2).element_count(), space.degree(0), space.degree(1), space.degree(2),
                   model.patch_count() > 1 ? fmt::format(" of patch {}", p) : "");
  }
  if (model.patch_count() > 1)
    print_on_first("  welds        {} nodes of several patches\n", model.nodes.welded().size());
  print_on_first("  dof          {}, {} of them fixed\n", 3L * model.nodes.node_count(),
                 static_cast<long>(fixed_dofs));
  print_on_first("  mass         {:.8g}{}\n", mass, solver.body().corrects_mass() ? ", corrected" : "");
}

namespace {

void print_materials(const io::ModelFile& model) {
  for (int p = 0; p < model.patch_count(); ++p) {
    const structure::Material& material = *model.materials[p];
    if (p > 0 && model.materials[p] == model.materials[p - 1]) continue;
    print_on_first("  material     {}, E {:.6g}, nu {:.6g}, density {:.6g}{}\n", material.law(),
                   material.youngs_modulus(), material.poissons_ratio(), material.density(),
                   p > 0 ? fmt::format(", from patch {}", p) : "");
  }
}

void print_conditions(const io::ModelFile& model) {
  for (const io::BoundaryEntry& entry : model.boundary)
    print_on_first("  support      {}{} at {} nodes\n", entry.name.empty() ? "" : entry.name + ": ",
                   entry.spring  ? "springs"
                   : entry.moves ? "moved"
                                 : "fixed",
                   entry.nodes.size());
  const io::Loads& loads = model.loads;
  print_on_first("  loads        {} tractions, {} pressures, {} along edges, {} at points{}{}\n",
                 loads.tractions.size(), loads.pressures.size(), loads.lines.size(), loads.points.size(),
                 loads.body_force ? ", a body force" : "", loads.gravity ? ", gravity" : "");
}

}  // namespace

void print_details(const io::ModelFile& model) {
  print_materials(model);
  print_conditions(model);
}

void print_warning(const io::ModelFile& model, ExplicitSolver& solver) {
  const std::string warning = solver.take_warning();
  if (!warning.empty() && is_first_rank()) fmt::print(stderr, "WARNING: {}: {}\n", model.file, warning);
}

void print_energies(const ExplicitSolver& solver) {
  const structure::Work ledger = solver.work();
  const double kinetic = solver.kinetic_energy(), strain = solver.strain_energy(), work = solver.load_work(),
               supports = ledger.supports, damped = ledger.damped;
  const auto column = [](const char* name, double energy) {
    return energy == 0.0 ? "" : fmt::format(", {} {:.8g}", name, energy);
  };
  print_on_first(
      "  energies at time {:.6g}: kinetic {:.8g}, strain {:.8g}, work of the loads {:.8g}{}{}, balance "
      "{:.8g}\n",
      solver.time(), kinetic, strain, work, column("of the supports", supports), column("damped", damped),
      kinetic + strain + damped - work - supports);
}

}  // namespace app
