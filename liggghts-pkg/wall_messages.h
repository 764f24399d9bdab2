// SPDX-License-Identifier: GPL-2.0-or-later
// How fix wall/nurbs speaks to the user.
#ifndef LMP_WALL_MESSAGES_H
#define LMP_WALL_MESSAGES_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace liggghts_pkg {

/// "Fix wall/nurbs (id plate): ...", the head of all of the fix's messages.
std::string wall_message(const std::string& id, const std::string& what);

class WallMessages {
 public:
  WallMessages(LAMMPS_NS::LAMMPS* lmp, const std::string& id) : lmp_(lmp), id_(id) {}

  /// Ends the program; collective.
  [[noreturn]] void fail(const std::string& message) const;
  /// The same where only this rank knows.
  [[noreturn]] void fail_on_this_rank(const std::string& message) const;
  void warn(const std::string& message) const;   ///< rank 0
  void print(const std::string& message) const;  ///< rank 0

 private:
  LAMMPS_NS::LAMMPS* lmp_;
  std::string id_;
};

}  // namespace liggghts_pkg

#endif
