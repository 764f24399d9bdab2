// SPDX-License-Identifier: GPL-2.0-or-later
// What must exist before FixWallNurbs' base class is built.
#ifndef LMP_WALL_NURBS_SETUP_H
#define LMP_WALL_NURBS_SETUP_H

#include <mpi.h>

#include <string>
#include <vector>

#include "coupling/open_structure.h"
#include "wall_messages.h"
#include "wall_nurbs_options.h"

namespace LAMMPS_NS {

/// The checked words, the opened structure, and a stock command line from which FixWallGran builds LIGGGHTS'
/// contact models.  Anything wrong ends the program here, with one line.
class WallNurbsSetup {
 public:
  const liggghts_pkg::WallNurbsOptions& options() const { return options_; }

 protected:
  WallNurbsSetup(class LAMMPS* lmp, int narg, char** arg);
  /// What the user should know of it.
  void report_opening(const liggghts_pkg::WallMessages& messages) const;
  /// That it is orthogonal where it is periodic, since images are found along the axes; the deck may change
  /// it between runs.  Throws std::invalid_argument.
  static void check_box(const class Domain& box);
  /// fix_modify: changes what drives a rigid wall; returns how many words that took.
  int modify_drive(class LAMMPS* lmp, const char* id, int narg, char** arg);

  liggghts_pkg::WallNurbsOptions options_;
  coupling::OpenedStructure opened_;
  std::vector<char*> stock_arg_;  // points into stock_words_
  long near_particles_ = 0;       // candidates of this rank, for a servo in automatic mode

 private:
  void complete_servo(class LAMMPS* lmp, coupling::ServoSettings& servo);

  std::vector<std::string> stock_words_;
};

}  // namespace LAMMPS_NS

#endif
