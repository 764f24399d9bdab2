// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/contact_totals.h"

#include <algorithm>
#include <tuple>

namespace contact {

ContactTotals ContactSums::over_ranks(const std::vector<WallContact>& contacts, MPI_Comm comm) {
  gather(contacts, comm);
  std::sort(rows_.begin(), rows_.end(), [](const WallContact& a, const WallContact& b) {
    return std::tie(a.tag, a.slot) < std::tie(b.tag, b.slot);
  });
  ContactTotals totals{};
  for (const WallContact& row : rows_) {
    Vector3::Map(totals.force) += Vector3::Map(row.force);
    Vector3::Map(totals.torque) += Vector3::Map(row.torque);
    totals.contacts += 1.0;
    totals.overlap = std::max(totals.overlap, row.overlap);
    totals.power += row.power;
    totals.missing = std::max(totals.missing, row.missing);
  }
  MPI_Bcast(&totals, sizeof totals / sizeof(double), MPI_DOUBLE, 0, comm);
  return totals;
}

void ContactSums::gather(const std::vector<WallContact>& contacts, MPI_Comm comm) {
  int rank, ranks;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  if (ranks == 1) {
    rows_ = contacts;
    return;
  }
  const int mine = static_cast<int>(contacts.size());
  count_.resize(ranks);
  first_.assign(ranks, 0);
  MPI_Gather(&mine, 1, MPI_INT, count_.data(), 1, MPI_INT, 0, comm);
  for (int r = 1; r < ranks; ++r) first_[r] = first_[r - 1] + count_[r - 1];
  rows_.resize(rank == 0 ? first_.back() + count_.back() : 0);
  MPI_Datatype row;
  MPI_Type_contiguous(sizeof(WallContact) / sizeof(double), MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Gatherv(contacts.data(), mine, row, rows_.data(), count_.data(), first_.data(), row, 0, comm);
  MPI_Type_free(&row);
}

}  // namespace contact
