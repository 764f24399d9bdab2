// SPDX-License-Identifier: GPL-2.0-or-later
// A wall's state in blocks.  LIGGGHTS counts the bytes that a fix leaves in a restart file by an int, so what
// is more than one block goes to helpers, a fix wall/nurbs/state for each further block.
#ifndef LMP_STATE_BLOCKS_H
#define LMP_STATE_BLOCKS_H

#include <cstddef>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixWallNurbsState;
class Modify;
}  // namespace LAMMPS_NS

namespace liggghts_pkg {

class StateBlocks {
 public:
  StateBlocks(LAMMPS_NS::Modify& modify, const std::string& wall_id);

  /// Defines the helpers that a state of so many numbers needs.
  void reserve(std::size_t numbers);
  /// Of a state the wall's own block; the helpers have the rest.  Throws std::runtime_error if there are too
  /// few of them.
  std::vector<double> split(std::vector<double> state);
  /// The whole state, of the wall's own block as LIGGGHTS read it, or nothing if that is all of it.
  std::vector<double> joined(const char* own_block);
  /// Deletes the helpers.
  void remove();

 private:
  void add_helper();
  std::string helper_id(std::size_t k) const;
  LAMMPS_NS::FixWallNurbsState* helper(std::size_t k) const;  // null if it is gone

  LAMMPS_NS::Modify& modify_;
  std::string wall_id_;
  std::size_t block_size_;  // [numbers]
  std::size_t helpers_ = 0;
};

}  // namespace liggghts_pkg

#endif
