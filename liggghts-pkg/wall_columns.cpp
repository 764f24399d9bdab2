// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_columns.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace liggghts_pkg {

using contact::ContactTotals;
using contact::WallContact;
using coupling::Vector3;

static_assert(offsetof(WallContact, torque) == WallColumns::kLocalColumns * sizeof(double),
              "WallContact begins with the local columns");

// The order of the columns.
WallColumns::WallColumns(const coupling::StructureSolver& structure, const contact::ContactLoop& loop,
                         const TangentialSprings& springs, MPI_Comm comm)
    : structure_(structure), loop_(loop), springs_(springs), comm_(comm) {
  add(8, [this](double* values) {
    const ContactTotals& all = totals();
    std::copy_n(all.force, 3, values);
    std::copy_n(all.torque, 3, values + 3);
    values[6] = all.contacts, values[7] = all.overlap;
  });
  add(3, [this](double* values) { Vector3::Map(values) = structure_.linear_momentum(); });
  add(3, [this](double* values) { Vector3::Map(values) = structure_.angular_momentum(Vector3::Zero()); });
  add(1, [this](double* values) { *values = structure_.kinetic_energy(); });
  add(1, [this](double* values) { *values = structure_.strain_energy(); });
  add(1, [this](double* values) { *values = structure_.stable_time_step(); });
  add(3 * static_cast<int>(structure_.probes().size()), [this](double* values) {
    for (const coupling::Probe& probe : structure_.probes())
      Vector3::Map(std::exchange(values, values + 3)) = probe.displacement;
  });
  add(1, [this](double* values) { *values = totals().power; });
  add(3, [this](double* values) {
    const coupling::Work work = structure_.work();
    values[0] = work.contacts, values[1] = work.loads, values[2] = work.internal;
  });
  add(1, [this](double* values) { *values = structure_.truncation(); });
  add(3 * static_cast<int>(structure_.reactions().size()), [this](double* values) {
    for (const coupling::Reaction& reaction : structure_.reactions())
      Vector3::Map(std::exchange(values, values + 3)) = reaction.force;
  });
  add(2, [this](double* values) {
    const coupling::Work work = structure_.work();
    values[0] = work.supports, values[1] = work.damped;
  });
  add(1, [this](double* values) {
    *values = springs_.gained();
    MPI_Allreduce(MPI_IN_PLACE, values, 1, MPI_DOUBLE, MPI_SUM, comm_);
  });
  add(1, [this](double* values) { *values = totals().missing; });
}

void WallColumns::add(int count, std::function<void(double* values)> find) {
  groups_.push_back({this->count(), count, std::move(find)});
  values_.resize(values_.size() + count);
}

double WallColumns::operator[](int column) {
  const auto is_before = [](const Group& group, int c) { return group.first + group.count <= c; };
  Group& group = *std::lower_bound(groups_.begin(), groups_.end(), column, is_before);
  if (!group.is_known) group.find(&values_[group.first]);
  group.is_known = true;
  return values_[column];
}

const ContactTotals& WallColumns::totals() {
  if (!totals_are_summed_) totals_ = sums_.over_ranks(loop_.rows(), comm_);
  totals_are_summed_ = true;
  return totals_;
}

void WallColumns::contacts_are_new() {
  totals_are_summed_ = false;
  structure_is_new();
}

void WallColumns::structure_is_new() {
  for (Group& group : groups_) group.is_known = false;
}

double** WallColumns::local_rows() {
  local_rows_.clear();
  for (const WallContact& row : loop_.rows()) local_rows_.push_back(const_cast<double*>(&row.tag));
  return local_rows_.data();
}

}  // namespace liggghts_pkg
