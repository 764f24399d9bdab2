// SPDX-License-Identifier: GPL-2.0-or-later
// What fix wall/nurbs shows: its vector (`f_ID[n]`) and its local array (`dump local`).  Columns:
// doc/fix_wall_nurbs.md.
#ifndef LMP_WALL_COLUMNS_H
#define LMP_WALL_COLUMNS_H

#include <mpi.h>

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
              const TangentialSprings& springs, MPI_Comm comm)
      : structure_(structure),
        loop_(loop),
        springs_(springs),
        comm_(comm),
        probes_(static_cast<int>(structure.probes().size())),
        supports_(static_cast<int>(structure.reactions().size())) {}

  int count() const;
  /// From 0; collective.
  double operator[](int column);
  /// After each evaluation of the contacts.
  void contacts_are_new() { totals_are_summed_ = false; }
  /// A row for each of this rank's contacts(); until they are new.
  double** local_rows();

 private:
  const contact::ContactTotals& totals();
  double of_structure(int column) const;
  double gained_by_springs() const;
  int power_column() const;

  const coupling::StructureSolver& structure_;
  const contact::ContactLoop& loop_;
  const TangentialSprings& springs_;
  MPI_Comm comm_;
  int probes_, supports_;
  contact::ContactSums sums_;
  contact::ContactTotals totals_{};
  bool totals_are_summed_ = false;
  std::vector<double*> local_rows_;
};

}  // namespace liggghts_pkg

#endif
