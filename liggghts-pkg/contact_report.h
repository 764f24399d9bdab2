// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts for LIGGGHTS' `compute wall/gran/local`.
#ifndef LMP_CONTACT_REPORT_H
#define LMP_CONTACT_REPORT_H

#include <vector>

#include "coupling/contact/contact_model.h"

namespace LAMMPS_NS {
class ComputePairGranLocal;
}

namespace liggghts_pkg {

/// Writes contacts into the compute's rows, as LIGGGHTS' walls do with those of meshes: what they call mesh
/// and triangle are the number of the wall and the patch.
class ContactReport {
 public:
  /// Makes room for so many rows.  `history_count`: values of a contact's history that the compute takes.
  ContactReport(LAMMPS_NS::ComputePairGranLocal& compute, int rows, int history_count);

  /// `history_count` values stand at contact.history.  `centre` and `radius` are the particle's.
  void add(int wall, const contact::Contact& contact, const contact::Vector3& centre, double radius,
           int history_count);

 private:
  LAMMPS_NS::ComputePairGranLocal& compute_;
  std::vector<double> history_;
};

}  // namespace liggghts_pkg

#endif
