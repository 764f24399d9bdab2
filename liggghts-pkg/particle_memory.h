// SPDX-License-Identifier: GPL-2.0-or-later
// What particles keep for a wall, each in a `fix property/atom`, which LIGGGHTS sorts, sends and saves with
// them: the slots of their contacts (coupling/contact/contact_memory.h), and the wall's force on them.  In
// place of FixWallGran's own, which has room for one contact's history only.
#ifndef LMP_PARTICLE_MEMORY_H
#define LMP_PARTICLE_MEMORY_H

#include <string>
#include <vector>

#include "coupling/contact/contact_memory.h"

namespace LAMMPS_NS {
class FixPropertyAtom;
class LAMMPS;
class Modify;
}  // namespace LAMMPS_NS

namespace liggghts_pkg {

class ParticleMemory {
 public:
  ParticleMemory(LAMMPS_NS::LAMMPS* lmp, const std::string& wall_id, int slot_count, bool stores_force);

  /// Defines these fixes, for contact models with so many history values.
  void create(int history_count);
  /// Looks them up: LIGGGHTS lets a user unfix what another fix holds, so nothing is held from one run to the
  /// next.  Throws std::runtime_error if one is gone.
  void find();
  /// Deletes those that are still there.
  void remove();

  /// The rows as they now are: they move when the number of particles grows.
  contact::ContactMemory rows();
  /// Of the wall's force, if it is stored.
  LAMMPS_NS::FixPropertyAtom* force() const { return force_; }

 private:
  void add(const std::string& name, const char* restart, const std::vector<std::string>& initial);
  LAMMPS_NS::FixPropertyAtom* found(const std::string& name) const;

  LAMMPS_NS::LAMMPS* lmp_;
  LAMMPS_NS::Modify& modify_;
  std::string wall_id_, force_id_;  // no id: not stored
  std::vector<std::string> slot_ids_;
  int history_count_ = 0;
  std::vector<LAMMPS_NS::FixPropertyAtom*> slots_;
  std::vector<double*> rows_;
  LAMMPS_NS::FixPropertyAtom* force_ = nullptr;
};

}  // namespace liggghts_pkg

#endif
