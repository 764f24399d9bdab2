// SPDX-License-Identifier: GPL-2.0-or-later
// An elastic block from outside, from a model file's text: one step under a force.  Exit code 0 if it moves.
#include "coupling/iga_structure.h"
#include "io/model_file.h"

int main() {
  io::ModelFile model = io::parse_model_file(R"(
units: si
geometry: {box: {origin: [0, 0, 0], size: [1, 1, 1], elements: [2, 2, 2], degree: 2}}
material: {law: linear_elastic, youngs_modulus: 1, poissons_ratio: 0.3, density: 1}
surfaces: {top: zeta+}
)",
                                             "block.yaml");
  coupling::IgaStructure block(io::build_solver(model), {{0, nurbs::Face::zeta_plus}});
  block.set_time_step(0.1);
  const coupling::NodalForces forces(coupling::NodalVectors::Constant(3, block.positions().cols(), 1.0));
  block.initialise_forces(forces);
  block.begin_step();
  block.end_step(forces);
  return block.linear_momentum().minCoeff() > 0.0 ? 0 : 1;
}
