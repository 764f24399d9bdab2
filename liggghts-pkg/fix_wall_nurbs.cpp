// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_nurbs.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "coupling/force_distribution.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "modify.h"
#include "neighbor.h"
#include "primitive_wall.h"
#include "update.h"
#include "wall_nurbs_checks.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using liggghts_pkg::Candidate;
using liggghts_pkg::ContactSlot;
using nurbs::Vector3;

FixWallNurbs::FixWallNurbs(LAMMPS* lmp, int narg, char** arg)
    : WallNurbsSetup(lmp, narg, arg),
      FixWallGran(lmp, static_cast<int>(stock_arg_.size()), stock_arg_.data()),
      structure_(*opened_.solver),
      exchange_(world, structure_),
      projector_(structure_.surface().space),
      search_(options_.search),
      totals_(),
      all_totals_() {
  delete primitiveWall_;
  primitiveWall_ = nullptr;
  if (store_force_contact_stress_)
    fail("fix continuum/weighted needs per-contact forces, which this wall does not store");

  vector_flag = 1;
  size_vector = kTotalColumns + kStructureColumns + 3 * static_cast<int>(structure_.probes().size());
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  late_surface_ = std::getenv("LIGGGHTS_NURBS_TEST_LATE_SURFACE") != nullptr;
}

void FixWallNurbs::fail(const std::string& message) const {
  error->all(FLERR, wall_nurbs_message(id, message).c_str());
  std::abort();  // error->all does not return, but is not declared so
}

void FixWallNurbs::warn(const std::string& message) const {
  if (comm->me == 0) error->warning(FLERR, wall_nurbs_message(id, message).c_str());
}

// The screen or the log file may be switched off.
void FixWallNurbs::print(const std::string& message) const {
  for (FILE* file : {screen, logfile})
    if (comm->me == 0 && file) std::fprintf(file, "%s\n", wall_nurbs_message(id, message).c_str());
}

int FixWallNurbs::setmask() {
  const int integrates = structure_.moves() ? INITIAL_INTEGRATE | FINAL_INTEGRATE : 0;
  return FixWallGran::setmask() | integrates;
}

/* ----------------------------------------------------------------------
   per-particle storage; in place of the base class' own, which has room for one contact's history only
------------------------------------------------------------------------- */

void FixWallNurbs::post_create() {
  const auto add_property = [this](const std::string& name, const char* restart,
                                   const std::vector<std::string>& initial) {
    std::vector<std::string> words = {name, "all", "property/atom", name, "vector", restart, "no", "no"};
    words.insert(words.end(), initial.begin(), initial.end());
    std::vector<char*> arg;
    for (std::string& word : words) arg.push_back(word.data());
    modify->add_fix(static_cast<int>(arg.size()), arg.data());
    return static_cast<FixPropertyAtom*>(modify->find_fix_property(
        name.c_str(), "property/atom", "vector", static_cast<int>(initial.size()), 0, style));
  };

  std::vector<std::string> empty_slot(ContactSlot::kFootValues + dnum_, "0.");
  empty_slot[0] = "-1.";
  fix_memory_ = add_property(fmt::format("contacts_{}", id), "yes", empty_slot);
  if (store_force_) fix_wallforce_ = add_property(fmt::format("force_{}", id), "no", {"0.", "0.", "0."});
}

void FixWallNurbs::pre_delete(bool unfixflag) {
  if (unfixflag && fix_memory_) modify->delete_fix(fix_memory_->id);
  FixWallGran::pre_delete(unfixflag);
}

/* ---------------------------------------------------------------------- */

void FixWallNurbs::init() {
  try {
    liggghts_pkg::check_run_style(*update);
    FixWallGran::init();
    if (!options_.material_independent)
      liggghts_pkg::check_wall_material(*modify, atom_type_wall_, structure_.material(), options_.file);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
  reset_dt();
  const std::string beyond = liggghts_pkg::periodic_directions_left(*domain, exchange_.positions());
  if (!beyond.empty())
    warn(fmt::format("the wall reaches beyond the periodic boundary in {}: particles do not meet its image",
                     beyond));
  inside_steps_ = 0;
  inside_tag_ = 0;
}

void FixWallNurbs::reset_dt() {
  dt_ = update->dt;
  try {
    structure_.set_time_step(dt_);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
}

void FixWallNurbs::createMulticontactData() { fail("surface multicontact is not supported by this wall"); }

/* ----------------------------------------------------------------------
   one time step, in the order LIGGGHTS calls it; setup evaluates forces and advances nothing
------------------------------------------------------------------------- */

void FixWallNurbs::import_surface() {
  exchange_.import_surface();
  projector_.set_control_points(exchange_.positions());
}

void FixWallNurbs::setup(int vflag) {
  import_surface();
  FixWallGran::setup(vflag);  // pre_neighbor, pre_force, post_force
  if (structure_.moves()) structure_.initialise_forces(*nodal_forces_);
}

void FixWallNurbs::initial_integrate(int) {
  if (late_surface_) import_surface();
  structure_.begin_step();
  if (!late_surface_) import_surface();
  // The list is good until the wall has moved half a skin; it is then rebuilt before this step's forces.
  const double motion = candidates_.motion_since_build(exchange_.positions());
  if (!std::isfinite(motion))
    fail(
        fmt::format("the structure in '{}' has blown up: its positions are not finite at step {}; use a "
                    "smaller timestep or look at the loads",
                    options_.file, update->ntimestep));
  if (motion > 0.5 * neighbor->skin) rebuild_candidates_ = true;
}

void FixWallNurbs::pre_neighbor() { rebuild_candidates_ = true; }

void FixWallNurbs::pre_force(int) {
  cutneighmax_ = neighbor->cutneighmax;
  if (rebuild_candidates_) build_candidates();
  rebuild_candidates_ = false;
}

void FixWallNurbs::post_force(int vflag) {
  FixWallGran::post_force(vflag);  // calls post_force_primitive
  totals_are_summed_ = false;
  if (structure_.moves()) nodal_forces_ = &exchange_.export_add(contacts_);
}

void FixWallNurbs::final_integrate() { structure_.end_step(*nodal_forces_); }

/* ----------------------------------------------------------------------
   global search: since LIGGGHTS built its lists a particle may be half a skin to either side, and the wall
   may move half a skin more
------------------------------------------------------------------------- */

void FixWallNurbs::build_candidates() {
  search_cold_ = true;
  candidates_.build(structure_.surface().space, exchange_.positions(), atom->nlocal, atom->x, atom->radius,
                    neighbor->contactDistanceFactor, 1.5 * neighbor->skin);
  forget_lost_contacts();
}

void FixWallNurbs::forget_lost_contacts() {
  is_candidate_.assign(atom->nlocal, false);
  for (const Candidate& candidate : candidates_.candidates()) is_candidate_[candidate.particle] = true;
  for (int i = 0; i < atom->nlocal; ++i)
    if (!is_candidate_[i]) slot(i).clear();
}

ContactSlot FixWallNurbs::slot(int particle) { return ContactSlot(fix_memory_->array_atom[particle], dnum_); }

/* ----------------------------------------------------------------------
   local search and contact forces
------------------------------------------------------------------------- */

void FixWallNurbs::post_force_primitive(int) {
  contacts_.clear();
  totals_ = Totals();
  const double close = neighbor->contactDistanceFactor - 1.0;

  for (const Candidate& candidate : candidates_.candidates()) {
    const int i = candidate.particle;
    if (!(atom->mask[i] & groupbit)) continue;

    const nurbs::Projection foot = project(candidate);
    slot(i).set_foot(0, foot.xi);
    const double gap = foot.distance - atom->radius[i];
    if (gap <= 0.0 || gap < close * atom->radius[i])
      apply_contact(i, foot, gap);
    else
      slot(i).forget_history();
  }
  search_cold_ = false;
}

// From the foot of the last step; after each rebuild of the list anew, since another part of a curved wall
// may have come nearer.
nurbs::Projection FixWallNurbs::project(const Candidate& candidate) {
  const ContactSlot memory = slot(candidate.particle);
  const nurbs::Parameter<2> last = memory.xi();
  const bool warm = !memory.empty() && !search_cold_;
  return search_.project({structure_.surface().space, exchange_.positions(), projector_,
                          Vector3::Map(atom->x[candidate.particle]), candidates_.elements(candidate),
                          candidate.count, warm ? &last : nullptr});
}

bool FixWallNurbs::inside_body(const nurbs::Projection& foot, const double* centre) const {
  const coupling::ContactSurface& surface = structure_.surface();
  if (surface.outward_sign == 0 || foot.status != nurbs::ProjectionStatus::interior) return false;
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(surface.space, foot.xi, 1, basis);
  Vector3 tangent[2] = {Vector3::Zero(), Vector3::Zero()};
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 2; ++d)
      tangent[d] += basis.dR[d][a] * exchange_.positions().col(basis.control_point[a]);
  return surface.outward_sign * tangent[0].cross(tangent[1]).dot(Vector3::Map(centre) - foot.foot) < 0.0;
}

void FixWallNurbs::apply_contact(int i, const nurbs::Projection& foot, double gap) {
  const coupling::FootBasis basis(structure_.surface().space, foot.xi);
  Vector3 wall_velocity = basis.interpolate(exchange_.velocities());
  const Vector3 delta = Vector3::Map(atom->x[i]) - foot.foot;

  LCM::SurfacesIntersectData contact;
  contact.is_wall = true;
  contact.i = i;
  contact.radi = atom->radius[i];
  contact.deltan = -gap;
  Vector3::Map(contact.delta) = delta;
  contact.contact_history = slot(i).history();

  // The models add to the particle's force; a force of zero before shows what they add.
  Eigen::Map<Vector3> f(atom->f[i]), torque(atom->torque[i]);
  const Vector3 f_before = f, torque_before = torque;
  f.setZero();
  torque.setZero();
  impl->compute_force(this, contact, gap <= 0.0, wall_velocity.data());
  const Vector3 F = f, T = torque;
  f = f_before + F;
  torque = torque_before + T;

  if (gap > 0.0 && F.isZero(0.0)) return;
  const Vector3 wall_torque = -(T + Vector3::Map(atom->x[i]).cross(F));
  Vector3::Map(totals_.force) -= F;
  Vector3::Map(totals_.torque) += wall_torque;
  totals_.contacts += 1.0;
  totals_.overlap = std::max(totals_.overlap, -gap);
  contacts_.push_back({atom->tag[i], 0, {foot.xi[0], foot.xi[1]}, {-F[0], -F[1], -F[2]}});

  if (inside_body(foot, atom->x[i])) {
    ++inside_steps_;
    inside_tag_ = std::max(inside_tag_, atom->tag[i]);
  }
}

void FixWallNurbs::post_run() {
  const liggghts_pkg::LocalSearch::Counts searches = liggghts_pkg::sum(search_.counts(), world);
  search_.reset();
  print(liggghts_pkg::report(searches));
  if (searches.not_converged() > 0)
    warn(fmt::format("{} closest-point projections did not converge", searches.not_converged()));

  const long counts[2] = {inside_steps_, inside_tag_};
  long sum[2], largest[2];
  MPI_Allreduce(counts, sum, 2, MPI_LONG, MPI_SUM, world);
  MPI_Allreduce(counts, largest, 2, MPI_LONG, MPI_MAX, world);
  if (sum[0] > 0)
    warn(fmt::format(
        "the centre of particle {} got inside the solid ({} contacts of this kind in this run): use a "
        "smaller timestep or a stiffer contact",
        largest[1], sum[0]));
}

/* ----------------------------------------------------------------------
   f_ID[1..]: see doc/fix_wall_nurbs.md
------------------------------------------------------------------------- */

const FixWallNurbs::Totals& FixWallNurbs::totals_of_all_ranks() {
  if (!totals_are_summed_) {
    static_assert(sizeof(Totals) == kTotalColumns * sizeof(double), "Totals is a row of columns");
    MPI_Allreduce(&totals_, &all_totals_, kTotalColumns - 1, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(&totals_.overlap, &all_totals_.overlap, 1, MPI_DOUBLE, MPI_MAX, world);
    totals_are_summed_ = true;
  }
  return all_totals_;
}

double FixWallNurbs::compute_vector(int column) {
  if (column < kTotalColumns) return reinterpret_cast<const double*>(&totals_of_all_ranks())[column];
  return structure_column(column - kTotalColumns);
}

double FixWallNurbs::structure_column(int column) const {
  if (column < 3) return structure_.linear_momentum()[column];
  if (column < 6) return structure_.angular_momentum(Vector3::Zero())[column - 3];
  if (column == 6) return structure_.kinetic_energy();
  if (column == 7) return structure_.strain_energy();
  if (column == 8) return structure_.stable_time_step();
  const int probe = (column - kStructureColumns) / 3, direction = (column - kStructureColumns) % 3;
  return structure_.probes()[probe].displacement[direction];
}

/* ----------------------------------------------------------------------
   restart: the structure's state; contact memory restarts with its fix property/atom
------------------------------------------------------------------------- */

void FixWallNurbs::write_restart(FILE* file) {
  std::vector<double> state = structure_.save();
  state.insert(state.begin(), static_cast<double>(state.size()));
  if (comm->me != 0) return;
  const int bytes = static_cast<int>(state.size() * sizeof(double));
  std::fwrite(&bytes, sizeof(int), 1, file);
  std::fwrite(state.data(), sizeof(double), state.size(), file);
}

void FixWallNurbs::restart(char* buffer) {
  double size;
  std::memcpy(&size, buffer, sizeof(double));
  std::vector<double> state(static_cast<std::size_t>(size));
  std::memcpy(state.data(), buffer + sizeof(double), state.size() * sizeof(double));
  try {
    structure_.load(state);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
  import_surface();
}
