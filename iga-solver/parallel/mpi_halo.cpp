// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/mpi_halo.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace parallel {

namespace {

enum Tag { kShares = 1, kGhosts };

std::vector<Route> routes(const structure::Part& part, std::vector<int> structure::Neighbour::*send,
                          std::vector<int> structure::Neighbour::*receive) {
  std::vector<Route> routes;
  for (const structure::Neighbour& neighbour : part.neighbours)
    routes.push_back({neighbour.part, neighbour.*send, neighbour.*receive});
  return routes;
}

MPI_Comm copy_of(MPI_Comm comm) {
  MPI_Comm copy;
  MPI_Comm_dup(comm, &copy);
  return copy;
}

}  // namespace

MpiHalo::MpiHalo(MPI_Comm comm, structure::Part part)
    : Halo(part.runs), comm_(copy_of(comm)), part_(std::move(part)) {
  using structure::Neighbour;
  shares_ = std::make_unique<PointToPoint>(comm_, kShares,
                                           routes(part_, &Neighbour::shares_out, &Neighbour::shares_in));
  part_.gather.clear();  // these are the body's
  part_.scatter.clear();
  ghosts_ =
      std::make_unique<PointToPoint>(comm_, kGhosts, routes(part_, &Neighbour::own, &Neighbour::ghosts));
}

MpiHalo::~MpiHalo() {
  int finished = 0;
  MPI_Finalized(&finished);
  shares_.reset();
  ghosts_.reset();
  if (!finished) MPI_Comm_free(&comm_);
}

void MpiHalo::begin_sum(const NodalVectors& values) const { shares_->begin(values); }

void MpiHalo::finish_sum(NodalVectors& values) const {
  shares_->finish(values);
  structure::add_shares(part_, values);
}

void MpiHalo::owners_to_ghosts(NodalVectors& values) const {
  ghosts_->begin(values);
  ghosts_->finish(values);
}

void MpiHalo::sum(structure::ExactSum* sums, std::size_t count) const {
  constexpr int kWords = structure::ExactSum::kWords;
  std::vector<std::int64_t> words(count * kWords);
  for (std::size_t i = 0; i < count; ++i)
    std::copy(sums[i].words().begin(), sums[i].words().end(), words.begin() + i * kWords);
  MPI_Allreduce(MPI_IN_PLACE, words.data(), static_cast<int>(words.size()), MPI_INT64_T, MPI_SUM, comm_);
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(words.begin() + i * kWords, kWords, sums[i].words().begin());
}

double MpiHalo::largest(double value) const {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const bool is_none = std::isnan(value);
  double both[2] = {is_none ? kNone : value, is_none ? 1.0 : 0.0};
  MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, comm_);
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

std::vector<double> MpiHalo::in_order(const std::vector<Id>& ids, std::vector<double> rows) const {
  int ranks = 1, width = ids.empty() ? 0 : static_cast<int>(rows.size() / ids.size());
  MPI_Comm_size(comm_, &ranks);
  MPI_Allreduce(MPI_IN_PLACE, &width, 1, MPI_INT, MPI_MAX, comm_);
  const int mine = static_cast<int>(ids.size());
  std::vector<int> counts(ranks), offsets(ranks, 0);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  const std::size_t all = std::size_t(offsets.back()) + counts.back();
  std::vector<Id> all_ids(all);
  MPI_Allgatherv(ids.data(), mine, MPI_INT64_T, all_ids.data(), counts.data(), offsets.data(), MPI_INT64_T,
                 comm_);
  if (width == 0) return {};
  std::vector<double> gathered(all * width), ordered(all * width);
  MPI_Datatype row;  // counted as one, so that int reaches far
  MPI_Type_contiguous(width, MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Allgatherv(rows.data(), mine, row, gathered.data(), counts.data(), offsets.data(), row, comm_);
  MPI_Type_free(&row);
  for (std::size_t i = 0; i < all; ++i)
    std::copy_n(&gathered[i * width], width, &ordered[all_ids[i] * width]);
  return ordered;
}

}  // namespace parallel
