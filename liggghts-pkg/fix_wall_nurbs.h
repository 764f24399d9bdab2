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

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "candidate_list.h"
#include "contact_slot.h"
#include "coupling/surface_exchange.h"
#include "fix_wall_gran.h"
#include "local_search.h"
#include "nurbs/closest_point.h"
#include "wall_nurbs_setup.h"

namespace LAMMPS_NS {

class FixWallNurbs : private WallNurbsSetup, public FixWallGran {
 public:
  FixWallNurbs(class LAMMPS*, int, char**);

  int setmask();
  void post_create();
  void pre_delete(bool unfixflag);
  void init();
  void setup(int vflag);
  void initial_integrate(int vflag);
  void post_force(int vflag);
  void final_integrate();
  void post_run();
  void reset_dt();
  void createMulticontactData();

  double compute_vector(int column);
  void write_restart(FILE* file);
  void restart(char* buffer);

 protected:
  void pre_neighbor();
  void pre_force(int vflag);
  void post_force_primitive(int vflag);

 private:
  /// Sums over this rank's particles, then over all ranks.
  struct Totals {
    double force[3];   // on the wall
    double torque[3];  // on the wall, about the origin
    double contacts;
    double overlap;  // largest; 0 without contact
  };
  static const int kTotalColumns = 8;
  static const int kStructureColumns = 9;

  void build_candidates();
  void forget_lost_contacts();
  void import_surface();
  liggghts_pkg::ContactSlot slot(int particle);
  nurbs::Projection project(const liggghts_pkg::Candidate& candidate);
  bool inside_body(const nurbs::Projection& foot, const double* centre) const;
  void apply_contact(int particle, const nurbs::Projection& foot, double gap);
  const Totals& totals_of_all_ranks();
  double structure_column(int column) const;
  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message) const;
  void print(const std::string& message) const;

  coupling::StructureSolver& structure_;
  coupling::SurfaceExchange exchange_;
  nurbs::SurfaceProjector projector_;  // of the imported control points
  liggghts_pkg::CandidateList candidates_;
  liggghts_pkg::LocalSearch search_;
  bool rebuild_candidates_ = true;
  bool search_cold_ = true;  // the next projections must look at all candidate elements
  bool late_surface_;  // for tests alone: contact sees the surface one step late, which must show as first
                       // order

  class FixPropertyAtom* fix_memory_ = nullptr;  // one ContactSlot per particle
  std::vector<bool> is_candidate_;

  std::vector<coupling::ContactForce> contacts_;  // of this rank's particles, this step
  const coupling::NodalVectors* nodal_forces_ = nullptr;
  Totals totals_, all_totals_;
  bool totals_are_summed_ = false;

  // counted over one run, reported after it
  long inside_steps_ = 0;
  int inside_tag_ = 0;
};

}  // namespace LAMMPS_NS

#endif
#endif
