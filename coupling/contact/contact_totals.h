// SPDX-License-Identifier: GPL-2.0-or-later
// Sums over the contacts of all ranks.
#pragma once

#include <mpi.h>

#include <vector>

#include "coupling/contact/contact_rows.h"

namespace contact {

struct ContactTotals {
  double force[3];   ///< on the wall [force]
  double torque[3];  ///< on the wall, about the origin [force length]
  double contacts;
  double overlap;  ///< largest; 0 without contact [length]
  double power;    ///< that the wall gives to the particles [energy/time]
  double missing;  ///< largest share of a contact's force (mesh_estimate.h); 0 without contact [-]
};

/// Adds up in the order of (tag, slot), so that the sums are the same to the last bit on any number of ranks.
class ContactSums {
 public:
  /// Collective; the same result on all ranks.
  ContactTotals over_ranks(const std::vector<WallContact>& contacts, MPI_Comm comm);

 private:
  void gather(const std::vector<WallContact>& contacts, MPI_Comm comm);

  std::vector<WallContact> rows_;   // on rank 0; none elsewhere
  std::vector<int> count_, first_;  // per rank
};

}  // namespace contact
