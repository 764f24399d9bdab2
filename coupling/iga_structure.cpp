// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/iga_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/time/stable_time_step.h"

namespace coupling {

namespace {

// Nodes along one side of a face.
std::vector<int> side_nodes(const nurbs::BoundarySurface& face, int side) {
  std::vector<int> nodes = nurbs::side_control_points(face.space, side);
  for (int& node : nodes) node = face.volume_control_point[node];
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

ContactSurface surface_of(const structure::ExplicitSolver& solver,
                          const std::vector<structure::SkinPiece>& skin) {
  std::vector<nurbs::BoundarySurface> faces;
  std::vector<nurbs::Surface> patches;
  std::vector<NodeId> nodes;
  std::vector<int> outward_sign;
  for (const structure::SkinPiece& piece : skin) {
    const nurbs::BoundarySurface face = solver.body().skin(piece);
    const std::vector<structure::Id> ids(face.volume_control_point.begin(), face.volume_control_point.end());
    patches.push_back({face.space, solver.reference_of(ids)});
    nodes.insert(nodes.end(), ids.begin(), ids.end());
    outward_sign.push_back(face.outward_sign);
    faces.push_back(face);
  }
  // Edges that only touch, as those of a slit tube, part when the solid moves: welded are those of the same
  // nodes.
  const auto same_nodes = [&](int patch, int side, int other_patch, int other_side) {
    return side_nodes(faces[patch], side) == side_nodes(faces[other_patch], other_side);
  };
  constexpr double kTolerance = 1e-9;
  nurbs::MultiPatch topology = nurbs::join(patches).topology;
  topology.set_borders(nurbs::find_borders(patches, kTolerance, {}, same_nodes));
  return {std::move(topology), SurfaceMap::selection(nodes, solver.all_nodes()), std::move(outward_sign)};
}

/// "zeta+" as in model files; of a further patch "1 zeta+".
std::string name_of(const structure::SkinPiece& piece) {
  const char* const face = nurbs::face_name(piece.face);
  return piece.patch == 0 ? face : fmt::format("{} {}", piece.patch, face);
}

FingerprintPart material_part(const structure::Material& material, const std::string& of_patch) {
  const double E = material.youngs_modulus(), nu = material.poissons_ratio(), density = material.density();
  FingerprintPart part{"material" + of_patch,
                       fmt::format("E = {:.10g}, nu = {:.10g}, density = {:.10g}", E, nu, density),
                       {E, nu, density}};
  for (const double constant : material.further_constants()) {
    part.text += fmt::format(", {:.10g}", constant);
    part.numbers.push_back(constant);
  }
  if (const int size = material.state_size(); size > 0) {  // parts of elastic solids are as they always were
    part.text += fmt::format(", {} numbers of memory at a point", size);
    part.numbers.push_back(size);
  }
  return part;
}

/// One for all patches, if they are of one.
void add_materials(const structure::Body& body, Fingerprint& fingerprint) {
  const std::vector<const structure::Material*> materials = body.materials();
  const bool one = std::all_of(materials.begin(), materials.end(),
                               [&](const auto* material) { return material == materials.front(); });
  for (std::size_t p = 0; p < (one ? 1 : materials.size()); ++p) {
    const std::string of_patch = one ? "" : fmt::format(" of patch {}", p);
    fingerprint.push_back(word_part("law of the material" + of_patch, materials[p]->law()));
    fingerprint.push_back(material_part(*materials[p], of_patch));
  }
}

/// Of the whole body; each part looks at its own.
ControlPointDigest digest(const structure::Halo& halo, const NodalVectors& reference) {
  const auto X = halo.own(reference);
  structure::ExactSum checksum;
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    for (int c = 0; c < 3; ++c) checksum.add(checksum_term(3 * halo.node_id(i) + c, X(c, i)));
  ControlPointDigest digest{static_cast<std::size_t>(halo.sum(static_cast<double>(X.size()))),
                            halo.total(checksum), Vector3::Zero(), Vector3::Zero()};
  for (int c = 0; c < 3; ++c) {
    digest.lower[c] = -halo.largest(X.cols() > 0 ? -X.row(c).minCoeff() : structure::kNowhere);
    digest.upper[c] = halo.largest(X.cols() > 0 ? X.row(c).maxCoeff() : structure::kNowhere);
  }
  return digest;
}

// What is held; how it moves is the model's business, as loads are.
FingerprintPart supports_part(const structure::ExplicitSolver& solver) {
  FingerprintPart part{"supports", "", {}};
  const auto add = [&](const std::vector<structure::Id>& dofs) {
    part.numbers.push_back(static_cast<double>(dofs.size()));
    part.numbers.push_back(checksum({dofs.begin(), dofs.end()}));
  };
  const std::vector<structure::Id> fixed = solver.fixed_dofs(), moved = solver.moved_dofs();
  part.text = fmt::format("{} fixed degrees of freedom", fixed.size());
  add(fixed);
  if (moved.empty()) return part;
  part.text += fmt::format(", {} of which move", moved.size());
  add(moved);
  return part;
}

/// Of the whole body; without springs there is no such part.
std::optional<FingerprintPart> springs_part(const structure::ExplicitSolver& solver) {
  const structure::Halo& halo = solver.halo();
  const Eigen::Index owned = halo.owned(solver.positions().cols());
  structure::ExactSum count, stiffness, check;
  for (const auto& group : solver.springs().groups())
    for (const auto& [column, k] : group) {
      if (column >= owned) continue;
      count.add(1.0), stiffness.add(k.trace());
      for (int i = 0; i < 9; ++i) check.add(checksum_term(9 * halo.node_id(column) + i, k(i)));
    }
  const double all = halo.total(count), sum = halo.total(stiffness), terms = halo.total(check);
  if (all == 0.0) return {};
  return FingerprintPart{
      "springs", fmt::format("{} of stiffness {:.10g} in all directions together", all, sum), {all, terms}};
}

double total_mass(const structure::ExplicitSolver& solver) {
  const Eigen::VectorXd& m = solver.mass().nodal_mass();
  return solver.halo().sum_over_nodes(
      m.size(), [&](Eigen::Index first, Eigen::Index count) { return m.segment(first, count).sum(); });
}

}  // namespace

IgaStructure::IgaStructure(structure::ExplicitSolver solver, std::vector<structure::SkinPiece> skin,
                           std::vector<structure::Probe> probes, const std::optional<Vector3>& gravity,
                           bool in_parts)
    : solver_(std::move(solver)),
      skin_(std::move(skin)),
      nodes_(solver_.node_ids()),
      in_parts_(in_parts),
      supports_(supports_part(solver_)),
      springs_(springs_part(solver_)),
      surface_(surface_of(solver_, skin_)),
      mass_(total_mass(solver_)),
      probes_(std::move(probes)),
      gravity_(gravity) {}

void IgaStructure::initialise_forces(const NodalForces& forces) {
  solver_.initialise_forces(forces.values);
  write_output();
}

void IgaStructure::end_step(const NodalForces& forces) {
  try {
    solver_.end_step(forces.values);
  } catch (const structure::TooStrained& problem) {
    throw structure::TooStrained(fmt::format("{}, or 'substeps auto'", problem.what()));
  }
  write_output();
}

void IgaStructure::write_output() {
  if (history_) history_->record_if_due(solver_);
  if (fields_) fields_->write_if_due(solver_);
}

void IgaStructure::write_output(double time, double step, const std::function<void()>& place,
                                const std::function<void(io::HistoryRow& row)>& amend) {
  const bool row = history_ && history_->is_due(time, step), state = fields_ && fields_->is_due(time, step);
  if (row || state) place();
  if (row) history_->record(solver_, amend);
  if (state) fields_->write(solver_);
}

void IgaStructure::correct_contacts(std::unique_ptr<MeshCompliance> compliance) {
  compliance_ = std::move(compliance);
  if (!compliance_) return;
  compliance_->set_places([this] { return nurbs::nodal_vectors(solver_.in_order(solver_.positions())); });
}

std::vector<double> IgaStructure::save() const {
  std::vector<double> state = solver_.save();
  if (!compliance_) return state;
  const std::vector<double> strained = compliance_->tables().save();
  if (strained.empty()) return state;
  state.insert(state.end(), strained.begin(), strained.end());
  state.push_back(static_cast<double>(strained.size()));
  return state;
}

std::size_t IgaStructure::state_size() const {
  const std::size_t strained = compliance_ ? compliance_->tables().save().size() : 0;
  return solver_.state_size() + (strained > 0 ? strained + 1 : 0);
}

void IgaStructure::load(const std::vector<double>& state) {
  auto end = state.end();
  if (compliance_ && !solver_.can_load(state.size()) && !state.empty())
    end -= 1 + static_cast<std::ptrdiff_t>(saved_size(state.back(), state.size() - 1));
  solver_.load({state.begin(), end});
  if (compliance_) compliance_->tables().load({end, end == state.end() ? end : state.end() - 1});
  if (history_) history_->resume();
  if (fields_) fields_->resume();
}

void IgaStructure::set_time_step(double dt) {
  const double stable = solver_.stable_time_step();
  if (dt > stable)
    throw std::invalid_argument(fmt::format(
        "timestep {:.6g} is above the structure's stable step {}; use a timestep of at most {:.3g}, or "
        "'substeps auto'",
        dt, structure::step_text(stable), 0.9 * stable));
  solver_.set_time_step(dt);
}

void IgaStructure::set_gravity(const Vector3& g) {
  solver_.set_load(load_without_gravity_ + g * solver_.mass().nodal_mass().transpose());
  gravity_ = g;
}

std::vector<SurfaceMaterial> IgaStructure::materials() const {
  std::vector<SurfaceMaterial> materials;
  for (const structure::SkinPiece& piece : skin_) {
    const structure::Material& material = *solver_.body().materials()[piece.patch];
    const SurfaceMaterial below = {material.youngs_modulus(), material.poissons_ratio()};
    if (std::find(materials.begin(), materials.end(), below) == materials.end()) materials.push_back(below);
  }
  return materials;
}

std::optional<MeshedSolid> IgaStructure::solid_below(int patch) const {
  const structure::Material& material = *solver_.body().materials()[skin_[patch].patch];
  const double E = material.youngs_modulus(), nu = material.poissons_ratio();
  const double density = material.density();
  return MeshedSolid{E / (1.0 - nu * nu), std::sqrt(0.5 * E / (1.0 + nu) / density), density, mass_};
}

Work IgaStructure::work() const {
  const structure::Work work = solver_.work();
  return {work.forces, work.loads, work.internal, work.supports, work.damped};
}

std::vector<Probe> IgaStructure::probes() const {
  std::vector<Probe> values;
  for (const structure::Probe& probe : probes_) values.push_back({probe.name, solver_.displacement(probe)});
  return values;
}

void IgaStructure::watch(std::vector<structure::NamedSupport> supports) {
  named_supports_ = std::move(supports);
  if (!named_supports_.empty()) solver_.keep_reactions();
}

std::vector<Reaction> IgaStructure::reactions() const {
  std::vector<Reaction> reactions;
  for (const structure::NamedSupport& support : named_supports_)
    reactions.push_back({support.name, solver_.reaction(support)});
  return reactions;
}

Fingerprint IgaStructure::fingerprint() const {
  const structure::Body& body = solver_.body();
  std::vector<std::string> faces;
  for (const structure::SkinPiece& piece : skin_) faces.emplace_back(name_of(piece));
  const ControlPointDigest points = digest(solver_.halo(), body.reference());
  const auto geometry = [&](const auto& patches) { return geometry_part(patches, points); };
  Fingerprint fingerprint{std::visit(geometry, body.patches()),
                          word_part("surface", fmt::format("{}", fmt::join(faces, ", ")))};
  add_materials(body, fingerprint);
  fingerprint.push_back(supports_);
  if (springs_) fingerprint.push_back(*springs_);
  if (!body.discretisation().empty()) fingerprint.push_back(word_part("quadrature", body.discretisation()));
  if (body.corrects_mass()) fingerprint.push_back(word_part("mass", "corrected"));
  return fingerprint;
}

}  // namespace coupling
