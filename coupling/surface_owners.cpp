// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_owners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace coupling {

namespace {

enum Tag { kWanted = 1, kMotion, kContacts };
constexpr int kNumbers = 6;  // of a control point: position, velocity

void put(const NodalVectors& positions, const NodalVectors& velocities, int column, double* numbers) {
  nurbs::Vector3::Map(numbers) = positions.col(column);
  nurbs::Vector3::Map(numbers + 3) = velocities.col(column);
}

void take(const double* numbers, int column, NodalVectors& positions, NodalVectors& velocities) {
  positions.col(column) = nurbs::Vector3::Map(numbers);
  velocities.col(column) = nurbs::Vector3::Map(numbers + 3);
}

/// A type that is counted as one, so that int reaches far.
class Row {
 public:
  Row(int count, MPI_Datatype of) {
    MPI_Type_contiguous(count, of, &type_);
    MPI_Type_commit(&type_);
  }
  ~Row() { MPI_Type_free(&type_); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_;
};

}  // namespace

SurfaceOwners::SurfaceOwners(MPI_Comm comm, std::vector<int> own, int control_points)
    : own_(std::move(own)), owner_(control_points) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &me_);
  MPI_Comm_size(comm_, &ranks_);
  std::vector<int> owners(control_points, 0);
  for (const int c : own_) owners[c] = 1, owner_[c] = me_;
  MPI_Allreduce(MPI_IN_PLACE, owners.data(), control_points, MPI_INT, MPI_SUM, comm_);
  MPI_Allreduce(MPI_IN_PLACE, owner_.data(), control_points, MPI_INT, MPI_SUM, comm_);
  const auto wrong = std::find_if(owners.begin(), owners.end(), [](int count) { return count != 1; });
  if (wrong != owners.end())
    throw std::invalid_argument("SurfaceOwners: control point " + std::to_string(wrong - owners.begin()) +
                                " is owned by " + std::to_string(*wrong) + " ranks, expected one");
}

SurfaceOwners::~SurfaceOwners() {
  int finished = 0;
  MPI_Finalized(&finished);
  if (!finished) MPI_Comm_free(&comm_);
}

void SurfaceOwners::want(const std::vector<int>& control_points) {
  std::vector<std::vector<int>> wanted(ranks_);
  for (const int c : control_points) wanted[owner_[c]].push_back(c);
  wanted[me_].clear();
  std::vector<int> counts(ranks_), theirs(ranks_);
  for (int r = 0; r < ranks_; ++r) counts[r] = static_cast<int>(wanted[r].size());
  MPI_Alltoall(counts.data(), 1, MPI_INT, theirs.data(), 1, MPI_INT, comm_);
  owners_.clear();
  clients_.clear();
  std::vector<MPI_Request> requests;
  for (int r = 0; r < ranks_; ++r) {
    if (theirs[r] > 0) clients_.push_back({r, std::vector<int>(theirs[r]), {}});
    if (counts[r] > 0) owners_.push_back({r, std::move(wanted[r]), {}});
  }
  for (Link& client : clients_)
    MPI_Irecv(client.control_points.data(), static_cast<int>(client.control_points.size()), MPI_INT,
              client.rank, kWanted, comm_, &requests.emplace_back());
  for (const Link& owner : owners_)
    MPI_Isend(owner.control_points.data(), static_cast<int>(owner.control_points.size()), MPI_INT, owner.rank,
              kWanted, comm_, &requests.emplace_back());
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::vector<Link>* links : {&owners_, &clients_})
    for (Link& link : *links) link.numbers.resize(kNumbers * link.control_points.size());
}

std::vector<int> SurfaceOwners::wanted_by_others() const {
  std::vector<int> wanted;
  for (const Link& client : clients_)
    wanted.insert(wanted.end(), client.control_points.begin(), client.control_points.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}

void SurfaceOwners::bring_wanted(NodalVectors& positions, NodalVectors& velocities) {
  std::vector<MPI_Request> requests(owners_.size() + clients_.size());
  MPI_Request* request = requests.data();
  for (Link& owner : owners_)
    MPI_Irecv(owner.numbers.data(), static_cast<int>(owner.numbers.size()), MPI_DOUBLE, owner.rank, kMotion,
              comm_, request++);
  for (Link& client : clients_) {
    for (std::size_t i = 0; i < client.control_points.size(); ++i)
      put(positions, velocities, client.control_points[i], &client.numbers[kNumbers * i]);
    MPI_Isend(client.numbers.data(), static_cast<int>(client.numbers.size()), MPI_DOUBLE, client.rank,
              kMotion, comm_, request++);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (const Link& owner : owners_)
    for (std::size_t i = 0; i < owner.control_points.size(); ++i)
      take(&owner.numbers[kNumbers * i], owner.control_points[i], positions, velocities);
}

void SurfaceOwners::bring_all(NodalVectors& positions, NodalVectors& velocities) const {
  std::vector<int> counts(ranks_, 0), first(ranks_, 0);
  for (const int owner : owner_) ++counts[owner];
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  std::vector<double> mine(kNumbers * own_.size()), all(kNumbers * owner_.size());
  for (std::size_t i = 0; i < own_.size(); ++i) put(positions, velocities, own_[i], &mine[kNumbers * i]);
  const Row row(kNumbers, MPI_DOUBLE);
  MPI_Allgatherv(mine.data(), counts[me_], row, all.data(), counts.data(), first.data(), row, comm_);
  for (std::size_t c = 0; c < owner_.size(); ++c)
    take(&all[std::size_t(kNumbers) * first[owner_[c]]++], static_cast<int>(c), positions, velocities);
}

void SurfaceOwners::exchange(const std::vector<std::vector<ContactForce>>& there,
                             std::vector<ContactForce>& here) const {
  std::vector<bool> known(ranks_, false);
  known[me_] = true;
  for (const Link& owner : owners_) known[owner.rank] = true;
  for (int r = 0; r < ranks_; ++r)
    if (!known[r] && !there[r].empty())
      throw std::logic_error("SurfaceOwners: particle " + std::to_string(there[r].front().tag) +
                             " touches an element beyond those of its list");
  const Row contact(sizeof(ContactForce), MPI_BYTE);
  std::vector<MPI_Request> requests;
  for (const Link& owner : owners_)
    MPI_Isend(there[owner.rank].data(), static_cast<int>(there[owner.rank].size()), contact, owner.rank,
              kContacts, comm_, &requests.emplace_back());
  for (const Link& client : clients_) {
    MPI_Message message;
    MPI_Status status;
    int count = 0;
    MPI_Mprobe(client.rank, kContacts, comm_, &message, &status);
    MPI_Get_count(&status, contact, &count);
    const std::size_t before = here.size();
    here.resize(before + count);
    MPI_Mrecv(here.data() + before, count, contact, &message, MPI_STATUS_IGNORE);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

std::vector<double> SurfaceOwners::sum(std::vector<double> numbers) const {
  constexpr std::size_t kMost = std::size_t(1) << 30;  // an int for MPI
  for (std::size_t first = 0; first < numbers.size(); first += kMost)
    MPI_Allreduce(MPI_IN_PLACE, numbers.data() + first,
                  static_cast<int>(std::min(kMost, numbers.size() - first)), MPI_DOUBLE, MPI_SUM, comm_);
  return numbers;
}

double SurfaceOwners::largest(double value) const {
  const bool is_none = std::isnan(value);
  double both[2] = {is_none ? -std::numeric_limits<double>::infinity() : value, is_none ? 1.0 : 0.0};
  MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, comm_);
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

}  // namespace coupling
