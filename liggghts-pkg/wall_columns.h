// SPDX-License-Identifier: GPL-2.0-or-later
// What fix wall/nurbs shows: its vector (`f_ID[n]`) and its local array (`dump local`).  Columns:
// doc/fix_wall_nurbs.md.
#ifndef LMP_WALL_COLUMNS_H
#define LMP_WALL_COLUMNS_H

#include <mpi.h>

#include <functional>
#include <vector>

#include "coupling/contact/contact_loop.h"
#include "coupling/contact/contact_totals.h"
#include "coupling/structure_solver.h"
#include "tangential_spring.h"

namespace liggghts_pkg {

class WallColumns {
 public:
  static constexpr int kLocalColumns = 12;

  WallColumns(const coupling::StructureSolver& structure, const contact::ContactLoop& loop,
              const TangentialSprings& springs, MPI_Comm comm);
  WallColumns(const WallColumns&) = delete;
  WallColumns& operator=(const WallColumns&) = delete;

  int count() const { return static_cast<int>(values_.size()); }
  /// From 0; collective.
  double operator[](int column);
  /// After each evaluation of the contacts.
  void contacts_are_new();
  /// Whenever the structure has moved, or is loaded otherwise.
  void structure_is_new();
  /// A row for each of this rank's contacts(); until they are new.
  double** local_rows();

 private:
  /// Columns that are found together, which may take as long as a time step: when one of them is asked for.
  struct Group {
    int first, count;
    std::function<void(double* values)> find;
    bool is_known = false;
  };
  void add(int count, std::function<void(double* values)> find);
  const contact::ContactTotals& totals();

  const coupling::StructureSolver& structure_;
  const contact::ContactLoop& loop_;
  const TangentialSprings& springs_;
  MPI_Comm comm_;
  std::vector<Group> groups_;
  std::vector<double> values_;
  contact::ContactSums sums_;
  contact::ContactTotals totals_{};
  bool totals_are_summed_ = false;
  std::vector<double*> local_rows_;
};

}  // namespace liggghts_pkg

#endif
