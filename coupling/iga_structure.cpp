// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/iga_structure.h"

#include <fmt/format.h>

#include <stdexcept>

#include "structure/stable_time_step.h"

namespace coupling {

namespace {

ContactSurface surface_of(const nurbs::Space<3>& volume, nurbs::Face face) {
  nurbs::BoundarySurface boundary = nurbs::boundary_surface(volume, face);
  return {std::move(boundary.space),
          SurfaceMap::selection(boundary.volume_control_point, volume.control_point_count()),
          boundary.outward_sign};
}

}  // namespace

IgaStructure::IgaStructure(structure::ExplicitSolver solver, nurbs::Face face,
                           std::vector<structure::Probe> probes)
    : solver_(std::move(solver)),
      surface_(surface_of(solver_.solid().patch().space, face)),
      probes_(std::move(probes)) {}

void IgaStructure::set_time_step(double dt) {
  const double stable = solver_.stable_time_step();
  if (dt > structure::kStableStepSafety * stable)
    throw std::invalid_argument(fmt::format(
        "timestep {:.6g} is above {} of the structure's stable step {:.6g}; use a timestep of at most {:.3g}",
        dt, structure::kStableStepSafety, stable, 0.9 * stable));
  solver_.set_time_step(dt);
}

std::optional<SurfaceMaterial> IgaStructure::material() const {
  const structure::Material& material = solver_.solid().material();
  return SurfaceMaterial{material.youngs_modulus(), material.poissons_ratio()};
}

std::vector<Probe> IgaStructure::probes() const {
  std::vector<Probe> values;
  for (const structure::Probe& probe : probes_)
    values.push_back({probe.name, solver_.displacement(probe.xi)});
  return values;
}

}  // namespace coupling
