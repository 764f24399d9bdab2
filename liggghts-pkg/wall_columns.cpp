// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_columns.h"

#include <cstddef>

namespace liggghts_pkg {

using contact::ContactTotals;
using contact::WallContact;

namespace {

// In this order: the first of ContactTotals, the structure, its probes (three each), power, work, truncation,
// reactions of supports (three each), work of supports, energy damped, gained by tangential springs, share of
// the force that is missing.
constexpr int kTotalColumns = offsetof(ContactTotals, power) / sizeof(double);
constexpr int kStructureColumns = 9;
constexpr int kWorkColumns = 3;
static_assert(offsetof(WallContact, torque) == WallColumns::kLocalColumns * sizeof(double),
              "WallContact begins with the local columns");

}  // namespace

int WallColumns::count() const { return power_column() + 1 + kWorkColumns + 1 + 3 * supports_ + 4; }

int WallColumns::power_column() const { return kTotalColumns + kStructureColumns + 3 * probes_; }

double WallColumns::operator[](int column) {
  const int power = power_column(), after_work = column - (power + 1 + kWorkColumns);
  if (column == power) return totals().power;
  if (after_work == 0) return structure_.truncation();
  if (after_work == 3 * supports_ + 1) return structure_.work().supports;
  if (after_work == 3 * supports_ + 2) return structure_.work().damped;
  if (after_work == 3 * supports_ + 3) return gained_by_springs();
  if (after_work == 3 * supports_ + 4) return totals().missing;
  if (after_work > 0) return structure_.reactions()[(after_work - 1) / 3].force[(after_work - 1) % 3];
  if (column > power) {
    const coupling::Work work = structure_.work();
    return column == power + 1 ? work.contacts : column == power + 2 ? work.loads : work.internal;
  }
  if (column < kTotalColumns) return reinterpret_cast<const double*>(&totals())[column];
  return of_structure(column - kTotalColumns);
}

const ContactTotals& WallColumns::totals() {
  if (!totals_are_summed_) totals_ = sums_.over_ranks(loop_.rows(), comm_);
  totals_are_summed_ = true;
  return totals_;
}

double WallColumns::of_structure(int column) const {
  if (column < 3) return structure_.linear_momentum()[column];
  if (column < 6) return structure_.angular_momentum(coupling::Vector3::Zero())[column - 3];
  if (column == 6) return structure_.kinetic_energy();
  if (column == 7) return structure_.strain_energy();
  if (column == 8) return structure_.stable_time_step();
  const int probe = (column - kStructureColumns) / 3, direction = (column - kStructureColumns) % 3;
  return structure_.probes()[probe].displacement[direction];
}

double WallColumns::gained_by_springs() const {
  double gained = springs_.gained();
  MPI_Allreduce(MPI_IN_PLACE, &gained, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return gained;
}

double** WallColumns::local_rows() {
  local_rows_.clear();
  for (const WallContact& row : loop_.rows()) local_rows_.push_back(const_cast<double*>(&row.tag));
  return local_rows_.data();
}

}  // namespace liggghts_pkg
