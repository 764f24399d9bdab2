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

/// Places of ids such that they rise.
std::vector<std::size_t> rising(const std::vector<Id>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return order;
}

/// all[id] is the row with this id, from whatever rank; rows of `width` numbers.
void gather_rows(MPI_Comm comm, const std::vector<Id>& ids, const std::vector<double>& rows,
                 std::vector<double>& all, int width) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const int mine = static_cast<int>(ids.size());
  std::vector<int> counts(ranks), offsets(ranks, 0);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<Id> their_ids(offsets.back() + counts.back());
  std::vector<double> theirs(their_ids.size() * width);
  MPI_Allgatherv(ids.data(), mine, MPI_INT64_T, their_ids.data(), counts.data(), offsets.data(), MPI_INT64_T,
                 comm);
  MPI_Datatype row;  // counted as one, so that int reaches far
  MPI_Type_contiguous(width, MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Allgatherv(rows.data(), mine, row, theirs.data(), counts.data(), offsets.data(), row, comm);
  MPI_Type_free(&row);
  for (std::size_t i = 0; i < their_ids.size(); ++i)
    std::copy_n(&theirs[i * width], width, &all[their_ids[i] * width]);
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
  const bool is_none = std::isnan(value);
  double both[2] = {is_none ? structure::kNowhere : value, is_none ? 1.0 : 0.0};
  MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, comm_);
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

void MpiHalo::in_slices(const std::vector<Id>& ids, const double* rows, std::size_t numbers,
                        const VisitRows& visit) const {
  constexpr Id kSlice = 1 << 16;
  Id most[2] = {0, 0};
  if (!ids.empty()) {
    most[0] = static_cast<Id>(numbers / ids.size());
    most[1] = *std::max_element(ids.begin(), ids.end()) + 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_INT64_T, MPI_MAX, comm_);
  const auto [width, end] = most;
  if (width == 0) return;
  const std::vector<std::size_t> order = rising(ids);
  std::vector<Id> slice_ids;
  std::vector<double> slice_rows, ordered;
  auto next = order.begin();
  for (Id begin = 0; begin < end; begin += kSlice) {
    slice_ids.clear();
    slice_rows.clear();
    for (; next != order.end() && ids[*next] < begin + kSlice; ++next) {
      slice_ids.push_back(ids[*next] - begin);
      slice_rows.insert(slice_rows.end(), rows + *next * width, rows + (*next + 1) * width);
    }
    ordered.resize(std::min(kSlice, end - begin) * width);
    gather_rows(comm_, slice_ids, slice_rows, ordered, static_cast<int>(width));
    visit(ordered.data(), ordered.size());
  }
}

}  // namespace parallel
