// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: what it tells the user.  Columns: doc/fix_wall_nurbs.md.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "comm.h"
#include "fix_wall_nurbs.h"

using namespace LAMMPS_NS;
using nurbs::Vector3;

// In the order of (tag, slot), so that the sums are the same to the last bit on any number of ranks.
const FixWallNurbs::Totals& FixWallNurbs::totals_of_all_ranks() {
  if (totals_are_summed_) return totals_;
  std::vector<LocalRow> rows = rows_of_all_ranks();
  std::sort(rows.begin(), rows.end(), [](const LocalRow& a, const LocalRow& b) {
    return std::tie(a.tag, a.slot) < std::tie(b.tag, b.slot);
  });
  totals_ = Totals();
  for (const LocalRow& row : rows) {
    Vector3::Map(totals_.force) += Vector3::Map(row.force);
    Vector3::Map(totals_.torque) += Vector3::Map(row.torque);
    totals_.contacts += 1.0;
    totals_.overlap = std::max(totals_.overlap, row.overlap);
    totals_.power += row.power;
  }
  MPI_Bcast(&totals_, sizeof(Totals) / sizeof(double), MPI_DOUBLE, 0, world);
  totals_are_summed_ = true;
  return totals_;
}

// On rank 0; none elsewhere.
std::vector<FixWallNurbs::LocalRow> FixWallNurbs::rows_of_all_ranks() const {
  if (comm->nprocs == 1) return local_rows_;
  const int mine = static_cast<int>(local_rows_.size());
  std::vector<int> count(comm->nprocs), first(comm->nprocs);
  MPI_Gather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, 0, world);
  for (int rank = 1; rank < comm->nprocs; ++rank) first[rank] = first[rank - 1] + count[rank - 1];
  std::vector<LocalRow> rows(comm->me == 0 ? first.back() + count.back() : 0);
  MPI_Datatype row;
  MPI_Type_contiguous(sizeof(LocalRow) / sizeof(double), MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Gatherv(local_rows_.data(), mine, row, rows.data(), count.data(), first.data(), row, 0, world);
  MPI_Type_free(&row);
  return rows;
}

double FixWallNurbs::compute_vector(int column) {
  const int power = size_vector - 1 - kWorkColumns;
  if (column == power) return totals_of_all_ranks().power;
  if (column > power) {
    const coupling::Work work = structure_.work();
    return column == power + 1 ? work.contacts : column == power + 2 ? work.loads : work.internal;
  }
  if (column < kTotalColumns) return reinterpret_cast<const double*>(&totals_of_all_ranks())[column];
  return structure_column(column - kTotalColumns);
}

double FixWallNurbs::structure_column(int column) const {
  if (column < 3) return structure_.linear_momentum()[column];
  if (column < 6) return structure_.angular_momentum(Vector3::Zero())[column - 3];
  if (column == 6) return structure_.kinetic_energy();
  if (column == 7) return structure_.strain_energy();
  if (column == 8) return structure_.stable_time_step();
  const int probe = (column - kStructureColumns) / 3, direction = (column - kStructureColumns) % 3;
  return structure_.probes()[probe].displacement[direction];
}

// dump local reads the array without asking for it.
void FixWallNurbs::publish_local_rows() {
  static_assert(offsetof(LocalRow, torque) == kLocalColumns * sizeof(double), "LocalRow begins with columns");
  size_local_rows = static_cast<int>(local_rows_.size());
  const size_t known = local_pointers_.size();
  const bool moved = known > 0 && local_pointers_[0] != reinterpret_cast<double*>(local_rows_.data());
  if (moved || known < local_rows_.size()) {
    local_pointers_.resize(local_rows_.size());
    for (size_t k = 0; k < local_rows_.size(); ++k)
      local_pointers_[k] = reinterpret_cast<double*>(&local_rows_[k]);
  }
  array_local = local_pointers_.data();
}

void FixWallNurbs::post_run() {
  const contact::LocalSearch::Counts searches = contact::sum(search_.counts(), world);
  search_.reset();
  print(contact::report(searches));
  if (searches.not_converged() > 0)
    warn(fmt::format("{} closest-point projections did not converge", searches.not_converged()));

  const contact::RunAlarm inside = inside_.of_all_ranks(world), crossing = crossing_.of_all_ranks(world);
  if (inside.count > 0)
    warn(fmt::format(
        "the centre of particle {} got inside the solid ({} contacts of this kind in this run): use a "
        "smaller timestep or a stiffer contact",
        inside.tag, inside.count));
  if (crossing.count > 0) {
    constexpr double kFraction = 0.1;  // of the radius, per step
    warn(fmt::format(
        "the centre of particle {} would cross the wall within one step, at a speed of {:.6g} towards it ({} "
        "cases of this kind in this run): use a timestep of at most {:.3g}",
        crossing.tag, crossing.speed, crossing.count, kFraction * crossing.radius / crossing.speed));
  }
}
