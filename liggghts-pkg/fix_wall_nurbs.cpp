// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_nurbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "modify.h"
#include "neighbor.h"
#include "periodic_images.h"
#include "primitive_wall.h"
#include "update.h"
#include "wall_nurbs_checks.h"
#include "wall_nurbs_message.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using contact::Candidate;
using contact::ContactTracker;
using nurbs::Vector3;

FixWallNurbs::FixWallNurbs(LAMMPS* lmp, int narg, char** arg)
    : WallNurbsSetup(lmp, narg, arg),
      FixWallGran(lmp, static_cast<int>(stock_arg_.size()), stock_arg_.data()),
      structure_(*opened_.solver),
      exchange_(world, structure_),
      surface_(structure_.surface().topology),
      projector_(surface_),
      regularity_(surface_),
      search_(options_.search, projector_),
      tracker_(search_, regularity_, candidates_),
      outward_sign_(structure_.surface().outward_sign),
      no_forces_(coupling::NodalVectors::Zero(3, structure_.surface().map.node_count())),
      totals_() {
  delete primitiveWall_;
  primitiveWall_ = nullptr;
  if (store_force_contact_stress_)
    fail("fix continuum/weighted needs per-contact forces, which this wall does not store");

  vector_flag = 1;
  size_vector =
      kTotalColumns + kStructureColumns + 3 * static_cast<int>(structure_.probes().size()) + 1 + kWorkColumns;
  global_freq = 1;
  extvector = 0;
  local_flag = 1;
  size_local_cols = kLocalColumns;
  local_freq = 1;
  restart_global = 1;
  can_create_mesh_ = true;
  refuse_second_solid();
  open_output();
}

void FixWallNurbs::fail(const std::string& message) const {
  error->all(FLERR, wall_nurbs_message(id, message).c_str());
  std::abort();  // error->all does not return, but is not declared so
}

// error->one aborts before what it printed has left its buffer.
void FixWallNurbs::fail_on_this_rank(const std::string& message) const {
  for (FILE* file : {screen ? screen : stderr, logfile}) {
    if (!file) continue;
    std::fprintf(file, "ERROR on proc %d: %s\n", comm->me, wall_nurbs_message(id, message).c_str());
    std::fflush(file);
  }
  MPI_Abort(world, 1);
  std::abort();  // MPI_Abort does not return, but is not declared so
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
  return FixWallGran::setmask() | INITIAL_INTEGRATE | FINAL_INTEGRATE | (output_ ? END_OF_STEP : 0);
}

int FixWallNurbs::modify_param(int narg, char** arg) { return modify_drive(lmp, id, narg, arg); }

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
  };

  // One fix for each slot: LIGGGHTS warns of rows longer than 20.
  std::vector<std::string> empty_slot(contact::ContactSlot::kFootValues + dnum_, "0.");
  empty_slot[0] = fmt::format("{}", contact::ContactSlot::kEmpty);
  for (int s = 0; s < options_.slots; ++s) {
    slot_ids_.push_back(fmt::format("contact{}_{}", s + 1, id));
    add_property(slot_ids_.back(), "yes", empty_slot);
  }
  if (store_force_) add_property(wall_force_id(), "no", {"0.", "0.", "0."});
  find_properties();
  note_restart_data();
}

std::string FixWallNurbs::wall_force_id() const { return fmt::format("force_{}", id); }

// LIGGGHTS lets a user unfix what another fix holds, so nothing is held from one run to the next.
void FixWallNurbs::find_properties() {
  const auto find = [this](const std::string& name) {
    const int place = modify->find_fix(name.c_str());
    auto* const property = place < 0 ? nullptr : dynamic_cast<FixPropertyAtom*>(modify->fix[place]);
    if (!property)
      fail(
          fmt::format("its fix '{0}', where particles keep what belongs to this wall, is gone; do not unfix "
                      "'{0}', or 'unfix {1}' and define the wall anew",
                      name, id));
    return property;
  };
  fix_slots_.clear();
  for (const std::string& slot : slot_ids_) fix_slots_.push_back(find(slot));
  slots_.resize(fix_slots_.size());
  if (store_force_) fix_wallforce_ = find(wall_force_id());
}

void FixWallNurbs::pre_delete(bool unfixflag) {
  if (unfixflag) {
    std::vector<std::string> names = slot_ids_;
    if (store_force_) names.push_back(wall_force_id());
    for (const std::string& name : names)
      if (modify->find_fix(name.c_str()) >= 0) modify->delete_fix(name.c_str());
  }
  store_force_ = false;  // what the base class would delete is gone
  FixWallGran::pre_delete(unfixflag);
}

/* ---------------------------------------------------------------------- */

void FixWallNurbs::init() {
  warn_of_state_not_taken();
  try {
    liggghts_pkg::check_run_style(*update);
    find_properties();
    FixWallGran::init();
    if (!options_.material_independent)
      liggghts_pkg::check_wall_material(*modify, atom_type_wall_, structure_.material(), options_.file);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
  init_wear();
  reset_dt();
  if (!structure_.deforms()) weld_across_periodic_faces();
  inside_ = crossing_ = contact::RunAlarm();
}

// A wall that spans a periodic box has no edge there.
void FixWallNurbs::weld_across_periodic_faces() {
  std::vector<Vector3> in_frame;
  for (const Vector3& period : liggghts_pkg::periods(*domain))
    in_frame.push_back(structure_.frame().rotation.transpose() * period);
  constexpr double kTolerance = 1e-9;
  surface_.set_borders(
      nurbs::find_borders(nurbs::split(surface_, exchange_.positions()), kTolerance, in_frame));
  regularity_.set_control_points(exchange_.positions());  // it depends on the borders
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
  frame_ = structure_.frame();
  if (surface_imported_ && !structure_.deforms()) return;
  exchange_.import_surface();
  projector_.set_control_points(exchange_.positions());
  surface_imported_ = true;
}

void FixWallNurbs::setup(int vflag) {
  structure_.begin_run();  // not in init: LIGGGHTS knows only now which computes its variables need
  import_surface();
  FixWallGran::setup(vflag);  // pre_neighbor, pre_force, post_force
  if (structure_.moves()) advance([this] { structure_.initialise_forces(*nodal_forces_); });
  if (output_ && output_->at_beginning()) end_of_step();
  warn_of_missing_gravity();
}

void FixWallNurbs::warn_of_missing_gravity() {
  const std::string missing = liggghts_pkg::missing_gravity(*modify, structure_, options_.file);
  if (!missing.empty() && !warned_of_gravity_) warn(missing);
  warned_of_gravity_ = !missing.empty();
}

void FixWallNurbs::initial_integrate(int) {
  if (!structure_.moves()) return;
  advance([this] { structure_.begin_step(); });
  import_surface();
  // The list is good until the wall has moved half a skin; it is then rebuilt before this step's forces.
  const double motion = candidates_.motion_since_build(exchange_.positions(), structure_.deforms(), frame_);
  if (!std::isfinite(motion))
    fail_in_step(
        structure_.deforms()
            ? "the solid has blown up: its positions are not finite; likely cause: the loads or the timestep"
            : "the wall's place is not finite; likely cause: the numbers that move it");
  if (motion > 0.5 * neighbor->skin) rebuild_candidates_ = true;
  surface_motion_ = structure_.deforms() ? motion : 0.0;
}

void FixWallNurbs::pre_neighbor() { rebuild_candidates_ = true; }

void FixWallNurbs::pre_force(int) {
  cutneighmax_ = neighbor->cutneighmax;
  if (!rebuild_candidates_) return;
  rebuild_candidates_ = false;
  build_candidates();
}

void FixWallNurbs::post_force(int vflag) {
  if (output_) output_->begin_step(update->setupflag, update->get_cur_time());
  FixWallGran::post_force(vflag);  // calls post_force_primitive
  totals_are_summed_ = false;
  publish_local_rows();
  nodal_forces_ = structure_.needs_forces() ? &exchange_.export_add(contacts_) : &no_forces_;
}

void FixWallNurbs::final_integrate() {
  advance([this] { structure_.end_step(*nodal_forces_); });
}

// What the structure complains of on the way is told with the step, on every rank.
template <class Action>
void FixWallNurbs::advance(Action action) {
  try {
    action();
  } catch (const std::exception& problem) {
    fail_in_step(problem.what());
  }
}

void FixWallNurbs::fail_in_step(const std::string& problem) const {
  fail(fmt::format("'{}': step {}: {}", options_.file, update->ntimestep, problem));
}

/* ----------------------------------------------------------------------
   global search: from where LIGGGHTS built its lists a particle moves by half a skin to either side (what it
   grows counts as motion there) before they are built anew, and the wall may move half a skin more; what is
   faster than that must not slip through unseen
------------------------------------------------------------------------- */

void FixWallNurbs::build_candidates() {
  find_slots();
  list_reach_.resize(atom->nlocal);
  radius_limit_.resize(atom->nlocal);
  if (structure_.deforms() || !candidates_.has_surface()) {
    candidates_.set_surface(surface_, exchange_.positions());
    regularity_.set_control_points(exchange_.positions());
  }
  wall_travel_ = largest_wall_speed() * dt_;
  double largest = 0.0;
  const double touch_factor = neighbor->contactDistanceFactor;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double travel = Vector3::Map(atom->v[i]).norm() * dt_ + wall_travel_;
    list_reach_[i] = atom->radius[i] * touch_factor + 1.5 * neighbor->skin + travel;
    radius_limit_[i] = atom->radius[i] + 0.5 * neighbor->skin / touch_factor;
    largest = std::max(largest, list_reach_[i]);
  }
  const std::vector<Vector3> images =
      liggghts_pkg::wall_images(*domain, candidates_.wall_bounds(), frame_, largest);
  check_images(images);
  candidates_.build(frame_, images, {atom->nlocal, atom->x, list_reach_.data()});
  constexpr double kResolution = 1e-10;  // of the wall's coordinates, which feet know to about 1e-16
  const search::Box& bounds = candidates_.wall_bounds();
  resolution_ = kResolution * bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).maxCoeff();
  tracker_.list_is_new();
  surface_motion_ = 0.0;
  forget_lost_contacts();
  near_particles_ = static_cast<long>(candidates_.candidates().size());
}

double FixWallNurbs::largest_wall_speed() const {
  if (structure_.deforms()) return std::sqrt(exchange_.velocities().colwise().squaredNorm().maxCoeff());
  return frame_.max_speed(candidates_.wall_bounds());
}

// The list leaves half a skin for growth.  Other fixes may change radii as late as in pre_force.
bool FixWallNurbs::has_outgrown_list() const {
  bool outgrown = false;  // no way out of the loop, so that it is vectorised
  for (int i = 0; i < atom->nlocal; ++i) outgrown |= atom->radius[i] > radius_limit_[i];
  return outgrown;
}

// Feet keep their image while the wall turns.
void FixWallNurbs::check_images(const std::vector<Vector3>& images) const {
  constexpr double kSame = 1e-9;
  for (const Vector3& image : images)
    if ((frame_.rotation * image - image).norm() > kSame * image.norm())
      fail_on_this_rank(
          "the wall turns about an axis that is not along the periodic direction across which it reaches; "
          "use a "
          "boundary that is not periodic there, or a box that holds the whole wall");
}

void FixWallNurbs::forget_lost_contacts() {
  is_candidate_.assign(atom->nlocal, false);
  for (const Candidate& candidate : candidates_.candidates()) is_candidate_[candidate.particle] = true;
  for (int i = 0; i < atom->nlocal; ++i)
    if (!is_candidate_[i]) memory(i).clear();
}

// Rows move when the number of particles grows.
void FixWallNurbs::find_slots() {
  for (size_t s = 0; s < slots_.size(); ++s) slots_[s] = fix_slots_[s]->array_atom;
}

/* ---------------------------------------------------------------------- */

void FixWallNurbs::post_force_primitive(int) {
  if (has_outgrown_list()) build_candidates();
  find_slots();
  contacts_.clear();
  local_rows_.clear();
  now_.deforms = structure_.deforms();
  now_.slides = structure_.slides();
  now_.stands =
      !now_.deforms && !now_.slides && frame_.velocity.isZero(0.0) && frame_.angular_velocity.isZero(0.0);
  now_.is_turned = !frame_.rotation.isIdentity(0.0);
  now_.needs_forces = structure_.needs_forces();
  tracker_.begin_step(surface_motion_);
  // A block at a time: its feet are found together, and are still at hand when its contacts are resolved.
  constexpr int kBlock = 64;
  ContactTracker::Query queries[kBlock];
  const std::vector<Candidate>& candidates = candidates_.candidates();
  const int count = static_cast<int>(candidates.size());
  const int* const mask = atom->mask;
  const double* const radius = atom->radius;
  const double* const* const x = atom->x;
  const double touch_factor = neighbor->contactDistanceFactor;
  for (int c = 0; c < count;) {
    int n = 0;
    for (; c < count && n < kBlock; ++c) {
      const int i = candidates[c].particle;
      if (!(mask[i] & groupbit)) continue;
      // In place: to copy a struct just written in parts waits for all stores.
      ContactTracker::Query& query = queries[n];
      query.centre = Vector3::Map(x[i]) - frame_.origin;
      if (now_.is_turned) query.centre = frame_.rotation.transpose() * query.centre;
      const double touch_reach = radius[i] * touch_factor;
      if (tracker_.is_quiet(c, query.centre, touch_reach)) continue;
      query.candidate = c;
      query.touch_reach = touch_reach;
      query.list_reach = list_reach_[i];
      ++n;
    }
    tracker_.follow(queries, n);
    for (int k = 0; k < n; ++k) resolve_contacts(queries[k]);
  }
}
