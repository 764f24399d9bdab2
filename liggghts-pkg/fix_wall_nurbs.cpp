// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_nurbs.h"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "atom.h"
#include "brep/summary.h"
#include "brep/triangle_mesh.h"
#include "domain.h"
#include "geometry_io/geometry_summary.h"
#include "model_words.h"
#include "modify.h"
#include "neighbor.h"
#include "primitive_wall.h"
#include "setting.h"
#include "update.h"
#include "wall_nurbs_checks.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

contact::PeriodicBox box_of(const Domain& domain) {
  return {nurbs::Vector3::Map(domain.boxlo),
          nurbs::Vector3::Map(domain.boxhi),
          {domain.xperiodic != 0, domain.yperiodic != 0, domain.zperiodic != 0}};
}

}  // namespace

FixWallNurbs::FixWallNurbs(LAMMPS* lmp, int narg, char** arg)
    : WallNurbsSetup(lmp, narg, arg),
      FixWallGran(lmp, static_cast<int>(stock_arg_.size()), stock_arg_.data()),
      messages_(lmp, id),
      structure_(*opened_.solver),
      exchange_(world, structure_),
      loop_(structure_, exchange_, {options_.search, options_.edge_angle, options_.curvature_radius}),
      model_(
          *this, *impl, *atom,
          liggghts_pkg::TangentialSprings(liggghts_pkg::tangential_spring_place(lmp, options_.model_words)),
          options_.curvature_radius),
      memory_(lmp, id, options_.slots, store_force_),
      columns_(structure_, loop_, model_.springs(), world),
      restart_(lmp, id, options_.file, structure_, exchange_),
      no_forces_(coupling::NodalVectors::Zero(3, structure_.nodes().size())) {
  delete primitiveWall_;
  primitiveWall_ = nullptr;
  if (store_force_contact_stress_)
    messages_.fail("fix continuum/weighted needs per-contact forces, which this wall does not store");

  vector_flag = 1;
  size_vector = columns_.count();
  global_freq = 1;
  extvector = 0;
  local_flag = 1;
  size_local_cols = liggghts_pkg::WallColumns::kLocalColumns;
  local_freq = 1;
  peratom_freq = 1;  // of local data, too, to compute reduce
  restart_global = 1;
  can_create_mesh_ = true;
  meshwall_ = may_pose_as_mesh();
  or_fail([&] { liggghts_pkg::check_other_walls(*modify, world, options_); });
  report_opening(messages_);
  if (options_.verbose) describe();
  or_fail([&] { open_files(); });
}

template <class Action>
void FixWallNurbs::or_fail(Action action) const {
  try {
    action();
  } catch (const std::bad_alloc&) {
    messages_.fail_on_this_rank("out of memory");  // the others may have more
  } catch (const coupling::FailedOnThisRank& problem) {
    messages_.fail_on_this_rank(problem.what());
  } catch (const std::exception& problem) {
    messages_.fail(problem.what());
  }
}

// What the structure complains of on the way.
template <class Action>
void FixWallNurbs::in_step(Action action) const {
  const auto in_words = [this](const std::exception& problem) {
    return fmt::format("'{}': step {}: {}", options_.file, update->ntimestep, problem.what());
  };
  or_fail([&] {
    try {
      action();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const coupling::FailedOnThisRank& problem) {
      throw coupling::FailedOnThisRank(in_words(problem));
    } catch (const std::exception& problem) {
      throw std::runtime_error(in_words(problem));
    }
  });
}

void FixWallNurbs::describe() {
  geometry_io::GeometryFile surface{opened_.units, {}, {}};
  const auto& faces = structure_.surface().faces;
  if (faces && faces->trimmed())
    return messages_.print(
        fmt::format("surface '{}' of '{}'\n{}", options_.surface, options_.file, brep::text_of(*faces)));
  if (faces)
    surface.patches.emplace_back(geometry_io::mesh_of(brep::triangles_of(*faces)));
  else
    for (nurbs::Surface& patch : nurbs::split(loop_.wall().surface(), exchange_.positions()))
      surface.patches.emplace_back(std::move(patch));
  messages_.print(fmt::format("surface '{}' of '{}'\n{}", options_.surface, options_.file,
                              geometry_io::summary(surface, options_.edge_angle)));
}

void FixWallNurbs::open_files() {
  int every = 0;
  if (!options_.output.file.empty()) {
    output_ = std::make_unique<liggghts_pkg::WallOutput>(
        world, options_.output, liggghts_pkg::fields_on(world, structure_.surface(), exchange_.positions()));
    observer_ =
        std::make_unique<liggghts_pkg::OutputObserver>(lmp, *output_, loop_.wall().frame(), atom_type_wall_);
    every = options_.output.every;
  }
  if (!options_.stl.file.empty()) {
    stl_ = std::make_unique<liggghts_pkg::StlOutput>(
        world, options_.stl, liggghts_pkg::WallTriangles(structure_, exchange_, options_.twin));
    every = std::gcd(every, options_.stl.every);
  }
  if (every > 0) nevery = every;
}

int FixWallNurbs::setmask() {
  return FixWallGran::setmask() | INITIAL_INTEGRATE | FINAL_INTEGRATE | (output_ || stl_ ? END_OF_STEP : 0);
}

int FixWallNurbs::modify_param(int narg, char** arg) { return modify_drive(lmp, id, narg, arg); }

void FixWallNurbs::post_create() {
  or_fail([&] {
    memory_.create(history_count());
    restart_.reserve(origin(), output_.get());
  });
  fix_wallforce_ = memory_.force();
  restart_.note_walls_in_file(style);
}

void FixWallNurbs::pre_delete(bool unfixflag) {
  if (unfixflag) {
    memory_.remove();
    restart_.remove();
  }
  store_force_ = false;  // what the base class would delete is gone
  FixWallGran::pre_delete(unfixflag);
}

void FixWallNurbs::init() {
  restart_.warn_of_state_not_taken();
  or_fail([&] {
    liggghts_pkg::check_run_style(*update);
    check_box(*domain);
    memory_.find();
    fix_wallforce_ = memory_.force();
    {
      const liggghts_pkg::Setting<int> as_primitive(meshwall_, 0);
      FixWallGran::init();
    }
    meshwall_ = may_pose_as_mesh();
    if (!options_.material_independent)
      liggghts_pkg::check_wall_material(*modify, atom_type_wall_, structure_.materials(), options_.file);
    if (structure_.solid_below(0))
      model_.read_constants(lmp, liggghts_pkg::model_of(options_.model_words).normal, atom_type_wall_);
    if (observer_) observer_->begin_run(style);
  });
  reset_dt();
  const std::string step = structure_.describe_step();
  if (!step.empty()) messages_.print(step);
  weld_across_box();
}

void FixWallNurbs::weld_across_box() {
  if (!structure_.deforms()) loop_.wall().weld_across(contact::periods(box_of(*domain)));
}

void FixWallNurbs::reset_dt() {
  dt_ = update->dt;
  or_fail([&] { structure_.set_time_step(dt_); });
  columns_.structure_is_new();
}

void FixWallNurbs::createMulticontactData() {
  messages_.fail("surface multicontact is not supported by this wall");
}

/* ----------------------------------------------------------------------
   one time step, in the order LIGGGHTS calls it; setup evaluates forces and advances nothing
------------------------------------------------------------------------- */

void FixWallNurbs::setup(int vflag) {
  or_fail([&] {
    if (output_) output_->begin_run(update->ntimestep);
    if (stl_) stl_->begin_run(update->ntimestep);
  });
  structure_.begin_run();  // not in init: LIGGGHTS knows only now which computes its variables need
  loop_.wall().import();
  is_read_locally_ = may_be_read_locally();  // now, too
  {
    const liggghts_pkg::Setting<int> as_primitive(meshwall_, 0);
    FixWallGran::setup(vflag);  // pre_neighbor, pre_force, post_force, heat transfer
  }
  or_fail([&] { liggghts_pkg::give_gravity(*modify, structure_, options_.file); });
  if (structure_.moves()) in_step([&] { structure_.initialise_forces(*nodal_forces_); });
  columns_.structure_is_new();
  write_files(output_ && output_->at_beginning(), stl_ && stl_->at_beginning());
  const std::string missing = liggghts_pkg::missing_gravity(*modify, structure_, options_.file);
  if (!missing.empty() && !warned_of_gravity_) messages_.warn(missing);
  warned_of_gravity_ = !missing.empty();
}

// What commands between two runs have changed, where LIGGGHTS sets up nothing anew (`run N pre no`), too.
void FixWallNurbs::begin_first_step() {
  is_read_locally_ = may_be_read_locally();
  if (!structure_.moves()) loop_.wall().import();  // it may have moved until now
  if (loop_.has_other_members(particles())) rebuild_list_ = true;
}

void FixWallNurbs::initial_integrate(int) {
  if (update->ntimestep == update->firststep + 1) begin_first_step();
  if (!structure_.moves()) return;
  in_step([&] {
    exchange_.begin_step();
    columns_.structure_is_new();
    loop_.wall().import();
    // The list is good until the wall has moved half a skin; it is then rebuilt before this step's forces.
    const double motion = loop_.wall_motion();
    if (!std::isfinite(motion))
      throw std::runtime_error(
          structure_.deforms() ? "the solid has blown up: its positions are not finite; likely cause: the "
                                 "loads or the timestep"
                               : "the wall's place is not finite; likely cause: the numbers that move it");
    if (motion > 0.5 * neighbor->skin) rebuild_list_ = true;
  });
}

void FixWallNurbs::pre_neighbor() { rebuild_list_ = true; }

void FixWallNurbs::pre_force(int) {
  cutneighmax_ = neighbor->cutneighmax;
  if (rebuild_list_) build_list();
}

void FixWallNurbs::build_list() {
  rebuild_list_ = false;
  if (domain->box_change) weld_across_box();
  try {
    loop_.build_list(particles(), {neighbor->skin, neighbor->contactDistanceFactor, dt_, box_of(*domain)});
  } catch (const std::exception& problem) {
    messages_.fail_on_this_rank(problem.what());
  }
  near_particles_ = loop_.candidate_count();
}

void FixWallNurbs::post_force(int vflag) {
  if (output_) output_->begin_step(update->setupflag, update->get_cur_time());
  FixWallGran::post_force(vflag);  // calls post_force_primitive
  columns_.contacts_are_new();
  size_local_rows = 0;
  if (is_read_locally_) show_local_rows();
  nodal_forces_ = &no_forces_;
  if (structure_.needs_forces())
    in_step([&] {
      try {
        nodal_forces_ = &exchange_.export_add(loop_.forces_on_body(), update->setupflag != 0);
      } catch (const std::logic_error& problem) {
        messages_.fail_on_this_rank(problem.what());
      }
    });
}

void FixWallNurbs::post_force_primitive(int) {
  contact::ParticleView view = particles();
  // Other fixes may change radii as late as in pre_force.
  if (loop_.has_outgrown_list(view)) build_list();
  if (structure_.needs_forces()) view.mass = masses();
  try {
    const bool setup = update->setupflag != 0;
    model_.begin_step();
    loop_.step(view, {update->ntimestep, dt_, neighbor->contactDistanceFactor, setup}, model_,
               observer_.get());
    model_.end_step(setup);
  } catch (const contact::TooManyContacts& problem) {
    messages_.fail_on_this_rank(fmt::format("{}; use 'contacts N' with a larger N", problem.what()));
  } catch (const std::exception& problem) {
    messages_.fail_on_this_rank(problem.what());
  }
}

// LIGGGHTS' arrays as they now are: they move when the number of particles grows.
contact::ParticleView FixWallNurbs::particles() {
  const auto rows = [this](double** array) { return atom->nlocal > 0 ? array[0] : nullptr; };
  return {atom->nlocal,       atom->tag,  atom->radius, rows(atom->x),  rows(atom->v), rows(atom->f),
          rows(atom->torque), atom->mask, groupbit,     memory_.rows(), atom->rmass};
}

// Of a sphere in a rigid body that body's, as contact models have it; LIGGGHTS has told by now which that is.
const double* FixWallNurbs::masses() {
  if (!fix_rigid()) return atom->rmass;
  masses_.assign(atom->rmass, atom->rmass + atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i)
    if (body(i) >= 0) masses_[i] = masstotal(body(i));
  return masses_.data();
}

void FixWallNurbs::final_integrate() {
  in_step([&] { structure_.end_step(*nodal_forces_); });
  columns_.structure_is_new();
  const std::string change = structure_.take_change();
  if (!change.empty()) messages_.print(fmt::format("step {}: {}", update->ntimestep, change));
  const std::string warning = structure_.take_warning();
  if (!warning.empty()) messages_.warn(fmt::format("step {}: {}", update->ntimestep, warning));
}

void FixWallNurbs::end_of_step() {
  const long step = update->ntimestep;
  write_files(output_ && step % output_->every() == 0, stl_ && stl_->is_due(step));
}

void FixWallNurbs::write_files(bool fields, bool triangles) {
  if (!fields && !triangles) return;
  const long step = update->ntimestep;
  or_fail([&] {
    loop_.wall().import_all();
    if (fields)
      output_->write(step, update->get_cur_time(), exchange_.body_positions(), loop_.wall().frame());
    if (triangles) stl_->write(step);
  });
}

void FixWallNurbs::post_run() {
  const contact::SearchCounts searches = contact::sum(loop_.searches(), world);
  messages_.print(contact::report(searches));
  if (searches.not_converged() > 0)
    messages_.warn(fmt::format("{} closest-point projections did not converge", searches.not_converged()));
  for (const std::string& alarm : liggghts_pkg::alarms_of_run(loop_, dt_, world)) messages_.warn(alarm);
  const std::string of_mesh = liggghts_pkg::alarm_of_mesh(loop_, options_.uncorrected.empty(), world);
  if (!of_mesh.empty() && !warned_of_mesh_) messages_.warn(of_mesh);
  warned_of_mesh_ |= !of_mesh.empty();
  show_local_rows();  // for write_dump
  loop_.forget_reports();
}

/* ---------------------------------------------------------------------- */

double FixWallNurbs::compute_vector(int column) {
  // Thermo and fix ave/time look at the size once, and find the fix by its number or name ever after.
  if (column >= size_vector)
    messages_.fail(
        fmt::format("f_ID[{}] is asked for, this wall has 1 to {}: it came in the place of another one after "
                    "the line that asks was read, so give it another ID, or give that line once more",
                    column + 1, size_vector));
  double value = 0.0;
  or_fail([&] { value = columns_[column]; });
  return value;
}

// Of the models, then of the correction of their contacts.
int FixWallNurbs::history_count() const {
  return dnum_ + (structure_.local_compliance() ? contact::ComplianceCorrection::kMemory : 0);
}

liggghts_pkg::WallState::Origin FixWallNurbs::origin() const {
  coupling::Fingerprint fingerprint = structure_.fingerprint();
  fingerprint.push_back(coupling::word_part("units", geometry_io::units_name(opened_.units)));
  return {std::move(fingerprint), options_.slots, history_count()};
}

void FixWallNurbs::write_restart(FILE* file) {
  or_fail([&] { restart_.write(file, origin(), output_.get()); });
}

void FixWallNurbs::restart(char* buffer) {
  or_fail([&] { restart_.read(buffer, origin(), output_.get()); });
  loop_.wall().import();
}

int FixWallNurbs::getCreateMeshTriCount() {
  or_fail([&] {
    loop_.wall().import_all();
    twin_.build(world, options_.file, liggghts_pkg::WallTriangles(structure_, exchange_, options_.twin));
  });
  return twin_.triangle_count();
}

double* FixWallNurbs::getCreateMeshTriNode(const int i) { return twin_.corner(i); }
