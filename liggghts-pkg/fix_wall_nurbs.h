// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: a granular wall that is a NURBS surface, rigid or the skin of a deforming isogeometric
// solid. Command page: doc/fix_wall_nurbs.md.  Method: Gao & Feng (2019), section 4.
#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/nurbs,FixWallNurbs)
// clang-format on
#else

#ifndef LMP_FIX_WALL_NURBS_H
#define LMP_FIX_WALL_NURBS_H

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "infinities and NaN mean something here: compile with -fno-finite-math-only after -ffast-math"
#endif

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "coupling/contact/candidate_list.h"
#include "coupling/contact/contact_memory.h"
#include "coupling/contact/contact_tracker.h"
#include "coupling/contact/local_search.h"
#include "coupling/contact/run_alarm.h"
#include "coupling/surface_exchange.h"
#include "fix_wall_gran.h"
#include "nurbs/tessellation.h"
#include "wall_nurbs_setup.h"
#include "wall_output.h"
#include "wall_state.h"

namespace LAMMPS_NS {

class FixWallNurbs : private WallNurbsSetup, public FixWallGran {
 public:
  FixWallNurbs(class LAMMPS*, int, char**);

  int setmask() override;
  int modify_param(int narg, char** arg) override;
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void post_force(int vflag) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override;
  void createMulticontactData() override;

  double compute_vector(int column) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  int getCreateMeshTriCount() override;
  double* getCreateMeshTriNode(const int i) override;

 protected:
  void pre_neighbor() override;
  void pre_force(int vflag) override;
  void post_force_primitive(int vflag) override;

 private:
  /// Sums over the particles of all ranks.
  struct Totals {
    double force[3];   // on the wall
    double torque[3];  // on the wall, about the origin
    double contacts;
    double overlap;  // largest; 0 without contact
    double power;    // that the wall gives to the particles
  };
  static const int kTotalColumns = 8;  // of them, the first in the vector; power is the last
  static const int kStructureColumns = 9;
  static const int kWorkColumns = 3;  // after power, the last

  /// A contact: one row of the local array, and what else the totals need.
  struct LocalRow {
    LocalRow() {}  // not set to zero first
    double tag, patch, xi[2];
    double point[3];  // foot
    double force[3];  // on the wall
    double overlap;
    double torque[3];  // on the wall, about the origin; the first that dump local does not see
    double power;
    double slot;
  };
  static const int kLocalColumns = 11;

  // fix_wall_nurbs.cpp
  template <class Action>
  void advance(Action action);  // of the structure
  [[noreturn]] void fail_in_step(const std::string& problem) const;
  void warn_of_missing_gravity();
  void weld_across_periodic_faces();
  void import_surface();
  void build_candidates();
  double largest_wall_speed() const;
  bool has_outgrown_list() const;
  void forget_lost_contacts();
  void find_properties();
  std::string wall_force_id() const;
  void find_slots();
  contact::ContactMemory memory(int particle) { return {slots_, particle, dnum_}; }
  void check_images(const std::vector<nurbs::Vector3>& images) const;

  // fix_wall_nurbs_contact.cpp
  void resolve_contacts(const contact::ContactTracker::Query& query);
  nurbs::Vector3 wall_velocity(const search::SurfaceFoot& foot, const nurbs::Vector3& point,
                               const nurbs::Vector3& delta) const;
  void apply_contact(int particle, contact::TrackedFoot& tracked, const nurbs::Vector3& delta,
                     const nurbs::Vector3& v_wall);
  void call_contact_model(int particle, const search::SurfaceFoot& foot, const nurbs::Vector3& delta,
                          contact::ContactSlot slot, nurbs::Vector3 v_wall);
  void take_slot(int particle, contact::TrackedFoot& tracked, const nurbs::Vector3& delta,
                 const contact::ContactMemory& memory);
  int side_of(const search::SurfaceFoot& foot, const nurbs::Vector3& delta) const;
  nurbs::Vector3 leave_surface(int particle, contact::TrackedFoot& tracked, const nurbs::Vector3& delta,
                               const contact::ContactMemory& memory) const;
  [[noreturn]] void fail_on_contact(int particle, const search::SurfaceFoot& foot) const;
  double effective_radius(int particle, const search::SurfaceFoot& foot, const nurbs::Vector3& delta) const;
  bool inside_body(const search::SurfaceFoot& foot, const nurbs::Vector3& delta) const;
  bool may_cross(int particle, const search::SurfaceFoot& foot) const;
  void check_crossing(int particle, const search::SurfaceFoot& foot, const nurbs::Vector3& delta,
                      const nurbs::Vector3& v_wall);

  // fix_wall_nurbs_output.cpp
  const Totals& totals_of_all_ranks();
  std::vector<LocalRow> rows_of_all_ranks() const;
  double structure_column(int column) const;
  void publish_local_rows();

  // fix_wall_nurbs_restart.cpp
  void refuse_second_solid() const;
  liggghts_pkg::WallState::Origin origin() const;
  void note_restart_data();
  void warn_of_state_not_taken();

  // fix_wall_nurbs_fields.cpp
  void open_output();
  void refuse_shared_output() const;
  void check_twin_size() const;
  void init_wear();
  void tell_output(int particle, const nurbs::SurfacePoint& foot, const nurbs::Vector3& delta,
                   const nurbs::Vector3& F, const nurbs::Vector3& v_wall);

  [[noreturn]] void fail(const std::string& message) const;  // collective
  [[noreturn]] void fail_on_this_rank(const std::string& message) const;
  void warn(const std::string& message) const;
  void print(const std::string& message) const;

  coupling::StructureSolver& structure_;
  coupling::SurfaceExchange exchange_;
  nurbs::MultiPatch surface_;              // of the structure; welded across periodic faces, too
  search::MultiPatchProjector projector_;  // of the imported control points, as is what follows
  search::Regularity regularity_;
  contact::CandidateList candidates_;
  contact::LocalSearch search_;
  contact::ContactTracker tracker_;
  const std::vector<int>& outward_sign_;  // of each patch
  coupling::RigidFrame frame_;            // of these control points
  struct {
    bool stands, deforms, slides, is_turned, needs_forces;
  } now_{};                      // what the wall is and asks for in this step
  double surface_motion_ = 0.0;  // of a deforming wall since the list was built
  double wall_travel_ = 0.0;     // in a step, when the list was built [length]
  double resolution_ = 0.0;      // a centre nearer than this is on the surface [length]
  bool surface_imported_ = false, warned_of_gravity_ = false;
  bool rebuild_candidates_ = true;

  std::vector<std::string> slot_ids_;              // the particles' contact memory, each a fix property/atom
  std::vector<class FixPropertyAtom*> fix_slots_;  // looked up before each run
  std::vector<double**> slots_;                    // their rows
  std::vector<bool> is_candidate_;
  std::vector<double> list_reach_;    // per particle, when the list was built
  std::vector<double> radius_limit_;  // likewise: what the list is good for

  std::vector<coupling::ContactForce> contacts_;  // of this rank's particles, if needed
  std::vector<LocalRow> local_rows_;              // for dump local
  std::vector<double*> local_pointers_;
  const coupling::NodalVectors* nodal_forces_ = nullptr;
  coupling::NodalVectors no_forces_;
  Totals totals_;
  bool totals_are_summed_ = false;
  contact::RunAlarm inside_, crossing_;

  std::unique_ptr<liggghts_pkg::WallOutput> output_;  // null: none asked for
  const double* const* k_finnie_ = nullptr;           // of the deck, [type - 1][type - 1]
  nurbs::TriangleMesh twin_;
  bool state_taken_ = false;                 // from a restart file
  std::vector<std::string> ids_with_state_;  // of walls in the restart file, until the first run
};

}  // namespace LAMMPS_NS

#endif
#endif
