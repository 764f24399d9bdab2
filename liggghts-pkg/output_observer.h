// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts on their way to the surface's fields, with the volume that each wears off.
#ifndef LMP_OUTPUT_OBSERVER_H
#define LMP_OUTPUT_OBSERVER_H

#include "coupling/contact/contact_model.h"
#include "coupling/rigid_frame.h"
#include "wall_output.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace liggghts_pkg {

class OutputObserver final : public contact::ContactObserver {
 public:
  OutputObserver(LAMMPS_NS::LAMMPS* lmp, WallOutput& output, const coupling::RigidFrame& frame, int wall_type)
      : lmp_(lmp), output_(output), frame_(frame), wall_type_(wall_type) {}

  /// Looks up Finnie's constants of the deck, if wear is a field.  Throws std::invalid_argument if there are
  /// none.  `style`: of the fix, for LIGGGHTS' messages.
  void begin_run(const char* style);
  void see(const contact::Contact& contact) override;

 private:
  double worn_volume(const contact::Contact& contact, const contact::Vector3& normal) const;

  LAMMPS_NS::LAMMPS* lmp_;
  WallOutput& output_;
  const coupling::RigidFrame& frame_;
  int wall_type_;
  const double* const* k_finnie_ = nullptr;  // of the deck, [type - 1][type - 1]
};

}  // namespace liggghts_pkg

#endif
