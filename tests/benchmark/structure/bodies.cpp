// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies.h"

#include <cmath>
#include <stdexcept>

#include "structure/material/laws.h"
#include "volumes.h"

namespace benchmarks {

using structure::IntegrationMethod;
using structure::Quadrature;

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = {
      {"plain", {Quadrature::full, IntegrationMethod::elements}},
      {"auto", {}},
      {"stored", {Quadrature::full, IntegrationMethod::stored}},
      {"recomputed", {Quadrature::full, IntegrationMethod::recomputed}},
      {"auto_reduced", {Quadrature::reduced, IntegrationMethod::automatic}},
      {"auto_zou", {Quadrature::zou, IntegrationMethod::automatic}},
  };
  return kMethods;
}

const Method& method_named(const std::string& name) {
  for (const Method& method : methods())
    if (method.name == name) return method;
  throw std::invalid_argument("no method \"" + name + "\"");
}

namespace {

std::shared_ptr<const structure::Material> make_law(const std::string& word) {
  for (const structure::MaterialLaw& law : structure::material_laws())
    if (law.word == word) return law.make({kYoung, kPoisson, kDensity});
  throw std::invalid_argument("no law \"" + word + "\"");
}

}  // namespace

std::unique_ptr<structure::Solid> make_solid(const Method& method, const nurbs::Volume& volume,
                                             const std::string& law) {
  return std::make_unique<structure::Solid>(volume, make_law(law), method.integration);
}

std::unique_ptr<structure::ExplicitSolver> ringing(std::unique_ptr<structure::Body> body, int layers) {
  const int nodes = body->node_count();
  auto solver = std::make_unique<structure::ExplicitSolver>(std::move(body), structure::Supports());
  const double sound = std::sqrt((kLambda + 2.0 * kMu) / kDensity);
  solver->set_time_step(0.3 * kThickness / layers / sound);
  solver->set_velocities(random_displacements(nodes, 1e-3));
  solver->initialise_forces(nurbs::NodalVectors::Zero(3, nodes));
  return solver;
}

}  // namespace benchmarks
