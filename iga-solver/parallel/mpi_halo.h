// SPDX-License-Identifier: GPL-2.0-or-later
// The seam of ranks (structure/halo.h) by MPI: each rank holds one part of a body.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "parallel/point_to_point.h"
#include "structure/halo.h"
#include "structure/partition.h"

namespace parallel {

using nurbs::NodalVectors;
using structure::Id;

/// Messages of a step: one to and one from each neighbour with shares, the same with accelerations; sums are
/// reductions of a fixed size.
class MpiHalo final : public structure::Halo {
 public:
  using Halo::sum;
  /// `part`: that of this rank, parts being numbered as ranks of `comm`.  Collective.
  MpiHalo(MPI_Comm comm, structure::Part part);
  ~MpiHalo() override;

  Eigen::Index owned(Eigen::Index) const override { return part_.owned; }
  Eigen::Index held(Eigen::Index) const override { return part_.held(); }
  Id node_id(Eigen::Index column) const override { return column < part_.held() ? part_.nodes[column] : -1; }
  Id element_id(Eigen::Index held) const override { return part_.element(held); }
  void begin_sum(const NodalVectors& values) const override;
  void finish_sum(NodalVectors& values) const override;
  void owners_to_ghosts(NodalVectors& values) const override;
  void sum(structure::ExactSum* sums, std::size_t count) const override;
  double largest(double value) const override;
  void in_slices(const std::vector<Id>& ids, const double* rows, std::size_t numbers,
                 const VisitRows& visit) const override;

 private:
  MPI_Comm comm_;
  structure::Part part_;
  std::unique_ptr<PointToPoint> shares_, ghosts_;
};

}  // namespace parallel
