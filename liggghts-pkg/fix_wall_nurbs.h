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

#include <memory>
#include <string>
#include <vector>

#include "contact_report.h"
#include "coupling/contact/contact_loop.h"
#include "coupling/surface_exchange.h"
#include "fix_wall_gran.h"
#include "liggghts_contact_model.h"
#include "output_observer.h"
#include "particle_memory.h"
#include "stl_output.h"
#include "triangle_twin.h"
#include "wall_columns.h"
#include "wall_messages.h"
#include "wall_nurbs_setup.h"
#include "wall_output.h"
#include "wall_restart.h"

namespace LAMMPS_NS {

class FixWallNurbs : public WallNurbsSetup, public FixWallGran {
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
  void post_force_pgl() override;
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
  void post_force_mesh(int vflag) override { post_force_primitive(vflag); }

 private:
  template <class Action>
  void or_fail(Action action) const;  // what goes wrong ends the program, on every rank
  template <class Action>
  void in_step(Action action) const;  // likewise, with the step
  void weld_across_box();
  void begin_first_step();
  void build_list();
  contact::ParticleView particles();
  const double* masses();
  bool may_pose_as_mesh() const;
  bool may_be_read_locally() const;
  void show_local_rows();
  std::vector<FixWallNurbs*> walls_of_deck() const;
  void report(liggghts_pkg::ContactReport& rows, int number, ComputePairGranLocal* compute);
  void describe();
  void open_files();
  void write_files(bool fields, bool triangles);
  int history_count() const;
  liggghts_pkg::WallState::Origin origin() const;

  liggghts_pkg::WallMessages messages_;
  coupling::StructureSolver& structure_;
  coupling::SurfaceExchange exchange_;
  contact::ContactLoop loop_;
  liggghts_pkg::LiggghtsContactModel model_;
  liggghts_pkg::ParticleMemory memory_;
  std::vector<double> masses_;  // of particles, if some are in rigid bodies
  liggghts_pkg::WallColumns columns_;
  liggghts_pkg::WallRestart restart_;
  std::unique_ptr<liggghts_pkg::WallOutput> output_;        // null: none asked for
  std::unique_ptr<liggghts_pkg::OutputObserver> observer_;  // likewise
  std::unique_ptr<liggghts_pkg::StlOutput> stl_;            // likewise
  liggghts_pkg::TriangleTwin twin_;
  const coupling::NodalForces* nodal_forces_ = nullptr;
  coupling::NodalForces no_forces_;
  bool rebuild_list_ = true, warned_of_gravity_ = false, warned_of_mesh_ = false;
  bool is_read_locally_ = false;  // may be, in this run
};

}  // namespace LAMMPS_NS

#endif
#endif
