// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_exchange.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

#include "coupling/force_distribution.h"
#include "nurbs/assert.h"

namespace coupling {

namespace {

/// Numbers of contacts, and where in their list a rank's begin, are an int for MPI.
void expect_int(std::int64_t contacts) {
  constexpr int kMost = std::numeric_limits<int>::max();
  if (contacts > kMost)
    throw std::runtime_error("SurfaceExchange: " + std::to_string(contacts) +
                             " contacts with a deforming wall in one step, expected at most " +
                             std::to_string(kMost));
}

}  // namespace

SurfaceExchange::SurfaceExchange(MPI_Comm comm, StructureSolver& solver)
    : comm_(comm), solver_(solver), map_(solver.surface().map.on(solver.nodes())) {
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  all_counts_.resize(ranks);
  counts_.resize(ranks);
  offset_.resize(ranks);
  surface_forces_.setZero(3, solver.surface().topology.control_point_count());
  nodal_forces_.setZero(3, map_.node_count());
  import_surface();
}

void SurfaceExchange::import_surface() {
  map_.to_surface(solver_.positions(), positions_);
  map_.to_surface(solver_.velocities(), velocities_);
}

const NodalVectors& SurfaceExchange::export_add(const std::vector<ContactForce>& local) {
  gather(local);
  std::sort(contacts_.begin(), contacts_.end(), [](const ContactForce& a, const ContactForce& b) {
    return std::tie(a.tag, a.branch) < std::tie(b.tag, b.branch);
  });

  surface_forces_.setZero();
  for (const ContactForce& contact : contacts_) {
    NURBS_ASSERT(Vector3::Map(contact.F).allFinite(), contact.tag, contact.F[0], contact.F[1], contact.F[2]);
    const FootBasis foot(solver_.surface().topology, {contact.patch, {contact.xi[0], contact.xi[1]}});
    foot.distribute(Vector3::Map(contact.F), surface_forces_);
  }
  nodal_forces_.setZero();
  map_.add_to_nodes(surface_forces_, nodal_forces_);
  return nodal_forces_;
}

void SurfaceExchange::gather(const std::vector<ContactForce>& local) {
  const std::size_t ranks = counts_.size();
  if (ranks == 1) {
    contacts_ = local;
    return;
  }
  const std::int64_t mine = static_cast<std::int64_t>(local.size());
  MPI_Allgather(&mine, 1, MPI_INT64_T, all_counts_.data(), 1, MPI_INT64_T, comm_);
  const std::int64_t total = std::accumulate(all_counts_.begin(), all_counts_.end(), std::int64_t(0));
  expect_int(total);
  contacts_.resize(total);
  if (total == 0) return;
  std::copy(all_counts_.begin(), all_counts_.end(), counts_.begin());
  std::partial_sum(counts_.begin(), counts_.end() - 1, offset_.begin() + 1);
  MPI_Datatype contact;  // counted as one, so that int reaches far; made here, as MPI may end before we do
  MPI_Type_contiguous(sizeof(ContactForce), MPI_BYTE, &contact);
  MPI_Type_commit(&contact);
  MPI_Allgatherv(local.data(), static_cast<int>(mine), contact, contacts_.data(), counts_.data(),
                 offset_.data(), contact, comm_);
  MPI_Type_free(&contact);
}

}  // namespace coupling
